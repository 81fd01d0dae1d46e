"""The tables of the angle sensors, and of the compass that finds north.

Knows the words of the file for them. Knows no chip.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from hw.ports import AngleSource
from rotator.config.angle import Angle
from rotator.config.i2c import I2CChip
from rotator.config.table import I2CAddress, I2CBus, Table

Arrow = Literal["+x", "-x", "+y", "-y", "+z", "-z"]


class SensorTable(Table):
    kind: Literal["own", "pot", "as5600", "mpu6050"] = "own"
    """The sensor: `own` is that of the kind of rotor (a pot where there are relays, the count, the controller, or a
    model); else a pot on the converter, a magnet over an AS5600, or gravity by an MPU6050 on the boom (elevation)."""
    bus: I2CBus = 1
    """AS5600, MPU6050: the N of /dev/i2c-N; the header's bus is 1."""
    address: I2CAddress | None = None
    """AS5600, MPU6050: left out, 0x36 or 0x68."""
    zero_turn: float = Field(0.0, ge=0, lt=1)
    """AS5600: where in its turn the reading begins; put it outside the axis's range, for there it jumps."""
    forward: Arrow = "+x"
    """MPU6050: the board's arrow that points along the boom."""
    up: Arrow = "+z"
    """MPU6050: the board's arrow that points up while the boom is level."""
    averaged: int = Field(4, ge=1, le=16)
    """MPU6050: how many readings are averaged, within 0.3 s."""

    @property
    def angle(self) -> Angle | None:
        """How its angle is known; None: as the kind of rotor says."""
        match self.kind:
            case "own":
                return None
            case "pot":
                return Angle(AngleSource.MEASURED, in_degrees=False, pot=True)
            case "as5600":
                return Angle(AngleSource.MEASURED, in_degrees=False)
            case "mpu6050":
                return Angle(AngleSource.MEASURED, by="told by gravity")

    @property
    def i2c(self) -> tuple[int, int] | None:
        """Its bus and address; None: it is no chip of its own."""
        usual = {"as5600": 0x36, "mpu6050": 0x68}
        if self.kind not in usual:
            return None
        return self.bus, usual[self.kind] if self.address is None else self.address

    def chips(self, key: str) -> list[I2CChip]:
        """Its chip, where it has one of its own; `key` names its address in the file."""
        return [I2CChip(*self.i2c, key, self.kind.upper())] if self.i2c else []

    @model_validator(mode="after")
    def _stands(self) -> SensorTable:
        if self.forward[1] == self.up[1]:
            raise ValueError(f'forward = "{self.forward}" and up = "{self.up}" are the same axis of the board')
        return self


class CompassTable(Table):
    kind: Literal["none", "bno055"] = "none"
    """A BNO055 on the boom finds north for `rotator calibrate north`; it does not steer."""
    bus: I2CBus = 3
    """The N of /dev/i2c-N. On a Pi before the 5 not the header's bus 1, whose clock stretching spoils its answers:
    a bus of dtoverlay=i2c-gpio."""
    address: I2CAddress = 0x28
    """0x28 with its ADR pin low, 0x29 high."""
    mounting: Literal["P0", "P1", "P2", "P3", "P4", "P5", "P6", "P7"] = "P1"
    """How the board lies, by the data sheet's names; P1: flat, chip up."""
    offset_deg: float = Field(0.0, ge=-180, le=180)
    """Where the boom points, clockwise, as seen from the compass's own forward."""

    def chips(self) -> list[I2CChip]:
        """Its chip, where there is one."""
        return [I2CChip(self.bus, self.address, "compass.address", "BNO055")] if self.kind == "bno055" else []
