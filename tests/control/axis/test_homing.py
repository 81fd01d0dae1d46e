"""Homing an axis that counts pulses: on the simulated rotor, with the real relay bank and counter."""

from __future__ import annotations

import dataclasses
import random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from firmware_sim.rotors.relay_pulse import U100_MOTOR
from hw.ports import Direction
from hw.sensors.cam import Cam
from rotator.control.axis.homing import Homing, HomingSettings
from rotator.control.axis.sensing import Condition
from tests.hw.sensors.pulse_rig import AZ, CAM, CYCLE_S, PulseRig

PERIOD_S, TRAVEL_S, COAST_S = 5.0 / 6.0, 60.0, 0.5


def ordered(*, switch: bool = False) -> Homing:
    return Homing(HomingSettings(PERIOD_S, TRAVEL_S, COAST_S, home_deg=0.0, switch=switch))


def seen(rig: PulseRig) -> Condition:
    return Condition(changes=rig.counter.changes, closed=rig.counter.in_closure, ends=rig.ends())


def fly(rig: PulseRig, homing: Homing, longest_s: float = 200.0) -> float:
    """Let it home, as the control loop would. Returns how long that took."""
    began_s = rig.clock()
    while not (homing.homed or homing.failure) and rig.clock() - began_s < longest_s:
        wanted = homing.step(rig.clock(), rig.bank.driven()[AZ], seen(rig))
        rig.bank.drive(AZ, wanted, rig.clock() + 0.4)
        rig.clock.sleep(CYCLE_S)
        rig.counter.read()
    return rig.clock() - began_s


def fly_unevenly(rig: PulseRig, homing: Homing, chance: random.Random) -> None:
    """Two threads: one reads the contact, one acts on the last reading, each when the machine lets it."""
    latest, read_s, act_s = seen(rig), rig.clock(), rig.clock() + CYCLE_S * chance.random()
    end_s = rig.clock() + 300.0
    while not (homing.homed or homing.failure):
        assert rig.clock() < end_s, "it never ends"
        rig.clock.sleep_until(min(read_s, act_s))
        if read_s <= act_s:
            rig.counter.read()
            latest, read_s = seen(rig), read_s + CYCLE_S * chance.uniform(0.9, 1.6)
        else:
            rig.bank.drive(AZ, homing.step(rig.clock(), rig.bank.driven()[AZ], latest), rig.clock() + 0.4)
            act_s += CYCLE_S * chance.uniform(0.9, 1.6)


@pytest.mark.parametrize("start_deg", [0.0, 0.4, 2.0, 5.1, 5.9, 47.0, 180.0, 359.0])
def test_from_anywhere_it_ends_at_the_low_stop_and_knows_where_it_is(start_deg: float) -> None:
    rig, homing = PulseRig(start_deg), ordered()
    taken_s = fly(rig, homing)
    assert (homing.homed, homing.failure) == (True, "")
    assert rig.shaft_deg == 0.0
    assert taken_s < start_deg / 6.0 + 18.0
    assert rig.counter.place(0.0)
    rig.move(Direction.PLUS, 20.0)
    assert (rig.off_by, rig.counter.trouble) == (0, "")
    assert rig.counter.read() == pytest.approx(rig.shaft_deg, abs=0.3)


@st.composite
def cams(draw: st.DrawFn) -> Cam:
    """A cam of each spacing that is sold or made, whose contact is closed for more or less of it."""
    spacing_deg = draw(st.sampled_from([5.0, 6.0, 10.0]))
    closed_deg = draw(st.sampled_from([0.6, 1.0, 2.0, 0.5 * spacing_deg, 0.7 * spacing_deg]))
    closes_at_deg = draw(st.one_of(st.just(0.0), st.floats(0.0, spacing_deg)))
    play_deg = draw(st.sampled_from([0.0, 0.0, 0.3]))
    return dataclasses.replace(
        CAM, spacing_deg=spacing_deg, closed_deg=closed_deg, closes_at_deg=closes_at_deg, play_deg=play_deg
    )


@settings(max_examples=50, suppress_health_check=[HealthCheck.too_slow])
@given(
    cam=cams(),
    start_deg=st.floats(0.0, 20.0),
    lag_s=st.floats(0.02, 0.1),
    pace=st.floats(0.8, 1.2),
    bounce_s=st.sampled_from([0.0, 0.005, 0.015]),
    seed=st.integers(0, 10_000),
)
def test_wherever_a_coast_ends_it_is_homed(  # noqa: PLR0917 - hypothesis calls it by keyword
    cam: Cam, start_deg: float, lag_s: float, pace: float, bounce_s: float, seed: int
) -> None:
    """The speed and the coast decide where it turns back: also on an edge of the contact, and where the stop is one."""
    motor = dataclasses.replace(U100_MOTOR, lag_s=lag_s)
    rig = PulseRig(start_deg, cam=cam, motor=motor, pace=pace, bounce_s=bounce_s, seed=seed)
    mostly_closed = cam.closed_deg > cam.spacing_deg / 2
    homing = Homing(HomingSettings(cam.spacing_deg / 6.0, TRAVEL_S, COAST_S + 0.02, 0.0, mostly_closed))
    fly_unevenly(rig, homing, random.Random(seed))
    assert (homing.homed, homing.failure, rig.shaft_deg) == (True, "", 0.0)
    assert rig.counter.place(0.0)
    rig.move(Direction.PLUS, 10.0)
    assert (rig.off_by, rig.counter.trouble) == (0, "")


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
    assert homing.failure.startswith("no pulse came in either direction")
    assert not homing.homed


