"""Homing an axis that counts pulses: on the simulated rotor, with the real relay bank and counter."""

from __future__ import annotations

import dataclasses
import random

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from firmware_sim.rotors.relay_pulse import U100_MOTOR
from hw.ports import Direction
from hw.sensors.cam import Cam
from rotator.control.axis.homing import Homing, HomingSettings
from rotator.control.axis.readings import Condition
from tests.hw.sensors.pulse_rig import AZ, CAM, CYCLE_S, PulseRig
from tests.search import examples

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


@settings(max_examples=examples(50), suppress_health_check=[HealthCheck.too_slow])
@example(
    cam=dataclasses.replace(CAM, closed_deg=0.6, closes_at_deg=4.625, play_deg=0.3),
    start_deg=0.0,
    lag_s=0.0625,
    pace=1.0,
    bounce_s=0.0,
    seed=0,
)
@given(
    cam=cams(),
    start_deg=st.floats(0.0, 20.0),
    lag_s=st.floats(0.02, 0.1),
    pace=st.floats(0.8, 1.2),
    bounce_s=st.sampled_from([0.0, 0.005, 0.015]),
    seed=st.integers(0, 10_000),
)
def test_a_coast_may_end_anywhere_and_it_is_homed(  # noqa: PLR0917 - hypothesis calls it by keyword
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
    assert "longer than the whole travel" in homing.failure


def test_given_up_it_drives_nothing() -> None:
    rig, homing = PulseRig(180.0), ordered()
    rig.rotor.inject("azimuth-motor-stalled")
    fly(rig, homing)
    why = homing.failure
    for later_s in (1.0, 1000.0):
        assert homing.step(rig.clock() + later_s, Direction.OFF, Condition()) is Direction.OFF
    assert homing.failure == why, "the reason stays the first one"


def test_a_stop_by_another_sender_is_waited_out_not_taken_for_quiet() -> None:
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


# --- step by step, with the contact in hand


class ByHand:
    """A homing whose relays obey at once, and whose contact is what the test says."""

    def __init__(self, *, mostly_closed: bool = False) -> None:
        self.homing = Homing(HomingSettings(PERIOD_S, TRAVEL_S, COAST_S, 0.0, mostly_closed))
        self.now_s, self.changes, self.closed = 10.0, 0, mostly_closed
        self.driven = Direction.OFF

    def step(self, seconds: float, changes: int = 0, *, closed: bool | None = None) -> Direction:
        """After this time, with so many more changes of the contact."""
        self.now_s += seconds
        self.changes += changes
        self.closed = self.closed if closed is None else closed
        condition = Condition(changes=self.changes, closed=self.closed)
        self.driven = self.homing.step(self.now_s, self.driven, condition)
        return self.driven

    def rest(self) -> Direction:
        """The motor was switched off: wait until it stands for certain."""
        self.step(CYCLE_S)
        return self.step(COAST_S + 0.3)

    def to_the_end(self) -> Direction:
        """Down, where no pulse comes for three periods."""
        assert self.step(CYCLE_S) is Direction.MINUS
        assert self.step(CYCLE_S) is Direction.MINUS
        assert self.step(3.2 * PERIOD_S) is Direction.OFF
        return self.rest()


@pytest.mark.parametrize("mostly_closed", [False, True])
def test_the_way_up_ends_when_the_contact_has_entered_the_wider_part_of_its_period(mostly_closed: bool) -> None:
    """So the rest above is far from an edge, where a shaft that trembles would change the contact."""
    hand = ByHand(mostly_closed=mostly_closed)
    assert hand.to_the_end() is Direction.PLUS
    assert hand.step(0.5, 1, closed=not mostly_closed) is Direction.PLUS, "one change proves nothing"
    assert hand.step(0.1, 0, closed=mostly_closed) is Direction.PLUS
    assert hand.step(0.1, 1, closed=not mostly_closed) is Direction.PLUS, "the narrow part"
    assert hand.step(0.1, 1, closed=mostly_closed) is Direction.OFF


@pytest.mark.parametrize(("back", "homed"), [(1, False), (2, True), (3, True), (4, True), (5, False)])
def test_home_is_where_as_many_changes_came_back_as_on_the_way_up_or_one_more_or_less(back: int, homed: bool) -> None:
    hand = ByHand()
    hand.to_the_end()
    hand.step(0.5, 2)
    hand.step(CYCLE_S, 1)  # while it coasts
    assert hand.rest() is Direction.MINUS
    hand.step(1.0, back)
    assert hand.to_the_end() is (Direction.OFF if homed else Direction.PLUS)
    assert hand.homing.homed is homed
    assert hand.homing.failure == ""


def test_after_three_ways_up_that_do_not_agree_it_gives_up() -> None:
    hand = ByHand()
    hand.to_the_end()
    for _ in range(3):
        assert hand.driven is Direction.PLUS
        hand.step(0.5, 2)
        assert hand.rest() is Direction.MINUS
        hand.step(1.0, 7)
        hand.to_the_end()
    assert hand.driven is Direction.OFF
    assert hand.homing.failure == "its contact changed 2 times on the way up, 7 times on the way back, also in try 3"


def test_it_has_begun_once_its_motor_was_driven() -> None:
    """Before that the contact's silence has its own meaning: no run of homing has ended yet."""
    homing = ordered()
    for driven, begun in (
        (Direction.OFF, False),
        (Direction.OFF, False),
        (Direction.MINUS, True),
        (Direction.OFF, True),
    ):
        homing.step(10.0, driven, Condition())
        assert homing.begun is begun


def test_while_it_still_coasts_nothing_is_judged() -> None:
    hand = ByHand()
    hand.step(CYCLE_S)
    hand.step(CYCLE_S)
    assert hand.step(3.2 * PERIOD_S) is Direction.OFF
    hand.step(CYCLE_S)
    assert hand.step(COAST_S + 0.19) is Direction.OFF
    assert hand.step(0.1, 1) is Direction.OFF, "the contact has changed: it still moves"
    assert hand.step(COAST_S + 0.19) is Direction.OFF
    assert hand.step(0.1) is Direction.PLUS
