"""The drawing of a calibration's residuals: arrows as long as the errors, the way that they point on the sky."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest

from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.pointing_model import PERFECT
from rotator.views.residual_svg import LONGEST_PX, residual_svg

SVG = "{http://www.w3.org/2000/svg}"


def arrows(points: list[SkyPoint], colour: str) -> list[tuple[float, float]]:
    """What each leads by: to the right on the paper, and down."""
    lines = ET.fromstring(residual_svg(points, PERFECT, replace(PERFECT, ie_deg=0.5))).iter(f"{SVG}polyline")
    ends = [
        [tuple(map(float, at.split(","))) for at in each.attrib["points"].split()]
        for each in lines
        if each.attrib["class"] == f"s-{colour}"
    ]
    return [(after[0] - before[0], after[1] - before[1]) for before, after in ends[: len(points)]]


@pytest.mark.parametrize(("azimuth_deg", "leads"), [(0.0, (0, 1)), (90.0, (-1, 0)), (180.0, (0, -1)), (270.0, (1, 0))])
def test_a_target_above_the_boom_leads_to_the_middle(azimuth_deg: float, leads: tuple[int, int]) -> None:
    ((right, down),) = arrows([SkyPoint(azimuth_deg, 30.0, azimuth_deg, 32.0)], "red")
    assert (right, down) == pytest.approx((leads[0] * LONGEST_PX, leads[1] * LONGEST_PX), abs=0.2)


def test_a_target_right_of_the_boom_leads_clockwise() -> None:
    ((right, down),) = arrows([SkyPoint(0.0, 0.0, 1.0, 0.0)], "red")
    assert right == pytest.approx(LONGEST_PX / 2, abs=0.2), "the longest by either model is 1.1°: the scale is 2°"
    assert down == pytest.approx(0.0, abs=1.0)


def test_by_the_new_model_the_arrows_are_as_long_as_what_is_left() -> None:
    points = [SkyPoint(at, 30.0, at, 31.0) for at in (10.0, 130.0, 250.0)]
    for right, down in arrows(points, "blue"):
        assert (right**2 + down**2) ** 0.5 == pytest.approx(LONGEST_PX / 2, abs=0.5)
