"""The tables [azimuth] and [elevation]: range, motor, calibration and sensor of an axis.

Knows their keys, defaults and bounds, the shape of a calibration, a brake's table and a speed output's. Knows no
hardware.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, Literal

from pydantic import Field, model_validator

from rotator.config.chips import I2CChip
from rotator.config.sensors import SensorTable
from rotator.config.table import Gpio, I2CAddress, I2CBus, Point, Table


class BrakeTable(Table):
    line: Gpio | None = None
    """The output of the relay that feeds the brake's solenoid, at the level of the motor relays; left out, the axis has
    no brake."""
    release_s: float = Field(0.5, ge=0.3, le=1)
    """The motor starts this long after its brake was released."""
    engage_s: float = Field(4.0, ge=2, le=8)
    """The brake engages this long after the antenna has come to rest."""
    rock: bool = False
    """For a wedge that sticks: once, a short run the other way, then the wanted way."""

    def faults(self) -> Iterator[str]:
        if self.line is None and self.model_fields_set - {"line"}:
            yield "a brake needs its line, the GPIO of its relay; without a brake leave the whole table out"


class SpeedTable(Table):
    output: Literal["none", "pwm", "mcp4725"] = "none"
    """What makes the voltage of the speed input: the Pi's hardware PWM behind a filter, or an MCP4725 on I2C; none: the
    box does not set the speed."""
    pwm: Literal[12, 13, 18, 19] = 18
    """The GPIO of the hardware PWM."""
    pwm_hz: float = Field(2000.0, ge=100, le=100_000)
    """The frequency of the PWM, far above what its filter lets through."""
    bus: I2CBus = 1
    """The N of /dev/i2c-N with the MCP4725."""
    address: I2CAddress = 0x60
    """The MCP4725's address."""
    lowest: float = Field(0.0, ge=0, le=1)
    """The output's share, 0 to 1, at the lowest speed. The output has it whenever the motor is off."""
    full: float = Field(1.0, ge=0, le=1)
    """The output's share at full speed."""
    lowest_dps: float = Field(2.5, gt=0, le=360)
    """The motor's speed there; `speed_dps` of the axis is the full speed."""
    slow_start_s: float = Field(1.0, ge=0, le=10)
    """From the lowest speed to full speed."""
    slow_down_s: float = Field(2.0, ge=0, le=10)
    """From full speed to the lowest, before the target or a limit."""

    def faults(self) -> Iterator[str]:
        if self.output == "none" and self.model_fields_set - {"output"}:
            yield 'a speed output needs output = "pwm" or "mcp4725"; without one leave the whole table out'
        if self.lowest == self.full:
            yield f"lowest and full are both {self.full:g}: one voltage is one speed"

    def chips(self, key: str) -> list[I2CChip]:
        return [I2CChip(self.bus, self.address, key, "MCP4725")] if self.output == "mcp4725" else []


class AxisTable(Table):
    fitted: bool = True
    """false: the rotor does not have this axis. The antenna stands at `offset_deg` there; other keys are ignored."""
    endless: bool = False
    """true, of the azimuth alone: it turns on and on, as with slip rings, and always the short way. Leave `min_deg` and
    `max_deg` out."""
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
    sensor: SensorTable = SensorTable.model_construct()
    """The sensor of the axis's angle."""
    direction_checked: bool = False
    """Set it after you have seen the antenna turn clockwise on CW, up on UP."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """Where the antenna points when the rotor's own scale says 0."""
    longest_run_s: float = Field(300.0, ge=0, le=86_400)
    """The longest run from cold before the motor must rest; runs add up. 0: no limit."""
    rest_s: float = Field(300.0, gt=0, le=86_400)
    """The time to cool fully after that. The motor may run again after half of it."""
    brake: BrakeTable = BrakeTable.model_construct()
    """A brake that the box releases before each run, as a Ham IV has it."""
    speed: SpeedTable = SpeedTable.model_construct()
    """The input for the motor's speed, as a G-1000DXA has it."""

    @model_validator(mode="before")
    @classmethod
    def _stands(cls, values: Any) -> Any:
        """An axis that is not fitted has one place, 0 on its own scale; of one without ends a turn stands for all."""
        if isinstance(values, dict) and values.get("fitted") is False:
            return {**values, "min_deg": 0.0, "max_deg": 0.0}
        if isinstance(values, dict) and values.get("endless") is True and cls is not Elevation:
            return {"min_deg": 0.0, "max_deg": 360.0, **values}
        return values

    def faults(self) -> Iterator[str]:
        if self.min_deg >= self.max_deg and self.fitted:
            yield self._limits_fault()
        lowest, highest, points = self.lowest_reading, self.highest_reading, self.calibration
        if lowest >= highest:
            yield f"lowest_reading ({lowest:g}) must be below highest_reading ({highest:g})"
        if points is None:
            return
        steps = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)]
        if not steps:
            yield "calibration needs two points or more, each [reading, degrees]"
        elif any(degrees <= 0 for _, degrees in steps):
            yield "calibration: degrees must rise from point to point"
        elif not (all(reading > 0 for reading, _ in steps) or all(reading < 0 for reading, _ in steps)):
            yield "calibration: readings must rise, or fall, all the way"

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
