"""One controller's conversation in bytes and moments: what goes out, in which order, and what is known from what came.

A GS-232B on paper: it answers what the test says, and turns nothing.
"""

from __future__ import annotations

import pytest

from hw.controllers.codecs import codec
from hw.controllers.course import Course, CourseSpec, Wish
from hw.controllers.unit import Pace, Trouble, Unit
from hw.ports import Axis

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
C2, S = b"C2\r", b"S\r"
STEP_S = 0.05


class Paper:
    """Time, the bytes that went out with their moments, and a controller that stands where the test says."""

    def __init__(self, *, from_deg: float | None = None, low_deg: float = 0.0, high_deg: float = 360.0) -> None:
        az = CourseSpec(1.0, 1.0, 1.0, low_deg, high_deg, 6.0, from_deg=from_deg)
        self.az, self.el = Course(az), Course(CourseSpec(1.0, 1.0, 1.0, 0.0, 180.0, 2.7))
        self.unit = Unit("gs232b", codec("gs232b", (AZ, EL)), {AZ: self.az, EL: self.el}, Pace())
        self.now_s = 0.0
        self.sent: list[tuple[float, bytes]] = []
        self.at_deg: tuple[float, float] | None = (100.0, 40.0)
        """What it answers; None: nothing."""
        self.unit.connected(0.0)
        self.run(2.0)
        self.sent.clear()

    def run(self, seconds: float, *, turning_dps: float = 0.0) -> None:
        """Cycles of the box; wishes are renewed as the box renews them."""
        until_s = self.now_s + seconds
        while self.now_s < until_s - 1e-9:
            self.now_s += STEP_S
            for course in (self.az, self.el):
                if course.wish is not None:
                    wish = course.wish
                    place_deg = wish.angle_deg + wish.rate_dps * (self.now_s - wish.at_s)
                    course.aim(Wish(place_deg, wish.rate_dps, self.now_s, self.now_s + 0.25))
                    self.unit.look()
            if self.at_deg is not None:
                self.at_deg = self.at_deg[0] + turning_dps * STEP_S, self.at_deg[1]
            self.step()

    def step(self) -> bytes:
        data = self.unit.step(self.now_s)
        if data:
            self.sent.append((self.now_s, data))
        if data == C2 and self.at_deg is not None:
            self.unit.received(
                b"AZ=%03d  EL=%03d\r\n" % (round(self.at_deg[0]) % 1000, round(self.at_deg[1])), self.now_s
            )
        return data

    def aim(self, course: Course, angle_deg: float, rate_dps: float = 0.0) -> None:
        course.aim(Wish(angle_deg, rate_dps, self.now_s, self.now_s + 0.25))
        self.unit.look()

    def told(self) -> list[bytes]:
        """What went out beside questions."""
        return [data for _, data in self.sent if data != C2]


def test_a_stop_waits_neither_for_an_answer_nor_for_the_pace() -> None:
    paper = Paper()
    paper.aim(paper.az, 200.0)
    paper.run(0.3)
    paper.at_deg = None
    paper.run(0.2)
    assert paper.sent[-1][1] == C2, "a question is open"
    paper.az.hold()
    assert paper.unit.due_s() is not None
    assert paper.step() == S


def test_a_new_target_waits_for_the_pace_and_the_same_one_is_not_told_again() -> None:
    paper = Paper()
    paper.aim(paper.az, 200.0)
    paper.run(0.3)
    paper.aim(paper.az, 210.0)
    paper.run(2.0, turning_dps=6.0)
    paper.aim(paper.az, 210.4)  # within the tolerance
    paper.run(2.0, turning_dps=6.0)
    assert paper.told() == [b"W200 040\r", b"W210 040\r"]
    first_s, second_s = (at_s for at_s, data in paper.sent if data != C2)
    assert second_s - first_s == pytest.approx(1.0, abs=0.06)


def test_a_controller_that_rests_elsewhere_is_told_its_target_again() -> None:
    paper = Paper()
    paper.aim(paper.az, 120.0)
    paper.run(2.0, turning_dps=4.0)
    paper.run(1.3)
    assert paper.told() == [b"W120 040\r", b"W120 040\r"], "it stands at 108"
    paper.run(3.0, turning_dps=4.0)
    paper.run(5.0)
    assert len(paper.told()) <= 3, "it is there"


def test_a_nearer_target_within_the_pace_is_a_stop_first() -> None:
    paper = Paper()
    paper.aim(paper.az, 200.0)
    paper.run(0.3, turning_dps=6.0)
    paper.aim(paper.az, 120.0)
    paper.run(0.1)
    assert paper.told() == [b"W200 040\r", S]
    paper.run(1.5)
    assert paper.told() == [b"W200 040\r", S, b"W120 040\r"]


def test_an_order_that_is_not_renewed_ends_with_a_stop() -> None:
    paper = Paper()
    paper.aim(paper.az, 200.0)
    paper.step()
    paper.now_s += 0.26
    assert S in paper.step()


