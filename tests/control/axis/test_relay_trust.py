"""How far the two relays of an axis are trusted: what each report changes, and what it leaves alone."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayTrusts
from rotator.exchange.motor import Trust

MINUS, _, PLUS = Direction
OPEN, UNSEEN, DOUBTED, WELDED = Trust


@pytest.mark.parametrize(
    ("report", "afterwards"),
    [
        (RelayTrusts.closed, (UNSEEN, UNSEEN, DOUBTED, WELDED)),
        (RelayTrusts.look_again, (OPEN, UNSEEN, UNSEEN, WELDED)),
        (RelayTrusts.seen_open, (OPEN, OPEN, OPEN, OPEN)),
        (RelayTrusts.doubt, (DOUBTED, DOUBTED, DOUBTED, DOUBTED)),
        (RelayTrusts.found_closed, (WELDED, WELDED, WELDED, WELDED)),
    ],
    ids=lambda report: getattr(report, "__name__", ""),
)
@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_a_report_is_of_one_relay(report: object, afterwards: tuple[Trust, ...], way: Direction) -> None:
    assert callable(report)
    for before, after in zip(Trust, afterwards, strict=True):
        trusts = RelayTrusts((before, before))
        report(trusts, way)
        assert (trusts.of(way), trusts.of(Direction(-way))) == (after, before)
        assert trusts.both == ((after, before) if way is PLUS else (before, after))


@pytest.mark.parametrize("before", Trust)
def test_a_person_who_has_looked_ends_every_doubt(before: Trust) -> None:
    trusts = RelayTrusts((before, before))
    trusts.checked()
    assert trusts.both == (OPEN, OPEN)
