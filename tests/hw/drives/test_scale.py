"""The calibration table between degrees and the number a device is given."""

from __future__ import annotations

import pytest

from hw.drives.scale import CommandScale
from hw.ports import HardwareError
from tests.tables import every_row

SERVO = CommandScale("azimuth servo", ((0, 520), (90, 1470), (180, 2480)))
UPSIDE_DOWN = CommandScale("elevation servo", ((90, 1000), (0, 2000)))


@every_row(
    ("scale", "angle_deg", "value"),
    [(SERVO, 0, 520), (SERVO, 45, 995), (SERVO, 90, 1470), (SERVO, 180, 2480), (UPSIDE_DOWN, 22.5, 1750)],
)
def test_a_straight_line_between_points_both_ways(scale: CommandScale, angle_deg: float, value: float) -> None:
    assert scale.value(angle_deg) == pytest.approx(value)
    assert scale.angle_deg(value) == pytest.approx(angle_deg)


@pytest.mark.parametrize("angle_deg", [-0.1, 180.1, float("nan")])
def test_outside_the_table(angle_deg: float) -> None:
    with pytest.raises(HardwareError, match=r"azimuth servo: .* outside its calibration table, 0° to 180°"):
        SERVO.value(angle_deg)
