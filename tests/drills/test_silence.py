"""A fault that lasts and is seen has to be told within five seconds; what cannot be seen need not be."""

from __future__ import annotations

import pytest

from benchmarks.drills.accusations import SILENCE
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.silence import Silence, Words
from benchmarks.drills.world import AxisTruth
from rotator.exchange.status import AxisStatus, Status

QUIET = Status(0.0, AxisStatus(0.0, 360.0), AxisStatus(0.0, 90.0))


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


def test_a_reading_that_is_bad_now_and_then_need_not_be_reported() -> None:
    room = Room()
    room.silence.begin("azimuth-every:21", 0.0)
    assert room.listen(60.0) == []
