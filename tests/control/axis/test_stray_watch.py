"""Whether a positioned axis follows: it comes nearer to where it was sent, or there is a fault."""

from __future__ import annotations

import random

import pytest

from hw.ports import Axis
from rotator.control.axis.stray_watch import STRAY_DEG, StrayWatch
from rotator.control.commands import Steer
from rotator.exchange.faults import Fault

STEP_S = 0.05


class Sent:
    """An axis that turns as fast as the test says, and is sent where the test says."""

    def __init__(
        self,
        speed_dps: float = 30.0,
        accel_dps2: float | None = None,
        noise_deg: float = 0.0,
        at_deg: float = 90.0,
        stray_deg: float = STRAY_DEG,
    ) -> None:
        self.watch = StrayWatch(Axis.ELEVATION, speed_dps, accel_dps2, near_deg=0.0, stray_deg=stray_deg)
        self.now_s, self.at_deg = 100.0, at_deg
        self._noise_deg, self._chance = noise_deg, random.Random(3)

    def go(
        self, seconds: float, to_deg: float | None, dps: float = 0.0, rate_dps: float = 0.0, *, settling: bool = False
    ) -> tuple[float, Fault] | None:
        """Sent there (None: it holds) for so long. Returns the first fault, and after what time it came."""
        for step in range(1, round(seconds / STEP_S) + 1):
            self.now_s += STEP_S
            self.at_deg += dps * STEP_S
            if to_deg is not None:
                to_deg += rate_dps * STEP_S
            steered = None if to_deg is None else Steer(to_deg, rate_dps, self.now_s + 0.3)
            read_deg = self.at_deg + self._chance.gauss(0.0, self._noise_deg)
            fault = self.watch.see(self.now_s, steered, read_deg, self._noise_deg, settling=settling)
            if fault is not None:
                return step * STEP_S, fault
        return None


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
@pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.4])
def test_an_axis_that_stays_where_it_is_is_a_fault_after_1_7_s(way: int, noise_deg: float) -> None:
    told = Sent(noise_deg=noise_deg).go(5.0, 90.0 + way * 40.0)
    assert told is not None
    after_s, fault = told
    assert after_s == pytest.approx(1.75, abs=0.051)
    assert fault.name == "axis does not follow"
    assert fault.measured.count("°") == 2, "where it is, and how far that is from where it should be"
    assert fault.limit == "5° for 1.7 s"


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
@pytest.mark.parametrize("share", [0.3, 0.6, 1.0])
def test_an_axis_that_comes_nearer_is_no_fault(way: int, share: float) -> None:
    sent = Sent(at_deg=90.0 - way * 60.0)
    dps = share * 30.0 * way
    assert sent.go(100.0 / abs(dps), 90.0 + way * 60.0, dps) is None


@pytest.mark.parametrize(("off_deg", "told"), [(4.9, False), (-4.9, False), (5.1, True), (-5.1, True)])
def test_less_than_five_degrees_off_is_near_enough(off_deg: float, told: bool) -> None:
    assert (Sent().go(10.0, 90.0 + off_deg) is not None) is told


def test_a_motor_that_has_to_turn_back_first_has_the_time_for_it() -> None:
    """From 30°/s at 20°/s² it stands after 1.5 s, and has come back half a degree 0.22 s later, which is seen 0.35 s
    after that."""
    for accel_dps2, told_s in ((None, 1.75), (20.0, 2.15), (10.0, 3.7)):
        told = Sent(accel_dps2=accel_dps2).go(5.0, 130.0)
        assert told is not None
        assert told[0] == pytest.approx(told_s, abs=0.051)


def test_an_axis_that_turned_back_and_comes_is_no_fault() -> None:
    sent = Sent(accel_dps2=20.0)
    assert sent.go(1.5, 30.0, 15.0) is None
    assert sent.go(3.0, 30.0, -15.0) is None


def test_a_slow_motor_has_longer_until_it_can_be_seen_to_come() -> None:
    told = Sent(speed_dps=0.5).go(20.0, 130.0)
    assert told is not None
    assert told[0] == pytest.approx(0.5 / (0.25 * 0.5), abs=0.11)
    assert Sent(speed_dps=0.5).go(20.0, 130.0, 0.3) is None


def test_orders_in_between_and_holding_lose_nothing_of_what_was_seen() -> None:
    """A program that sends, stops and sends: 1.7 s in all."""
    sent = Sent()
    for _ in range(3):
        assert sent.go(0.5, 130.0) is None
        assert sent.go(2.0, None) is None
    assert sent.go(0.5, 130.0) is not None


