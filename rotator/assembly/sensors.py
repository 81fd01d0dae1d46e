"""Opens the sensor chips of the axes (AS5600, MPU6050) with their drivers, as their tables describe them.

Part of the composition root. Pots, counts and controllers belong to other files. Does not judge readings.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.chips.as5600 import As5600
from hw.chips.bno055 import Bno055
from hw.chips.mpu6050 import Mounting, Mpu6050
from hw.ports import AngleSensor, I2CBus
from rotator.config.sensors import CompassTable, SensorTable


def sensor_chip(
    table: SensorTable, open_bus: Callable[[int], I2CBus], clock: Callable[[], float], sleep: Callable[[float], None]
) -> AngleSensor | None:
    """The sensor chip of an axis; None: the table names no chip. Raises HardwareError."""
    match table.kind, table.i2c:
        case "as5600", (number, address):
            return As5600(open_bus(number), address, zero_turn=table.zero_turn)
        case "mpu6050", (number, address):
            mounting = Mounting(table.forward, table.up)
            return Mpu6050(open_bus(number), clock, sleep, address=address, mounting=mounting, averaged=table.averaged)
        case _:
            return None


def compass_chip(
    table: CompassTable, bus: I2CBus, clock: Callable[[], float], sleep: Callable[[float], None]
) -> Bno055:
    return Bno055(bus, clock, sleep, address=table.address, mounting=table.mounting)
