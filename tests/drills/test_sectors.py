"""The judge of forbidden sectors sees a boom that the box has driven in, and no other."""

from __future__ import annotations

import pytest

from benchmarks.drills.accusations import FORBIDDEN
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.sectors import Sectors
from benchmarks.drills.world import AxisTruth
from rotator.config.load import parse

CHIMNEY = '[[mount.forbidden]]\nname = "chimney"\nazimuth_deg = [120, 140]\nelevation_deg = [0, 60]\n'


class Mast:
    def __init__(self) -> None:
        self.axes = [AxisTruth("azimuth", 6.0, 0.5), AxisTruth("elevation", 2.7, 0.5)]
        self.cases = AxisCase(0.0, 450.0, 4.0), AxisCase(0.0, 180.0, 4.0)
        self.sectors = Sectors(parse(CHIMNEY, "a mast"), self.cases)

    def points(self, *places_deg: tuple[float, float]) -> list[str]:
        for now_s, place_deg in enumerate(places_deg):
            for truth, boom_deg in zip(self.axes, place_deg, strict=True):
                truth.boom_deg = boom_deg
            self.sectors.look(float(now_s), self.axes)
        return [violation.judge for violation in self.sectors.found]


def test_driven_in_from_outside() -> None:
    assert Mast().points((119.0, 30.0), (121.0, 30.0)) == [FORBIDDEN]


def test_past_it_and_over_it() -> None:
    assert Mast().points((119.0, 30.0), (119.0, 61.0), (141.0, 61.0), (141.0, 0.0)) == []


def test_out_of_it_from_where_it_began() -> None:
    assert Mast().points((130.0, 30.0), (125.0, 30.0), (119.0, 30.0)) == []


@pytest.mark.parametrize("excuse", ["pushed", "welded"])
def test_carried_in_by_the_wind_or_a_welded_relay(excuse: str) -> None:
    mast = Mast()
    setattr(mast.axes[0], excuse, True)
    assert mast.points((119.0, 30.0), (121.0, 30.0)) == []


def test_a_sensor_that_is_wrong_by_more_than_the_margin() -> None:
    mast = Mast()
    mast.cases[0].slack_deg = 10.0
    assert mast.points((119.0, 30.0), (121.0, 30.0)) == []
    assert mast.points((119.0, 30.0), (130.0, 30.0)) == [FORBIDDEN]
