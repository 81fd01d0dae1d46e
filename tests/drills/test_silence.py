"""A fault that lasts and is seen has to be told within five seconds; what cannot be seen need not be."""

from __future__ import annotations

import logging
from dataclasses import replace

import pytest

from benchmarks.drills.accusations import SILENCE
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.silence import Silence, Words
from benchmarks.drills.world import AxisTruth
from rotator.exchange.faults import Notice
from rotator.exchange.status import AxisStatus, Status

QUIET = Status(0.0, AxisStatus(0.0, 360.0), AxisStatus(0.0, 90.0))
TOLD = replace(QUIET, azimuth=replace(QUIET.azimuth, notices=(Notice("bad readings now and then"),)))


class Room:
    def __init__(self) -> None:
        self.now_s = 0.0
        self.words = Words(lambda: self.now_s)
        self.silence = Silence(self.words, (AxisCase(0.0, 360.0, 4.0), AxisCase(0.0, 90.0, 4.0)))
        self.axes = [AxisTruth("azimuth", 6.0, 0.5), AxisTruth("elevation", 6.0, 0.5)]

    def listen(self, seconds: float, status: Status = QUIET, *, every_s: float = 0.05) -> list[str]:
        end_s = self.now_s + seconds
        while self.now_s < end_s:
            self.now_s += every_s
            self.silence.look(self.now_s, self.axes, status, ordered=False)
        return [found.judge for found in self.silence.found]


@pytest.mark.parametrize("fault", ["azimuth-pot-open", "azimuth-every:18", "azimuth-pot-crackles:20"])
def test_a_fault_that_shows_at_rest_is_reported_within_five_seconds(fault: str) -> None:
    room = Room()
    room.silence.begin(fault, 0.0)
    assert room.listen(5.0) == []
    assert room.listen(0.3) == [SILENCE]


def test_a_notice_is_a_word_and_so_is_a_line_in_the_log() -> None:
    for_notice, for_line = Room(), Room()
    for room in (for_notice, for_line):
        room.silence.begin("azimuth-every:18", 0.0)
    assert for_notice.listen(60.0, TOLD) == []
    for_line.words.emit(logging.makeLogRecord({"name": "rotator.runtime.journal", "msg": "azimuth: bad readings"}))
    assert for_line.listen(60.0) == []


@pytest.mark.parametrize(
    "told",
    [
        replace(QUIET, elevation=replace(QUIET.elevation, notices=(Notice("bad readings now and then"),))),
        replace(QUIET, notices=("orders from gs232b#1 are ignored: stopped by page",)),
    ],
)
def test_a_word_about_the_other_axis_or_about_a_sender_tells_no_fault(told: Status) -> None:
    room = Room()
    room.silence.begin("azimuth-every:18", 0.0)
    assert room.listen(60.0, told) == [SILENCE]


def test_a_notice_that_was_there_before_tells_no_fault() -> None:
    room = Room()
    room.listen(0.1, TOLD)
    room.silence.begin("azimuth-every:18", room.now_s)
    assert room.listen(60.0, TOLD) == [SILENCE]


def test_a_control_box_that_stands_as_it_was_sent_shows_no_stall() -> None:
    room = Room()
    room.silence.begin("azimuth-motor-stalled", 0.0)
    room.axes[0].coil = 1
    for _ in range(200):
        room.now_s += 0.05
        room.silence.look(room.now_s, room.axes, QUIET, ordered=True, there=frozenset({"azimuth"}))
    assert room.silence.found == []
    assert room.listen(10.0) == [SILENCE]


def test_that_a_target_is_tracked_no_longer_tells_no_fault() -> None:
    room = Room()
    room.silence.begin("azimuth-every:18", 0.0)
    room.words.emit(logging.makeLogRecord({"name": "rotator.tracking.tracker", "msg": "tracking has ended"}))
    assert room.listen(60.0) == [SILENCE]


def test_a_reading_that_is_bad_now_and_then_need_not_be_reported() -> None:
    room = Room()
    room.silence.begin("azimuth-every:21", 0.0)
    assert room.listen(60.0) == []


def test_bad_readings_are_counted_so_late_cycles_show_fewer_of_them() -> None:
    room = Room()
    room.silence.begin("azimuth-every:18", 0.0)
    assert room.listen(20.0, every_s=0.25) == []
    assert room.listen(10.0, every_s=0.25) == [SILENCE]


def test_a_motor_that_cannot_turn_shows_only_while_it_is_driven() -> None:
    room = Room()
    room.silence.begin("azimuth-motor-stalled", 0.0)
    assert room.listen(60.0) == []
    room.axes[0].coil = 1
    assert room.listen(5.3) == [SILENCE]


@pytest.mark.parametrize(("counts", "most_s"), [(False, 5.0), (True, 10.5)])
def test_a_contact_that_stands_still_shows_after_three_of_its_periods(counts: bool, most_s: float) -> None:
    room = Room()
    room.silence = Silence(room.words, (AxisCase(0.0, 360.0, 4.0, counts=counts, patience_s=10.5),) * 2)
    room.axes[0].coil = 1
    room.silence.begin("azimuth-contact-stuck-closed", 0.0)
    assert room.listen(most_s) == []
    assert room.listen(0.3) == [SILENCE]


def test_a_fault_that_a_stop_heals_need_not_be_reported_after_it() -> None:
    room = Room()
    room.silence.begin("azimuth-encoder", 0.0)
    room.listen(1.0)
    room.silence.acknowledged()
    assert room.listen(10.0) == []
