"""The model of a control box that follows a wiper: where the rotor is thought to be, and when that is known."""

from __future__ import annotations

import pytest

from hw.drives.box_model import FAST, SLOW, BoxModel, RestLead

SPEED_DPS, BAND_DEG = 6.0, 2.0


def model(at_deg: float = 100.0, low_deg: float = 0.0, high_deg: float = 450.0) -> BoxModel:
    return BoxModel(at_deg, low_deg, high_deg, SPEED_DPS, BAND_DEG)


def after(box: BoxModel, seconds: float, wiper_deg: float, down_deg: float = 1.0, up_deg: float = 1.5) -> float:
    for _ in range(round(seconds / 0.05)):
        box.advance(wiper_deg, down_deg, up_deg, 0.05)
    return box.angle_deg


def test_the_angle_is_known_when_the_slowest_motor_must_have_come_from_the_furthest_end() -> None:
    box = model(100.0, 0.0, 450.0)
    furthest_s = (450.0 - 101.0) / (SPEED_DPS * SLOW)
    after(box, furthest_s - 1.0, 100.0)
    assert not box.known
    after(box, 2.0, 100.0)
    assert box.known, "from either side it is within the rest's own distance"
    assert FAST > 1.0 > SLOW


def test_measured_it_is_known_at_once_and_stays_so() -> None:
    box = model()
    assert not box.known
    box.found(222.0)
    assert (box.angle_deg, box.known) == (222.0, True)
    after(box, 1.0, 222.0)
    assert (box.angle_deg, box.known) == (222.0, True)
    assert after(box, 1.0, 300.0) == pytest.approx(228.0)


# --- which way to the target


@pytest.mark.parametrize(
    ("target_deg", "before", "way"),
    [(110.0, 0, 1), (110.0, -1, 1), (90.0, 1, -1), (101.0, 0, 1), (99.0, 0, -1), (100.4, 0, 0), (101.0, -1, -1)],
)
def test_a_small_correction_goes_on_in_the_direction_of_the_last_move(target_deg: float, before: int, way: int) -> None:
    box = model()
    box.found(100.0)
    assert box.way(target_deg, before, 1.5) == way


@pytest.mark.parametrize(
    ("low_deg", "high_deg", "before", "way"),
    [(50.0, 100.2, 0, 1), (99.8, 150.0, 0, -1), (50.0, 150.0, 0, 1), (50.0, 150.0, -1, -1), (99.0, 101.0, -1, -1)],
)
def test_where_the_rotor_may_not_have_arrived_the_side_where_it_may_be_decides(
    low_deg: float, high_deg: float, before: int, way: int
) -> None:
    assert model(100.0, low_deg, high_deg).way(100.0, before, 1.5) == way


# --- how far before the wiper it rests


class Bench:
    """A lead with a dead band of 2° and a coast of 0.5°, and a rotor that the test puts somewhere."""

    def __init__(self) -> None:
        self.lead = RestLead(dead_band_deg=2.0, coast_deg=0.5)
        self.now_s = 10.0

    def moved(self, from_deg: float, rests_deg: float, wiper_deg: float, way: int) -> None:
        """A move in that direction, and a rest that lasts."""
        self.lead.ordered(wiper_deg, way, self.now_s)
        for angle_deg in (from_deg, (from_deg + rests_deg) / 2, rests_deg):
            self.lead.seen(angle_deg, self.now_s)
            self.now_s += 0.5
        self.rests(rests_deg)

    def rests(self, angle_deg: float, seconds: float = 1.5) -> None:
        for _ in range(round(seconds / 0.1)):
            self.now_s += 0.1
            self.lead.seen(angle_deg, self.now_s)


def test_a_new_target_in_the_same_direction_goes_on_with_the_same_move() -> None:
    bench = Bench()
    bench.lead.ordered(98.0, 1, bench.now_s)
    bench.lead.seen(94.0, bench.now_s)
    bench.lead.seen(95.0, bench.now_s + 0.5)
    bench.now_s += 1.0
    bench.lead.ordered(100.0, 1, bench.now_s)
    bench.lead.seen(97.5, bench.now_s + 0.5)
    bench.now_s += 0.5
    bench.rests(97.5)
    assert bench.lead.deg(1) == pytest.approx(2.0), "it came from 94°, 3.5° in all"
