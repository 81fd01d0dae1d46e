"""How an axis keeps up with the pursuers of the estimator: by arithmetic, and among readings of a simulated motor."""

from __future__ import annotations

import math

import pytest

from hw.ports import Direction
from rotator.control.axis.estimator import Ahead, Behind, Estimator
from rotator.control.axis.relay_state import RelayState
from rotator.exchange.motor import Motor
from tests.control.axis.watched_motor import WatchedMotor

MINUS, OFF, PLUS = Direction


def test_behind_a_pursuer_counts_from_where_the_axis_was_level_with_it() -> None:
    behind = Behind()
    behind.note(2.0, 1.0, 5.0, 0.5)
    assert (behind.deg, behind.for_s) == (0.0, 0.0), "what it is ahead is not kept"
    behind.note(2.0, 1.0, 0.5, 0.5)
    behind.note(2.0, 1.0, 0.0, 0.5)
    assert (behind.deg, behind.for_s) == (3.5, 2.0)
    behind.note(0.0, 0.0, 3.0, 0.5)
    assert (behind.deg, behind.for_s) == (0.5, 2.0), "a coast makes up for it"
    behind.note(2.0, 1.0, 4.0, 0.5)
    assert (behind.deg, behind.for_s) == (0.0, 0.0)


def test_a_motion_lasts_only_as_long_as_it_keeps_ahead_of_the_close_pursuer() -> None:
    ahead = Ahead()
    for second in range(5):
        ahead.note(float(second), 1.0, 1.0, 3.0)
    assert (ahead.deg, ahead.since_s) == (3.0, 0.0)
    ahead.note(5.0, -1.0, 1.0, 3.0)
    assert (ahead.deg, ahead.since_s) == (2.0, math.inf)
    ahead.note(6.0, 0.5, 1.0, 3.0)
    assert (ahead.deg, ahead.since_s) == (2.5, 6.0)


@pytest.mark.parametrize("noise_deg", [0.02, 0.1, 0.4])
def test_places_at_rest_hardly_ever_seem_further_apart_than_is_sure(noise_deg: float) -> None:
    rotor = WatchedMotor(noise_deg=noise_deg)
    rotor.look(10.0)
    seen = rotor.watch._seen
    places_deg = []
    for _ in range(600):
        rotor.look(0.05)
        assert seen.place_deg is not None
        places_deg.append(seen.place_deg)
    assert max(places_deg) - min(places_deg) < seen.sure_deg * 1.3
    assert max(places_deg) - min(places_deg) > seen.sure_deg / 3.0


def test_one_spark_moves_no_place() -> None:
    rotor = WatchedMotor(noise_deg=0.02)
    rotor.look(3.0)
    rotor.off_deg = 2.0
    rotor.look(0.05)
    rotor.off_deg = 0.0
    rotor.look(0.05)
    assert rotor.watch._seen.place_deg == pytest.approx(rotor.at_deg, abs=0.05)


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_a_run_shows_the_speed_of_its_motor_and_where_its_relay_opened(way: Direction) -> None:
    rotor = WatchedMotor(speed_dps=4.0)
    rotor.look(2.0)
    rotor.run(way, 3.0)
    seen, off_deg = rotor.watch._seen, rotor.at_deg
    assert seen.line is not None
    assert seen.line.speed_dps == pytest.approx(4.0 * way, rel=0.05)
    assert seen.measured_dps == pytest.approx(4.0, rel=0.05)
    assert seen.off_deg == pytest.approx(off_deg, abs=0.2)
    rotor.look(2.0)
    assert seen.gone_deg == pytest.approx(4.0 * 0.165, abs=0.2), "its coast"
    assert min(seen.lost_deg.values()) > seen.sure_deg


def paced_run(*speeds_dps: tuple[float, float, float]) -> Estimator:
    """An axis of 6°/s after a run. For each part of it: its seconds, its pace, and the speed at which it turned."""
    seen = Estimator(dict.fromkeys((PLUS, MINUS), Motor(6.0, 0.9)), 0.0)
    now_s = at_deg = 0.0
    for _ in range(40):
        now_s += 0.05
        seen.see(now_s, at_deg, supplied=True)
    relays = RelayState().changed(now_s, PLUS)
    seen.note_relays(relays)
    for seconds, pace, dps in speeds_dps:
        seen.note_pace(pace)
        for _ in range(round(seconds / 0.05)):
            now_s, at_deg = now_s + 0.05, at_deg + 0.05 * dps
            seen.see(now_s, at_deg, supplied=True)
    seen.note_relays(relays.changed(now_s, OFF))
    return seen


def test_a_speed_seen_while_its_pace_changed_is_not_taken_for_that_of_the_last_pace() -> None:
    """It is not slowed down yet when it is switched off: at 6°/s, where its input says 1.2."""
    assert paced_run((4.0, 1.0, 6.0), (0.1, 0.2, 6.0)).motor_dps == pytest.approx(1.2)
    assert paced_run((4.0, 1.0, 6.0)).measured_dps == pytest.approx(6.0, rel=0.05)


def test_off_its_input_is_at_the_lowest_and_it_coasts_from_the_pace_that_it_had() -> None:
    seen = paced_run((0.3, 1.0, 3.0))
    seen.note_pace(0.2)
    assert seen.full_dps == pytest.approx(6.0)
    assert seen.motor_dps == pytest.approx(1.2)
