"""Calibration tables between degrees and what a device is told."""

from __future__ import annotations

import pytest

from hw.drives.scale import Scale
from hw.ports import HardwareError

SERVO = Scale("azimuth servo", ((0, 520), (90, 1470), (180, 2480)))
UPSIDE_DOWN = Scale("elevation servo", ((90, 1000), (0, 2000)))


@pytest.mark.parametrize(
    ("scale", "angle_deg", "value"),
    [(SERVO, 0, 520), (SERVO, 45, 995), (SERVO, 90, 1470), (SERVO, 180, 2480), (UPSIDE_DOWN, 22.5, 1750)],
)
def test_a_straight_line_between_points_both_ways(scale: Scale, angle_deg: float, value: float) -> None:
    assert scale.value(angle_deg) == pytest.approx(value)
    assert scale.angle_deg(value) == pytest.approx(angle_deg)


@pytest.mark.parametrize("angle_deg", [-0.1, 180.1, float("nan")])
def test_outside_the_table(angle_deg: float) -> None:
    with pytest.raises(HardwareError, match=r"azimuth servo: .* outside its calibration table, 0° to 180°"):
        SERVO.value(angle_deg)


@pytest.mark.parametrize(
    ("points", "said"),
    [
        ((), "at least two"),
        (((0, 500),), "at least two"),
        (((0, 500), (0, 600)), "turns back"),
        (((0, 500), (90, 1500), (180, 1400)), "turns back"),
        (((0, 500), (90, 500)), "the same value"),
    ],
)
def test_a_table_that_is_none(points: tuple[tuple[float, float], ...], said: str) -> None:
    with pytest.raises(HardwareError, match=said):
        Scale("elevation servo", points)
