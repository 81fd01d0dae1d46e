"""Homing an axis that counts pulses: on the simulated rotor, with the real relay bank and counter."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.homing import Homing, HomingSettings
from tests.hw.sensors.pulse_rig import AZ, CYCLE_S, PulseRig

PERIOD_S, TRAVEL_S, COAST_S = 5.0 / 6.0, 60.0, 0.5


def ordered() -> Homing:
    return Homing(HomingSettings(PERIOD_S, TRAVEL_S, COAST_S, home_deg=0.0))


def fly(rig: PulseRig, homing: Homing, longest_s: float = 200.0) -> float:
    """Let it home, as the control loop would. Returns how long that took."""
    began_s = rig.clock()
    while not (homing.homed or homing.failure) and rig.clock() - began_s < longest_s:
        wanted = homing.step(rig.clock(), rig.bank.driven()[AZ], rig.counter.changes)
        rig.bank.drive(AZ, wanted, rig.clock() + 0.4)
        rig.clock.sleep(CYCLE_S)
        rig.counter.read()
    return rig.clock() - began_s


@pytest.mark.parametrize("start_deg", [0.0, 0.4, 2.0, 5.1, 5.9, 47.0, 180.0, 359.0])
def test_from_anywhere_it_ends_at_the_low_stop_and_knows_where_it_is(start_deg: float) -> None:
    rig, homing = PulseRig(start_deg), ordered()
    taken_s = fly(rig, homing)
    assert (homing.homed, homing.failure) == (True, "")
    assert rig.shaft_deg == 0.0
    assert taken_s < start_deg / 6.0 + 16.0
    assert rig.counter.place(0.0)
    rig.move(Direction.PLUS, 20.0)
    assert (rig.off_by, rig.counter.trouble) == (0, "")
    assert rig.counter.read() == pytest.approx(rig.shaft_deg, abs=0.3)


def test_a_count_that_was_lost_is_found_again() -> None:
    rig, homing = PulseRig(180.0), ordered()
    rig.counter.place(33.0)
    fly(rig, homing)
    assert rig.counter.place(0.0)
    assert (rig.off_by, rig.counter.trouble) == (0, "")


@pytest.mark.parametrize(
    "fault", ["azimuth-contact-stuck-open", "azimuth-contact-stuck-closed", "azimuth-motor-stalled"]
)
def test_a_dead_contact_or_motor_is_no_end_stop(fault: str) -> None:
    rig, homing = PulseRig(180.0), ordered()
    rig.rotor.inject(fault)
    fly(rig, homing)
    assert homing.failure.startswith("not homed: no pulse came in either direction")
    assert not homing.homed


def test_a_contact_that_dies_on_the_way_back_is_no_end_stop() -> None:
    rig, homing = PulseRig(20.0), ordered()
    while rig.bank.driven()[AZ] is not Direction.PLUS:
        fly(rig, homing, longest_s=CYCLE_S)
    while rig.bank.driven()[AZ] is not Direction.MINUS:
        fly(rig, homing, longest_s=CYCLE_S)
    rig.rotor.inject("azimuth-contact-stuck-open")
    fly(rig, homing)
    assert "edges came on the way up and" in homing.failure


def test_pulses_without_end_are_no_axis_of_this_travel() -> None:
    rig = PulseRig(300.0)
    homing = Homing(HomingSettings(PERIOD_S, 20.0, COAST_S, home_deg=0.0))
    assert fly(rig, homing) == pytest.approx(35.0, abs=0.2)
    assert "longer than its whole travel" in homing.failure


def test_given_up_it_drives_nothing() -> None:
    rig, homing = PulseRig(180.0), ordered()
    rig.rotor.inject("azimuth-motor-stalled")
    fly(rig, homing)
    assert homing.step(rig.clock() + 1.0, Direction.OFF, 0) is Direction.OFF


def test_a_stop_by_somebody_else_is_waited_out_not_taken_for_quiet() -> None:
    homing = ordered()
    assert homing.step(0.0, Direction.OFF, 0) is Direction.MINUS
    assert homing.step(20.0, Direction.OFF, 0) is Direction.MINUS
    assert homing.step(20.1, Direction.MINUS, 0) is Direction.MINUS
    assert homing.step(22.5, Direction.MINUS, 0) is Direction.MINUS
    assert homing.step(22.7, Direction.MINUS, 0) is Direction.PLUS
