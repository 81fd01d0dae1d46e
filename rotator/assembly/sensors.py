"""Opens the sensor chips of the axes with their drivers, as their tables describe them.

Part of the composition root. Pots, counts and controllers belong to other files. Does not judge readings.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.chips.adxl345 import Adxl345
from hw.chips.as5045 import As5045
from hw.chips.as5048 import As5048a, As5048b
from hw.chips.as5600 import As5600
from hw.chips.bno055 import Bno055
from hw.chips.hmc5883l import LSM303DLHC, Hmc5883l
from hw.chips.lsm303 import Lsm303Accelerometer
from hw.chips.mpu6050 import Mpu6050
from hw.chips.mt6701 import Mt6701, Mt6701Ssi
from hw.chips.qmc5883l import Qmc5883l
from hw.ports import Accelerometer, AngleSensor, Axis, Ellipse, I2CBus, Magnetometer
from hw.sensors.heading import HeadingSensor
from hw.sensors.mounting import Mounting
from hw.sensors.tilt import TiltSensor
from rotator.assembly.buses import Buses
from rotator.config.model import Config
from rotator.config.sensors import CompassTable

ON_I2C: dict[str, Callable[..., AngleSensor]] = {"as5600": As5600, "as5048b": As5048b, "mt6701": Mt6701}
ON_SPI: dict[str, Callable[..., AngleSensor]] = {"as5045": As5045, "as5048a": As5048a, "mt6701-ssi": Mt6701Ssi}
GRAVITY: dict[str, Callable[..., Accelerometer]] = {
    "mpu6050": Mpu6050,
    "adxl345": Adxl345,
    "lsm303-accel": Lsm303Accelerometer,
}


def sensor_chip(config: Config, axis: Axis, buses: Buses) -> AngleSensor | None:
    """The sensor chip of an axis; None: its table names no chip. Raises HardwareError."""
    limits, table = config.axis(axis), config.axis(axis).sensor
    mounting = Mounting(table.forward, table.up)

    def heading(chip: Magnetometer) -> HeadingSensor:
        ellipse = Ellipse(table.centre_ut, table.radius_ut) if table.radius_ut else None
        return HeadingSensor(chip, (limits.min_deg + limits.max_deg) / 2, mounting=mounting, ellipse=ellipse)

    for use in table.spi_uses(f"{axis.value}.sensor"):
        return ON_SPI[table.kind](buses.spi(use), "select", zero_turn=table.zero_turn)
    match table.kind, table.i2c:
        case kind, (number, address) if kind in GRAVITY:
            chip = GRAVITY[kind](buses.bus(number), buses.sleep, address)
            return TiltSensor(chip, buses.clock, mounting=mounting, averaged=table.averaged)
        case "qmc5883l", (number, address):
            return heading(Qmc5883l(buses.bus(number), buses.clock, buses.sleep, address))
        case "hmc5883l", (number, address):
            return heading(Hmc5883l(buses.bus(number), buses.sleep, address))
        case "lsm303-mag", (number, address):
            return heading(Hmc5883l(buses.bus(number), buses.sleep, address, LSM303DLHC))
        case kind, (number, address):
            return ON_I2C[kind](buses.bus(number), address, zero_turn=table.zero_turn)
        case _:
            return None


def compass_chip(
    table: CompassTable, bus: I2CBus, clock: Callable[[], float], sleep: Callable[[float], None]
) -> Bno055:
    return Bno055(bus, clock, sleep, address=table.address, mounting=table.mounting)
