"""The words for a relay that may not have opened, and for a limit switch."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.relay_faults import accusation, doubts, limit_reached, unstoppable
from rotator.exchange.faults import Fault, FaultKind
from rotator.exchange.motor import Trust

MINUS, OFF, PLUS = Direction
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
OPEN, UNSEEN, DOUBTED, WELDED = Trust
BY_HAND = "Switch the motors' supply off by hand NOW, the box has no relay for that. Then "


@pytest.mark.parametrize(
    ("axis", "way", "word"),
    [(AZ, PLUS, "clockwise"), (AZ, MINUS, "counter-clockwise"), (EL, PLUS, "up"), (EL, MINUS, "down")],
)
def test_each_direction_has_its_word(axis: Axis, way: Direction, word: str) -> None:
    fault = limit_reached(axis, way)
    assert (fault.kind, fault.axis) == (FaultKind.LIMIT_SWITCH, axis)
    assert fault.measured == f"its switch has opened on the way {word}"


@pytest.mark.parametrize(("master", "act_now"), [(True, ""), (False, "CUT MOTOR POWER!")])
@pytest.mark.parametrize(
    ("advice", "then"),
    [
        ("Check the wires", "check the wires"),
        ("Switch the motors off, and look at both relays", "look at both relays"),
    ],
)
def test_what_no_relay_stops_has_its_supply_cut_by_the_box_or_by_hand(
    master: bool, act_now: str, advice: str, then: str
) -> None:
    fault = unstoppable(Fault(FaultKind.TURNS_BY_ITSELF, AZ, "it turns", advice=advice), master=master)
    assert (fault.cut, fault.act_now, fault.measured) == (True, act_now, "it turns")
    begin = "The box has switched the motors' supply off. Now " if master else BY_HAND
    assert fault.advice == begin + then


def test_without_an_advice_of_its_own_it_is_that_of_its_kind() -> None:
    kind = FaultKind.STANDS_STILL
    fault = unstoppable(Fault(kind, AZ, "0.0°/s"), master=True)
    assert fault.advice.endswith(f"Now {kind.advice[0].lower()}{kind.advice[1:]}")


@pytest.mark.parametrize("master", [False, True])
def test_an_order_against_a_relay_that_is_suspected_is_a_fault(master: bool) -> None:
    welded = accusation(AZ, PLUS, WELDED, " stands at 448.0°", master=master)
    assert welded is not None
    assert (welded.kind, welded.cut) == (FaultKind.RELAY_WELDED, True)
    assert welded.measured == "the relay clockwise was found closed"
    assert bool(welded.act_now) is not master
    doubted = accusation(EL, MINUS, DOUBTED, " stands at 3.0°", master=master)
    assert doubted is not None
    assert (doubted.kind, doubted.cut) == (FaultKind.RELAY_UNSEEN, master)
    assert (
        doubted.measured == "the relay down is off, and it stands at 3.0°, where a motor with current would stand too"
    )
    unknown = accusation(EL, MINUS, DOUBTED, "", master=master)
    assert unknown is not None
    assert "and it stands, where" in unknown.measured


@pytest.mark.parametrize("trust", [OPEN, UNSEEN])
def test_a_relay_that_is_not_suspected_accuses_nothing(trust: Trust) -> None:
    assert accusation(AZ, PLUS, trust, "", master=True) is None


def test_a_person_who_drives_it_to_its_stops_reads_which_relay_is_in_doubt() -> None:
    assert doubts(AZ, (OPEN, WELDED)) == ()
    (notice,) = doubts(AZ, (DOUBTED, OPEN))
    assert notice.text == (
        "the box could not see the relay clockwise open, because the axis stood still: if it does not turn "
        "counter-clockwise now, stop and check that relay"
    )
    assert [notice.text.split()[7] for notice in doubts(EL, (DOUBTED, DOUBTED))] == ["up", "down"]