def test_a_contact_that_dies_on_the_way_back_is_no_end_stop() -> None:
    rig, homing = PulseRig(20.0), ordered()
    while rig.bank.driven()[AZ] is not Direction.PLUS:
        fly(rig, homing, longest_s=CYCLE_S)
    while rig.bank.driven()[AZ] is not Direction.MINUS:
        fly(rig, homing, longest_s=CYCLE_S)
    rig.rotor.inject("azimuth-contact-stuck-open")
    fly(rig, homing)
    assert not homing.homed
    assert homing.failure.startswith("no pulse came in either direction"), "it goes up once more, and sees it"


def test_pulses_without_end_are_no_axis_of_this_travel() -> None:
    rig = PulseRig(300.0)
    homing = Homing(HomingSettings(PERIOD_S, 20.0, COAST_S, home_deg=0.0))
    assert fly(rig, homing) == pytest.approx(35.0, abs=0.2)
    assert "longer than its whole travel" in homing.failure


def test_given_up_it_drives_nothing() -> None:
    rig, homing = PulseRig(180.0), ordered()
    rig.rotor.inject("azimuth-motor-stalled")
    fly(rig, homing)
    assert homing.step(rig.clock() + 1.0, Direction.OFF, Condition()) is Direction.OFF


def test_a_stop_by_somebody_else_is_waited_out_not_taken_for_quiet() -> None:
    homing = ordered()
    for at_s, driven in ((0.0, Direction.OFF), (20.0, Direction.OFF), (20.1, Direction.MINUS), (22.5, Direction.MINUS)):
        assert homing.step(at_s, driven, Condition()) is Direction.MINUS
    assert homing.step(22.7, Direction.MINUS, Condition()) is Direction.OFF


def test_a_shaft_that_trembles_at_its_rest_above_is_tried_again() -> None:
    rig, homing = PulseRig(20.0), ordered()
    while rig.bank.driven()[AZ] is not Direction.PLUS:
        fly(rig, homing, longest_s=CYCLE_S)
    rig.rotor.inject("azimuth-pulses-doubled")
    while rig.bank.driven()[AZ] is not Direction.MINUS:
        fly(rig, homing, longest_s=CYCLE_S)
    rig.rotor.clear("azimuth-pulses-doubled")
    fly(rig, homing)
    assert (homing.homed, rig.shaft_deg) == (True, 0.0)


# --- an axis with a low limit switch


@pytest.mark.parametrize("start_deg", [0.5, 2.0, 3.1, 40.0])
def test_with_a_low_limit_switch_it_ends_there_and_never_reaches_the_stop(start_deg: float) -> None:
    rig, homing = PulseRig(start_deg), ordered(switch=True)
    rig.switch_deg = 3.0
    lowest_deg = start_deg
    while not (homing.homed or homing.failure):
        fly(rig, homing, longest_s=CYCLE_S)
        lowest_deg = min(lowest_deg, rig.shaft_deg)
    assert (homing.homed, homing.failure) == (True, "")
    assert rig.shaft_deg == pytest.approx(3.0 - 0.8, abs=0.3), "it has coasted on from the switch"
    assert lowest_deg >= min(start_deg, 1.8)


def test_a_switch_that_never_opens_is_no_home_though_the_stop_is_there() -> None:
    rig, homing = PulseRig(20.0), ordered(switch=True)
    fly(rig, homing)
    assert homing.failure.startswith("it stands at its stop, and the low limit switch has not opened")


def test_a_switch_whose_wire_is_broken_is_no_home() -> None:
    rig, homing = PulseRig(180.0), ordered(switch=True)
    rig.switch_deg = 360.0
    fly(rig, homing)
    assert homing.failure.startswith("the low limit switch stays open")
    assert rig.shaft_deg < 180.0 + 5 * CAM.spacing_deg


def test_a_switch_that_opened_once_on_the_way_is_passed() -> None:
    """A loose wire, and then the real end."""
    rig, homing = PulseRig(60.0), ordered(switch=True)
    fly(rig, homing, longest_s=3.0)
    rig.switch_deg = rig.shaft_deg + 1.0
    fly(rig, homing, longest_s=0.3)
    rig.switch_deg = 3.0
    fly(rig, homing)
    assert (homing.homed, rig.shaft_deg) == (True, pytest.approx(2.2, abs=0.3))
