"""The tables [azimuth.sensor], [elevation.sensor] and [compass]: angle sensors, and the compass that finds north.

Knows their keys, and how each sensor's angle is known. Knows no register.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from pydantic import Field

from hw.ports import AngleSource
from rotator.config.chips import ADDRESSES, KERNEL_WIRES, I2CChip, SpiUse
from rotator.config.table import I2CAddress, I2CBus, Point, Table

TILTS = {"mpu6050": 0.32, "adxl345": 0.34, "lsm303-accel": 0.34}
"""The chips that feel gravity, and how old what a reading of theirs shows may be: the box averages over 0.3 s, after
the chip's own filter. While the motor shakes it, older readings alone count."""
COMPASSES = {"qmc5883l": 0.1, "hmc5883l": 0.1, "lsm303-mag": 0.1}
"""The compass chips, likewise: a result lasts 20 ms, and waits to be read."""
Arrow = Literal["+x", "-x", "+y", "-y", "+z", "-z"]
SPI_MODES = {"as5045": 2, "as5048a": 1, "mt6701-ssi": 2}
"""The mode of the clock for each kind of sensor on SPI."""


@dataclass(frozen=True, slots=True)
class Angle:
    """How the angle of an axis is known."""

    source: AngleSource
    in_degrees: bool = True
    """The readings are degrees on the rotor's own scale, and need no calibration."""
    pot: bool = False
    """A pot on the converter is read."""
    sensor: str = "pot"
    """What reads it, in a word for the messages of faults."""
    behind_s: float = 0.0
    """A reading shows a place where the axis was at most so long ago: the sensor filters, or averages."""
    by: str = ""
    """The source of the degrees, in words for the user; empty for a calibration."""


class SensorTable(Table):
    kind: Literal[
        "own", "pot", "as5600", "as5045", "as5048a", "as5048b", "mt6701", "mt6701-ssi",
        "mpu6050", "adxl345", "lsm303-accel", "qmc5883l", "hmc5883l", "lsm303-mag",
    ] = "own"  # fmt: skip
    """What belongs to `rotor.type`; a pot on the converter; an encoder under a magnet, on I2C (as5600, as5048b, mt6701)
    or SPI (as5045 and the HH-12, as5048a, mt6701-ssi); gravity, felt on the boom (elevation only: mpu6050, adxl345,
    lsm303-accel); a compass that turns level (azimuth only: qmc5883l, hmc5883l, lsm303-mag)."""
    bus: I2CBus = 1
    """The bus of a chip on I2C."""
    address: I2CAddress | None = None
    """Left out: AS5600 0x36, AS5048B 0x40, MT6701 0x06, MPU6050 0x68, ADXL345 0x53, QMC5883L 0x0D, HMC5883L 0x1E,
    LSM303DLHC 0x19 and 0x1E."""
    select: Literal[7, 8] = 8
    """The select line of a chip on SPI: 8 is CE0, 7 is CE1 of the Pi's own SPI."""
    zero_turn: float = Field(0.0, ge=0, lt=1)
    """Encoders: where in its turn the reading jumps from 1 to 0: outside the axis's range."""
    forward: Arrow = "+x"
    """Gravity, compass: the board's arrow along the boom."""
    up: Arrow = "+z"
    """Gravity, compass: the arrow that points up, the boom level."""
    averaged: int = Field(4, ge=1, le=16)
    """Gravity: readings in an average, within 0.3 s."""
    centre_ut: Point = (0.0, 0.0)
    """Compass: the middle of the field ahead and to the left over a whole turn, in µT: what iron on the boom adds."""
    radius_ut: Point | None = None
    """Compass: half of the way from the least to the most field ahead, and to the left. Left out, it is not
    calibrated."""

    @property
    def angle(self) -> Angle | None:
        """How the angle is known; None for the sensor of the kind of rotor."""
        match self.kind:
            case "own":
                return None
            case "pot":
                return Angle(AngleSource.MEASURED, in_degrees=False, pot=True)
            case "as5600" | "as5045" | "as5048a" | "as5048b" | "mt6701" | "mt6701-ssi":
                return Angle(AngleSource.MEASURED, in_degrees=False, sensor="encoder")
            case "mpu6050" | "adxl345" | "lsm303-accel":
                tilt, by = "tilt sensor", "told by gravity"
                return Angle(AngleSource.MEASURED, sensor=tilt, by=by, behind_s=TILTS[self.kind])
            case "qmc5883l" | "hmc5883l" | "lsm303-mag":
                by = "told by a compass"
                return Angle(AngleSource.MEASURED, sensor="compass", by=by, behind_s=COMPASSES[self.kind])

    @property
    def i2c(self) -> tuple[int, int] | None:
        """Bus and address of the sensor chip; None where none is on I2C."""
        usual, *_ = ADDRESSES.get(self.kind.upper(), (None,))
        if usual is None:
            return None
        return self.bus, usual if self.address is None else self.address

    def chips(self, key: str) -> list[I2CChip]:
        """The sensor chip, where it is on I2C. `key`: the key of its address in the file."""
        return [I2CChip(*self.i2c, key, self.kind.upper())] if self.i2c else []

    def spi_uses(self, table: str) -> list[SpiUse]:
        """The sensor chip, where it is on SPI. `table`: the name of this table in the file."""
        if self.kind not in SPI_MODES:
            return []
        mode = SPI_MODES[self.kind]
        return [SpiUse(table, "encoder", {"select": self.select}, KERNEL_WIRES, kernel=True, mode=mode)]

    def faults(self) -> Iterator[str]:
        if self.forward[1] == self.up[1]:
            yield f'forward = "{self.forward}" and up = "{self.up}" are the same axis of the board'
        if self.radius_ut and min(self.radius_ut) <= 0:
            yield "radius_ut: both must be above 0"

    @property
    def learnt(self) -> bool:
        """Whether the sensor knows its own errors, as far as it has to."""
        return self.kind not in COMPASSES or self.radius_ut is not None


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
