"""What has been seen of an axis: since when its relays are as they are, and from when on a speed can be told."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.observed_motion import RELAY_SETTLES_S, ObservedMotion, SpeedWindow
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Motor
from tests.control.axis.switch import Switch

MINUS, OFF, PLUS = Direction
STEP_S = 0.05
LAG_S = 0.5
WINDOW = SpeedWindow(least_s=1.0, first_s=1.5, most_s=3.0)
RIGHT, LEFT = Motor(6.0, 6.0 * LAG_S), Motor(4.0, 4.0 * LAG_S)


@pytest.fixture
def seen() -> ObservedMotion:
    return ObservedMotion(Axis.AZIMUTH, Range(0.0, 450.0), {PLUS: RIGHT, MINUS: LEFT})


def first_told_s(seen: ObservedMotion, from_s: float, error_dps: float = 1e6) -> float:
    """How long after `from_s` the speed is known, by readings that do not scatter."""
    at_s = from_s
    while seen.speed(at_s, WINDOW, error_dps) is None:
        at_s += STEP_S
        seen.see(at_s, 100.0)
    return at_s - from_s


def ready(seen: ObservedMotion) -> ObservedMotion:
    for step in range(100):
        seen.see(5.0 + step * STEP_S, 100.0)
    return seen


# --- the motor


def test_what_is_learnt_of_a_motor_counts_from_the_next_run_on() -> None:
    motors = {PLUS: RIGHT, MINUS: LEFT}
    seen = ObservedMotion(Axis.AZIMUTH, Range(0.0, 450.0), motors)
    switch = Switch(seen.note_relays)
    switch.to(10.0, PLUS)
    motors[PLUS] = LEFT
    assert seen.motor is RIGHT
    switch.to(11.0, OFF)
    assert seen.motor is RIGHT
    switch.to(12.0, PLUS)
    assert seen.motor is LEFT


# --- how fast


def test_until_it_has_turned_it_may_be_as_slow_as_half_a_degree_a_second(seen: ObservedMotion) -> None:
    switch = Switch(seen.note_relays)
    switch.to(10.0, PLUS)
    assert (seen.shown_dps, seen.reference_dps) == (None, 0.5)


@pytest.mark.parametrize(("shown_dps", "reference_dps"), [(0.2, 0.5), (2.0, 2.0), (9.0, 6.0)])
def test_it_is_held_to_what_it_has_shown_and_to_no_more_than_its_motor_is_said_to_do(
    seen: ObservedMotion, shown_dps: float, reference_dps: float
) -> None:
    switch = Switch(seen.note_relays)
    switch.to(10.0, PLUS)
    seen.show(shown_dps)
    assert seen.reference_dps == reference_dps


def test_the_fastest_that_it_has_shown_stays(seen: ObservedMotion) -> None:
    for speed_dps in (2.0, 5.0, 3.0):
        seen.show(speed_dps)
    assert seen.shown_dps == 5.0


# --- from when on


def test_driven_it_is_judged_after_its_lag_and_a_window(seen: ObservedMotion) -> None:
    ready(seen)
    switch = Switch(seen.note_relays)
    switch.to(10.0, PLUS)
    assert first_told_s(seen, 10.0) == pytest.approx(0.05 + LAG_S + 1.0, abs=STEP_S)


def test_switched_off_it_is_judged_after_its_coast_has_died_away(seen: ObservedMotion) -> None:
    """Twice its lag, and the relay's time: what coasts is not turned by anything."""
    ready(seen)
    switch = Switch(seen.note_relays)
    switch.to(9.0, PLUS)
    switch.to(10.0, OFF)
    assert first_told_s(seen, 10.0) == pytest.approx(0.2 + 2.0 * LAG_S + 1.0, abs=STEP_S)


def test_after_a_gap_in_the_readings_the_window_begins_anew(seen: ObservedMotion) -> None:
    ready(seen)
    switch = Switch(seen.note_relays)
    switch.to(10.0, OFF)
    seen.see(20.0, 100.0)
    assert first_told_s(seen, 20.0) == pytest.approx(1.0, abs=STEP_S)


def test_noise_asks_for_a_longer_window_but_not_before_it_has_turned(seen: ObservedMotion) -> None:
    ready(seen)
    switch = Switch(seen.note_relays)
    switch.to(10.0, PLUS)
    assert first_told_s(seen, 10.0, error_dps=1e-6) == pytest.approx(0.05 + LAG_S + 1.5, abs=STEP_S)
    seen.show(6.0)
    switch.to(30.0, OFF)
    switch.to(40.0, PLUS)
    assert first_told_s(seen, 40.0, error_dps=1e-6) == pytest.approx(0.05 + LAG_S + 3.0, abs=STEP_S)


def test_a_first_run_is_looked_at_whole_and_a_later_one_at_its_end() -> None:
    for shown, speed_dps in ((False, 1.2), (True, 0.0)):
        seen = ObservedMotion(Axis.AZIMUTH, Range(0.0, 450.0), {PLUS: RIGHT, MINUS: LEFT})
        if shown:
            seen.show(6.0)
        ready(seen)
        switch = Switch(seen.note_relays)
        switch.to(10.0, PLUS)
        at_s = 10.0
        for step in range(1, 60):
            at_s = 10.0 + step * STEP_S
            seen.see(at_s, 100.0 + 3.0 * min(1.5, step * STEP_S))
        slope = seen.speed(at_s, WINDOW, 1e6)
        assert slope is not None
        assert slope.speed_dps == pytest.approx(speed_dps, abs=0.4), "half of the whole run it stood"


@pytest.mark.parametrize(("axis", "name"), [(Axis.AZIMUTH, "counter-clockwise"), (Axis.ELEVATION, "down")])
def test_a_direction_has_the_name_that_a_person_uses(axis: Axis, name: str) -> None:
    assert ObservedMotion(axis, Range(0.0, 90.0), {PLUS: RIGHT, MINUS: LEFT}).name(MINUS) == name


def test_a_run_is_looked_at_whole_from_when_its_motor_was_due_to_turn(seen: ObservedMotion) -> None:
    """Its relay settles, and it lags: what came before says nothing of its speed."""
    ready(seen)
    Switch(seen.note_relays).to(10.0, PLUS)
    due_s, told_s = 10.0 + RELAY_SETTLES_S + LAG_S, None
    for step in range(1, 100):
        at_s = 10.0 + step * STEP_S
        seen.see(at_s, 100.0 + 2.0 * max(0.0, at_s - due_s))
        slope = seen.whole_run(at_s, 1.6)
        if slope is not None:
            told_s = told_s or at_s
            assert slope.speed_dps == pytest.approx(2.0, rel=0.05)
    assert told_s == pytest.approx(due_s + 1.6, abs=1.5 * STEP_S)