def test_an_axis_that_moves_while_it_holds_has_not_come_nearer_by_itself() -> None:
    """A hand turns it: that shows nothing of its motor."""
    sent = Sent()
    for _ in range(3):
        assert sent.go(0.5, 130.0) is None
        assert sent.go(1.0, None, 5.0) is None
        assert sent.go(0.3, None) is None
    assert sent.go(0.5, 130.0) is not None


def test_acknowledged_it_has_its_whole_time_again() -> None:
    sent = Sent()
    assert sent.go(5.0, 130.0) is not None
    sent.watch.clear()
    told = sent.go(5.0, 130.0)
    assert told is not None
    assert told[0] == pytest.approx(1.8, abs=0.11)


def test_while_the_rotor_says_that_it_settles_there_is_no_fault() -> None:
    sent = Sent()
    assert sent.go(20.0, 130.0, settling=True) is None
    told = sent.go(5.0, 130.0)
    assert told is not None
    assert told[0] >= 1.6


def test_having_arrived_it_has_its_whole_time_for_the_next_place() -> None:
    sent = Sent()
    assert sent.go(1.5, 94.0, 10.0) is None
    assert sent.go(1.5, 130.0) is None


def test_a_target_that_came_back_to_it_gives_it_no_new_time() -> None:
    """Two programs disagree: 1.7 s elsewhere in all, and it never came nearer."""
    sent = Sent()
    assert sent.go(1.0, 130.0) is None
    assert sent.go(60.0, 92.0) is None
    told = sent.go(1.5, 130.0)
    assert told is not None
    assert told[0] == pytest.approx(0.7, abs=0.11)


def test_a_move_elsewhere_in_the_middle_of_one_is_a_try_of_its_own() -> None:
    sent = Sent()
    assert sent.go(1.0, 130.0) is None
    assert sent.go(0.5, 50.0) is None
    assert sent.watch.tries == 1


def test_with_an_encoder_of_its_own_a_motor_strays_from_a_degree_and_a_half_on() -> None:
    assert Sent(stray_deg=1.5).go(10.0, 91.4) is None
    assert Sent(stray_deg=1.5).go(10.0, 91.6) is not None


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_a_fast_target_that_leaves_a_stuck_axis_is_a_fault_soon_after_it_is_five_degrees_away(way: int) -> None:
    """What was seen while it was near counts: a target at 15°/s is 5° away after 0.33 s."""
    told = Sent().go(5.0, 90.0, rate_dps=15.0 * way)
    assert told is not None
    assert told[0] == pytest.approx(1.75, abs=0.11)
    assert Sent().go(4.0, 90.0, dps=15.0 * way, rate_dps=15.0 * way) is None


def test_without_a_reading_there_is_no_fault() -> None:
    watch = StrayWatch(Axis.AZIMUTH, 30.0, None, near_deg=0.0, stray_deg=STRAY_DEG)
    for step in range(200):
        assert watch.see(step * STEP_S, Steer(100.0, 0.0, 1e9), None, settling=False) is None


@pytest.mark.parametrize("way", [1, -1], ids=["up", "down"])
def test_sent_the_other_way_at_full_speed_it_has_the_time_to_turn_back(way: int) -> None:
    """30°/s and 20°/s²: it runs on for 1.5 s and 22°, away from its new place, and then comes."""
    sent = Sent(accel_dps2=20.0, at_deg=0.0)
    for _ in range(60):
        assert sent.go(STEP_S, way * 200.0, way * 30.0) is None
    dps = way * 30.0
    for _ in range(60):
        dps = max(-30.0, min(30.0, dps - way * 20.0 * STEP_S))
        assert sent.go(STEP_S, way * -20.0, dps) is None


@pytest.mark.parametrize("noise_deg", [0.0, 0.1, 0.4])
def test_a_target_that_goes_to_and_fro_around_a_stuck_axis_leaves_it_behind(noise_deg: float) -> None:
    """It is never far from its place for long, and yet it does not follow."""
    sent, told = Sent(noise_deg=noise_deg), None
    for turn in range(12):
        low_deg, rate_dps = (86.0, 8.0) if turn % 2 == 0 else (94.0, -8.0)
        told = told or sent.go(1.0, low_deg, rate_dps=rate_dps)
    assert told is not None
    assert told[1].name == "axis does not follow"


@pytest.mark.parametrize("beside_deg", [-4.0, 0.0, 4.0])
def test_an_axis_that_follows_beside_its_place_is_not_left_behind(beside_deg: float) -> None:
    """Its own pot and the sensor of the box may differ by some degrees."""
    sent = Sent(at_deg=90.0 + beside_deg, noise_deg=0.1)
    for turn in range(12):
        start_deg, rate_dps = (90.0, 8.0) if turn % 2 == 0 else (98.0, -8.0)
        assert sent.go(1.0, start_deg, rate_dps, rate_dps=rate_dps) is None
