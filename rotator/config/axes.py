"""The tables of the two axes: their range, their motor, their sensor.

Knows the words of the file for an axis. Knows no hardware.
"""

from __future__ import annotations

from itertools import pairwise

from pydantic import Field, model_validator

from rotator.config.sensors import SensorTable
from rotator.config.table import Point, Table


class AxisTable(Table):
    min_deg: float = Field(0.0, ge=-360, le=720)
    """The lowest angle it may be sent to, on the rotor's own scale."""
    max_deg: float = Field(450.0, ge=-360, le=720)
    """The highest angle it may be sent to; above 360 on azimuth: overlap."""
    tolerance_deg: float = Field(4.0, gt=0, le=45)
    """How far off on the sky the antenna may be before a motor starts."""
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's speed, roughly: the box measures it as it goes."""
    coast_s: float = Field(0.17, ge=0, le=5)
    """How long the motor goes on after it is switched off, as time at full speed."""
    calibration: list[Point] | None = None
    """Points [reading, degrees]; the reading is the wiper's share of the pot's supply, 0 to 1."""
    lowest_reading: float = Field(0.02, ge=-0.1, le=1)
    """A reading below this means a broken wire or a shorted pot."""
    highest_reading: float = Field(0.98, ge=0, le=1.1)
    """A reading above this means the same; end resistors keep every valid angle between the two."""
    sensor: SensorTable = SensorTable()
    """The sensor of the axis's angle."""
    direction_checked: bool = False
    """Set it when you have seen that CW turns clockwise and UP up."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """Added to the rotor's own scale: where the antenna points when the scale says 0."""
    longest_run_s: float = Field(300.0, ge=0, le=86_400)
    """How long the motor may run before it has to rest; running and resting add up. 0: without limit."""
    rest_s: float = Field(300.0, gt=0, le=86_400)
    """How long it takes to cool after that; it may run again after half of this time."""

    @model_validator(mode="after")
    def _make_sense(self) -> AxisTable:
        if self.min_deg >= self.max_deg:
            raise ValueError(f"min_deg ({self.min_deg:g}) must be below max_deg ({self.max_deg:g})")
        if self.lowest_reading >= self.highest_reading:
            raise ValueError("lowest_reading must be below highest_reading")
        points = self.calibration
        if points is not None:
            if len(points) < 2:
                raise ValueError("calibration needs two points or more, each [reading, degrees]")
            if any(b[1] <= a[1] for a, b in pairwise(points)):
                raise ValueError("calibration: degrees must rise from point to point")
            rises = [b[0] > a[0] for a, b in pairwise(points)]
            if any(b[0] == a[0] for a, b in pairwise(points)) or len(set(rises)) != 1:
                raise ValueError("calibration: readings must rise, or fall, all the way")
        return self


class Azimuth(AxisTable):
    pass


class Elevation(AxisTable):
    min_deg: float = Field(0.0, ge=-90, le=180)
    """The lowest elevation it may be sent to; where it rests below the horizon."""
    max_deg: float = Field(180.0, ge=0, le=210)
    """The highest elevation it may be sent to; 90 for a rotor that cannot go over the top."""
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's speed, roughly: the box measures it as it goes."""
