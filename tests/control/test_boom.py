"""What the displays add to the angles of the axes on a mount that leans."""

from __future__ import annotations

import pytest

from rotator.control.boom import with_boom
from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.pointing_model import PointingModel
from rotator.exchange.status import AxisStatus

LEANS = Mount(Range(0, 450), Range(5, 90), model=PointingModel(ia_deg=3.0, ie_deg=-1.0, an_deg=2.0))


def axes(azimuth_deg: float | None, elevation_deg: float | None) -> tuple[AxisStatus, AxisStatus]:
    return AxisStatus(0, 450, angle_deg=azimuth_deg), AxisStatus(5, 90, angle_deg=elevation_deg)


@pytest.mark.parametrize(("azimuth_deg", "elevation_deg"), [(20.0, 40.0), (400.0, 10.0), (200.0, 85.0)])
def test_the_correction_leads_from_the_axes_to_where_the_boom_points(azimuth_deg: float, elevation_deg: float) -> None:
    azimuth, elevation = with_boom(LEANS, *axes(azimuth_deg, elevation_deg))
    there = azimuth_deg + azimuth.correction_deg, elevation_deg + elevation.correction_deg
    assert there == pytest.approx(LEANS.pointed(azimuth_deg, elevation_deg))
    assert 1.0 < abs(azimuth.correction_deg) < 10.0
    assert elevation.correction_deg != 0.0


def test_an_elevation_that_is_not_known_is_taken_at_its_minimum() -> None:
    azimuth, elevation = with_boom(LEANS, *axes(20.0, None))
    there = 20.0 + azimuth.correction_deg, 5.0 + elevation.correction_deg
    assert there == pytest.approx(LEANS.pointed(20.0, 5.0))


def test_without_an_azimuth_nothing_is_corrected() -> None:
    assert with_boom(LEANS, *axes(None, 40.0)) == axes(None, 40.0)


def test_a_mount_that_stands_upright_needs_no_correction() -> None:
    assert with_boom(Mount(Range(0, 450), Range(5, 90)), *axes(20.0, 40.0)) == axes(20.0, 40.0)