def test_a_stop_of_one_axis_lets_the_other_go_on() -> None:
    paper = Paper()
    paper.aim(paper.az, 200.0)
    paper.aim(paper.el, 80.0)
    paper.run(0.3)
    paper.az.hold()
    paper.run(0.9)
    assert paper.told() == [b"W200 080\r", S, b"W100 080\r"]


def test_nothing_goes_beyond_the_limits() -> None:
    paper = Paper(low_deg=10.5, high_deg=199.5)
    paper.aim(paper.az, 190.0, 5.0)
    paper.run(4.0)
    assert paper.told()[-1] == b"W199 040\r"


def test_a_controller_that_counts_one_turn_is_told_and_understood_on_the_turn_of_the_axis() -> None:
    paper = Paper(from_deg=0.0, low_deg=-180.0, high_deg=180.0)
    paper.at_deg = (270.0, 40.0)
    paper.run(0.5)
    assert paper.az.angle_deg == -90.0
    paper.aim(paper.az, -20.0)
    paper.run(0.3)
    assert paper.told() == [b"W340 040\r"]


def test_silence_and_garbage_are_told_apart_within_two_seconds() -> None:
    paper = Paper()
    paper.at_deg = None
    paper.run(1.5)
    assert paper.unit.trouble(AZ, paper.now_s) == (Trouble.SILENT, "gs232b: no answer for 1.2 s")
    paper.at_deg = (100.0, 40.0)
    paper.run(1.0)
    assert paper.unit.trouble(AZ, paper.now_s) is None
    paper.at_deg = None
    for _ in range(15):
        paper.unit.received(b"\xd5\xf3", paper.now_s)
        paper.run(0.1)
    trouble = paper.unit.trouble(AZ, paper.now_s)
    assert trouble is not None
    assert trouble[0] is Trouble.GARBLED


def test_going_on_after_a_stop_is_told_within_two_seconds_and_stopped_again() -> None:
    paper = Paper()
    paper.aim(paper.az, 300.0)
    paper.run(2.0, turning_dps=6.0)
    paper.az.hold()
    paper.run(1.7, turning_dps=6.0)
    trouble = paper.unit.trouble(AZ, paper.now_s)
    assert trouble is not None
    assert trouble[0] is Trouble.RUNS_ON
    assert paper.told().count(S) >= 2
    paper.run(2.0)
    assert paper.unit.trouble(AZ, paper.now_s) is None, "it stands"


def test_a_coast_after_a_stop_is_none() -> None:
    paper = Paper()
    paper.aim(paper.az, 300.0)
    paper.run(2.0, turning_dps=6.0)
    paper.az.hold()
    paper.run(0.7, turning_dps=4.0)
    paper.run(3.0)
    assert paper.told() == [b"W300 040\r", S]
    assert not paper.az.by_hand(paper.now_s)


@pytest.mark.parametrize("ordered", [True, False])
def test_a_hand_at_its_knob_is_noticed_within_two_seconds_and_not_fought(ordered: bool) -> None:
    paper = Paper()
    if ordered:
        paper.aim(paper.az, 104.0)
        paper.run(1.0, turning_dps=4.0)
        paper.run(3.0)
    told = paper.told()
    paper.run(1.5, turning_dps=3.0)
    assert paper.az.by_hand(paper.now_s)
    paper.run(10.0, turning_dps=3.0)
    assert paper.told() == told, "neither a stop nor the old target"
    paper.aim(paper.az, 150.0)
    paper.run(0.5)
    assert paper.told()[-1] == b"W150 040\r", "another order counts"


def test_a_jump_of_its_sensor_is_no_hand() -> None:
    paper = Paper()
    paper.at_deg = (160.0, 40.0)
    paper.run(3.0)
    assert not paper.az.by_hand(paper.now_s)


def test_after_a_lost_connection_the_stop_that_was_missed_comes_first() -> None:
    paper = Paper()
    paper.aim(paper.az, 300.0)
    paper.run(1.0)
    paper.unit.lost("the adapter is gone")
    assert paper.unit.trouble(AZ, paper.now_s) == (Trouble.SILENT, "gs232b: the adapter is gone")
    paper.unit.connected(paper.now_s)
    assert paper.step() == S


def test_a_slow_target_is_led_by_half_a_step() -> None:
    """At 0.5°/s in whole degrees it is never further from its target than its rounding, the step, and a cycle."""
    paper = Paper()
    paper.aim(paper.az, 100.0, 0.5)
    for _ in range(400):
        paper.run(0.05)
        assert paper.az.sent_deg is not None
        assert paper.az.wish is not None
        assert abs(paper.az.sent_deg - paper.az.wish.angle_deg) <= 1.1
        paper.at_deg = (paper.az.sent_deg, 40.0)
    assert 8 <= len(paper.told()) <= 12
