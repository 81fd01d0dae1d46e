"""Any bytes at all, in any pieces, on every link that carries a stream: no crash, no ill-formed answer, bounded memory,
and no motion but what a second reading of the same bytes finds there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import product
from typing import TYPE_CHECKING

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, ClearTimed, Order
from rotator.protocols import prosistel
from rotator.protocols.dcu1 import Dcu1Session
from rotator.protocols.easycomm import Level
from rotator.protocols.easycomm_session import EasycommSession
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.gs232 import INVALID, Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.prosistel import ProsistelSession
from rotator.protocols.rc2800 import Rc2800Session
from rotator.protocols.rotctld_session import RotctldSession
from rotator.protocols.session import Box, Session
from rotator.protocols.spid import Model, SpidSession
from tests.protocols import readings_gs232, readings_makers, readings_rotctld
from tests.protocols.fed import assert_not_kept, assert_well_formed
from tests.protocols.readings_gs232 import ENDS, f1efw_motions, gs232_motions
from tests.protocols.readings_makers import (
    dcu1_motions,
    easycomm_motions,
    prosistel_motions,
    rc2800_motions,
    spid_motions,
)
from tests.search import examples, some

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Pieces = st.SearchStrategy[list[bytes]]


@dataclass(frozen=True, slots=True)
class Spoken:
    """`moves`: the second reading. `exactly`: it finds what the bytes mean; else all that may be meant. `top_deg`: of
    the rotor. `good`: an order for these angles; `answers`: to it."""

    session: Callable[[Box], Session]
    pieces: Pieces
    well_formed: bytes
    moves: Callable[[bytes], list[Order]]
    exactly: bool = True
    top_deg: float = 450.0
    good: bytes = b""
    answers: tuple[bytes, ...] = ()


GS232 = readings_gs232.PIECES
SPOKEN = {
    "gs232a": Spoken(
        lambda box: Gs232Session(box, Dialect.A),
        GS232,
        readings_gs232.WELL_FORMED["gs232a"],
        partial(gs232_motions, dialect=Dialect.A, strict=False),
        good=b"W%03d %03d",
    ),
    "gs232b": Spoken(
        lambda box: Gs232Session(box, Dialect.B, ack=b"\r", may_calibrate=True),
        GS232,
        readings_gs232.WELL_FORMED["gs232b"],
        partial(gs232_motions, dialect=Dialect.B, strict=False),
        good=b"W%d %d",
        answers=(b"\r",),
    ),
    "gs232b, strict": Spoken(
        lambda box: Gs232Session(box, Dialect.B, ack=b"\r", empty_line=INVALID, strict=True, may_calibrate=True),
        GS232,
        readings_gs232.WELL_FORMED["gs232b, strict"],
        partial(gs232_motions, dialect=Dialect.B, strict=True),
        good=b"W%03d %03d",
        answers=(b"\r",),
    ),
    "gs232-f1efw": Spoken(
        F1efwSession, GS232, readings_gs232.WELL_FORMED["gs232-f1efw"], f1efw_motions, good=b"W%03d %03d"
    ),
    "rotctld": Spoken(
        RotctldSession,
        readings_rotctld.PIECES,
        readings_rotctld.WELL_FORMED,
        readings_rotctld.motions_in,
        exactly=False,
        good=b"P %d %d",
        answers=(b"RPRT 0\n",),
    ),
    **{
        f"easycomm{level}": Spoken(
            lambda box, level=level: EasycommSession(box, level, pstrotator=level is Level.II),  # type: ignore[misc]
            readings_makers.PIECES,
            readings_makers.WELL_FORMED[f"easycomm{level}"],
            partial(easycomm_motions, level=level),
            exactly=False,
            top_deg=540.0,
        )
        for level in Level
    },
    **{
        model.name.lower(): Spoken(
            lambda box, model=model: SpidSession(box, model),  # type: ignore[misc]
            readings_makers.PIECES,
            readings_makers.WELL_FORMED[model.name.lower()],
            partial(spid_motions, protocol=model.name.lower()),
            top_deg=540.0,
        )
        for model in Model
    },
    "dcu1": Spoken(
        Dcu1Session, readings_makers.PIECES, readings_makers.WELL_FORMED["dcu1"], dcu1_motions, top_deg=540.0
    ),
    "rc2800": Spoken(
        Rc2800Session,
        readings_makers.RC2800_PIECES,
        readings_makers.WELL_FORMED["rc2800"],
        rc2800_motions,
        exactly=False,
    ),
    **{
        f"prosistel-{model.name[0].lower()}": Spoken(
            lambda box, model=model: ProsistelSession(box, model),  # type: ignore[misc]
            readings_makers.PROSISTEL_PIECES,
            readings_makers.WELL_FORMED["prosistel"],
            partial(prosistel_motions, elevation=letter, per_degree=per_degree),
            exactly=False,
        )
        for model, letter, per_degree in ((prosistel.Model.D, b"E", 1), (prosistel.Model.COMBI_TRACK, b"B", 10))
    },
}
EACH = pytest.mark.parametrize("spoken", SPOKEN.values(), ids=SPOKEN)


@EACH
@settings(max_examples=examples(200), deadline=None)
@given(data=st.data(), silences=st.sets(st.integers(0, 40), max_size=5))
def test_nothing_crashes_and_answers_are_well_formed(
    new_box: type[BenchBox], spoken: Spoken, data: st.DataObject, silences: set[int]
) -> None:
    assert_well_formed(spoken.session(new_box()), data.draw(spoken.pieces), silences, spoken.well_formed)


@EACH
@settings(max_examples=examples(200), deadline=None)
@given(data=st.data())
def test_what_moves_is_what_was_said(new_box: type[BenchBox], spoken: Spoken, data: st.DataObject) -> None:
    assert_moves_as_said(new_box((0, spoken.top_deg)), spoken, data.draw(spoken.pieces))


@pytest.mark.parametrize("pieces", [[b"Aa", b"AZ0", b"\n"], [b"AZ1.5", b"EL2.5", b"UP3", b"\n"]])
def test_what_was_once_misread(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    assert_moves_as_said(new_box((0, 540)), SPOKEN["easycomm2"], pieces)


def assert_moves_as_said(box: BenchBox, spoken: Spoken, pieces: list[bytes]) -> None:
    session, said = spoken.session(box), spoken.moves(b"".join(pieces))
    for piece in pieces:
        session.receive(piece)
    if spoken.exactly:
        assert box.motions == said
    else:
        possible = iter(said)
        assert all(motion in possible for motion in box.motions), "in this order"
    if not box.motions:
        box.wait(0.5)
        assert box.turned == set()


@EACH
@settings(max_examples=examples(50), deadline=None)
@given(data=st.data())
def test_pieces_make_no_difference(new_box: type[BenchBox], spoken: Spoken, data: st.DataObject) -> None:
    torn, whole, pieces = new_box(at_once=False), new_box(at_once=False), data.draw(spoken.pieces)
    in_pieces, at_once = spoken.session(torn), spoken.session(whole)
    replies = [reply for piece in pieces for reply in in_pieces.receive(piece)]
    assert at_once.receive(b"".join(pieces)) == replies
    assert whole.orders == torn.orders


@pytest.mark.parametrize("spoken", [each for each in SPOKEN.values() if each.good])
@settings(max_examples=examples(100), deadline=None)
@given(junk=st.binary(max_size=80), az=st.integers(0, 450), el=st.integers(1, 180), end=ENDS)
@example(junk=b"W1 0 0", az=235, el=25, end=b"\r")
def test_a_good_order_is_obeyed_after_any_bytes(  # noqa: PLR0917
    new_box: type[BenchBox], spoken: Spoken, junk: bytes, az: int, el: int, end: bytes
) -> None:
    box = new_box()
    session = spoken.session(box)
    session.receive(junk.replace(b"q", b"").replace(b"Q", b"") + b"\r")
    box.orders.clear()
    replies = session.receive(spoken.good % (az, el) + end)
    if not (az > 360 and b"36" in junk):
        # `W1 0 0` begins a timed list: an order in between gives it up.
        assert [each for each in box.orders if each != ClearTimed()] == [Aim(az, el)]
        assert replies == list(spoken.answers)


@pytest.mark.search
@pytest.mark.parametrize(
    ("protocol", "junk"),
    some(list(product(SPOKEN, [b"Z", b"W235 ", b"\0", b"P 1 ", b"+", b"w ", b"AZ235.0 ", b"W", b"AP1", b"W0000"]))),
)
def test_what_never_ends_is_not_kept(new_box: type[BenchBox], protocol: str, junk: bytes) -> None:
    packet = (junk * 4096)[:4096]
    assert_not_kept(SPOKEN[protocol].session(new_box()), packet)
