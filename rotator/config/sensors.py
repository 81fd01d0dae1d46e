"""The tables [azimuth.sensor], [elevation.sensor] and [compass]: angle sensors, and the compass that finds north.

Knows their keys, and how each sensor's angle is known. Knows no register.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from hw.ports import AngleSource
from rotator.config.angle import Angle
from rotator.config.chips import I2CChip
from rotator.config.table import I2CAddress, I2CBus, Table

MPU6050_BEHIND_S = 0.32
"""It averages over 0.3 s, after a filter of 14 ms. While the motor shakes it, older readings alone count."""
Arrow = Literal["+x", "-x", "+y", "-y", "+z", "-z"]


class SensorTable(Table):
    kind: Literal["own", "pot", "as5600", "mpu6050"] = "own"
    """What belongs to `rotor.type`; a pot on the converter; an AS5600 under a magnet; an MPU6050 on the boom
    (elevation only)."""
    bus: I2CBus = 1
    """The bus of an AS5600 or MPU6050."""
    address: I2CAddress | None = None
    """Left out: AS5600 0x36, MPU6050 0x68."""
    zero_turn: float = Field(0.0, ge=0, lt=1)
    """AS5600: where in its turn the reading jumps from 1 to 0: outside the axis's range."""
    forward: Arrow = "+x"
    """MPU6050: the board's arrow along the boom."""
    up: Arrow = "+z"
    """MPU6050: the arrow that points up, the boom level."""
    averaged: int = Field(4, ge=1, le=16)
    """MPU6050: readings in an average, within 0.3 s."""

    @property
    def angle(self) -> Angle | None:
        """How the angle is known; None for the sensor of the kind of rotor."""
        match self.kind:
            case "own":
                return None
            case "pot":
                return Angle(AngleSource.MEASURED, in_degrees=False, pot=True)
            case "as5600":
                return Angle(AngleSource.MEASURED, in_degrees=False, sensor="encoder")
            case "mpu6050":
                tilt, by = "tilt sensor", "told by gravity"
                return Angle(AngleSource.MEASURED, sensor=tilt, by=by, behind_s=MPU6050_BEHIND_S)

    @property
    def i2c(self) -> tuple[int, int] | None:
        """Bus and address of the sensor chip; None for `own` and a pot."""
        usual = {"as5600": 0x36, "mpu6050": 0x68}
        if self.kind not in usual:
            return None
        return self.bus, usual[self.kind] if self.address is None else self.address

    def chips(self, key: str) -> list[I2CChip]:
        """The sensor chip, empty for `own` and a pot. `key`: the key of its address in the file."""
        return [I2CChip(*self.i2c, key, self.kind.upper())] if self.i2c else []

    @model_validator(mode="after")
    def _arrows_differ(self) -> SensorTable:
        if self.forward[1] == self.up[1]:
            raise ValueError(f'forward = "{self.forward}" and up = "{self.up}" are the same axis of the board')
        return self


class CompassTable(Table):
    kind: Literal["none", "bno055"] = "none"
    """A BNO055 on the boom finds north; it never steers."""
    bus: I2CBus = 3
    """On a Pi before the 5 a bus of dtoverlay=i2c-gpio: bus 1 fails with this chip's clock stretching."""
    address: I2CAddress = 0x28
    """0x28 with its ADR pin low, 0x29 high."""
    mounting: Literal["P0", "P1", "P2", "P3", "P4", "P5", "P6", "P7"] = "P1"
    """The mounting, as in the data sheet; P1: flat, chip up."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """The boom's direction, clockwise from the forward arrow of the compass."""
    at_start: bool = False
    """A moteus that does not know its azimuth takes it from the compass, after `rotator calibrate north`."""

    def chips(self) -> list[I2CChip]:
        """The compass chip; empty without a compass."""
        return [I2CChip(self.bus, self.address, "compass.address", "BNO055")] if self.kind == "bno055" else []
