"""What the screens say of a target that the box tracks by itself."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from hw.ports import Axis, Direction
from rotator.status import AxisStatus, Flown, Status
from rotator.views.words import headline, orders_from

STANDS = Status(100.0, AxisStatus(0, 450, 231.0), AxisStatus(0, 180, 24.0), controlled_by="track")


@pytest.mark.parametrize(
    ("begin_s", "end_s", "said"),
    [
        (300.0, 900.0, "tracks ISS, AOS 3:20"),
        (8000.0, 9000.0, "tracks ISS, AOS 2h11"),
        (50.0, 165.4, "tracks ISS, LOS 1:05"),
        (50.0, 90.0, "tracks ISS, LOS 0:00"),
        (50.0, math.inf, "tracks ISS, always up"),
    ],
)
def test_when_the_target_rises_or_sets(begin_s: float, end_s: float, said: str) -> None:
    assert orders_from(replace(STANDS, flown=Flown("ISS", begin_s, end_s))) == said


def test_it_waits_for_a_target_that_has_not_risen() -> None:
    waits = replace(STANDS, flown=Flown("ISS", 300.0, 900.0))
    assert headline(waits)[0] == "WAITS FOR ISS"
    turns = replace(waits, azimuth=replace(waits.azimuth, drive=Direction.PLUS, moving=True))
    assert turns.axis(Axis.AZIMUTH).moving
    assert headline(turns)[0] == "TURNING"
    assert headline(replace(waits, at_s=301.0))[0] != "WAITS FOR ISS"
