"""The tables [azimuth] and [elevation]: range, motor, calibration and sensor of an axis.

Knows their keys, defaults and bounds, and the shape of a calibration. Knows no hardware.
"""

from __future__ import annotations

from itertools import pairwise

from pydantic import Field, model_validator

from rotator.config.sensors import SensorTable
from rotator.config.table import Point, Table


class AxisTable(Table):
    min_deg: float = Field(0.0, ge=-360, le=720)
    """The lowest angle of an order, on the rotor's own scale."""
    max_deg: float = Field(450.0, ge=-360, le=720)
    """The highest angle of an order; an azimuth above 360 is overlap."""
    tolerance_deg: float = Field(4.0, gt=0, le=45)
    """The pointing error on the sky at which a motor starts."""
    speed_dps: float = Field(6.0, gt=0, le=360)
    """The motor's speed, roughly: the box learns the exact one."""
    coast_s: float = Field(0.17, ge=0, le=5)
    """How far the motor runs on when switched off, as seconds at full speed."""
    backlash_deg: float = Field(0.0, ge=0, le=10)
    """Play between sensor and antenna, where you know it: on passes that the box plans, each step allows for it."""
    calibration: list[Point] | None = None
    """Points [reading, degrees]; the reading is the wiper's share of the pot's supply, 0 to 1."""
    lowest_reading: float = Field(0.02, ge=-0.1, le=1)
    highest_reading: float = Field(0.98, ge=0, le=1.1)
    """Readings outside these mean a broken wire or a shorted pot; end resistors keep all others inside."""
    sensor: SensorTable = SensorTable()
    """The sensor of the axis's angle."""
    direction_checked: bool = False
    """Set it after you have seen the antenna turn clockwise on CW, up on UP."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """Where the antenna points when the rotor's own scale says 0."""
    longest_run_s: float = Field(300.0, ge=0, le=86_400)
    """The longest run from cold before the motor must rest; runs add up. 0: no limit."""
    rest_s: float = Field(300.0, gt=0, le=86_400)
    """The time to cool fully after that. The motor may run again after half of it."""

    @model_validator(mode="after")
    def _limits_and_calibration_fit(self) -> AxisTable:
        if self.min_deg >= self.max_deg:
            raise ValueError(self._limits_fault())
        if self.lowest_reading >= self.highest_reading:
            lowest, highest = self.lowest_reading, self.highest_reading
            raise ValueError(f"lowest_reading ({lowest:g}) must be below highest_reading ({highest:g})")
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

    def _limits_fault(self) -> str:
        """What to write, for limits that leave nothing between them. A limit that the file leaves out is named too."""
        least, most = f"min_deg ({self.min_deg:g})", f"max_deg ({self.max_deg:g})"
        rule = f"{least} must be below {most}"
        match "min_deg" in self.model_fields_set, "max_deg" in self.model_fields_set:
            case True, True if self.min_deg > self.max_deg:
                return f"{rule}: swap the two"
            case False, True:
                return f"{rule}; the file leaves min_deg out: write a greater max_deg, or a min_deg below it"
            case True, False:
                return f"{rule}; the file leaves max_deg out: write a lower min_deg, or a max_deg above it"
        return f"{rule}: write both stops of the rotor"


class Azimuth(AxisTable):
    pass


class Elevation(AxisTable):
    min_deg: float = Field(0.0, ge=-90, le=180)
    """Below 0 for a rotor that goes below the horizon."""
    max_deg: float = Field(180.0, ge=0, le=210)
    """90 for a rotor that cannot go over the top."""
    speed_dps: float = Field(2.7, gt=0, le=360)
    """The motor's speed, roughly: the box learns the exact one."""
