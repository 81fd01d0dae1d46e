"""The checks of the sensor chips: AS5600 (magnet), MPU6050 (gravity) and BNO055 (compass).

Knows which readings are plausible. Knows no register: the drivers do.
"""

from __future__ import annotations

from collections.abc import Iterator

from hw.ports import Axis, HardwareError
from rotator.assembly.chips import Bus, Chips
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, refused, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.setup.pi import known

HEADER_BUS = 1
NAMES = {"as5600": "AS5600", "mpu6050": "MPU6050"}


def has_sensors(config: Config) -> bool:
    return config.compass.kind != "none" or any(config.axis(axis).sensor.i2c for axis in Axis)


def sensors(machine: Machine, config: Config) -> Iterator[Finding]:
    for axis in Axis:
        table = config.axis(axis)
        if place := table.sensor.i2c:
            yield _at(machine.chips, *place, f"{axis.value}: {NAMES[table.sensor.kind]}") or _angle(
                machine.chips, *place, config, axis
            )
    if config.compass.kind != "none":
        place = config.compass.bus, config.compass.address
        yield _at(machine.chips, *place, "compass: BNO055") or _compass(machine, config)


def _at(chips: Chips, number: int, address: int, name: str) -> Finding | None:
    """A finding if the chip cannot be read (the check of the I2C devices has the details); None: it can be read."""
    try:
        with chips.bus(number) as bus:
            return None if bus.answers(address) else skipped(f"{name} does not answer")
    except HardwareError:
        return skipped(f"{name}: the bus cannot be read")


def _angle(chips: Chips, number: int, address: int, config: Config, axis: Axis) -> Finding:
    table = config.axis(axis)
    with chips.bus(number) as bus:
        try:
            read = chips.sensor(bus, config, axis).read()
        except HardwareError as fault:
            return refused(axis.value, fault)
    if table.sensor.kind == "mpu6050":
        return fine(f"{axis.value}: MPU6050 at 0x{address:02x} feels 1 g, {read:.1f}° up")
    return _turn(axis.value, table, f"AS5600 at 0x{address:02x}", read)


def _turn(axis: str, table: AxisTable, name: str, read: float) -> Finding:
    found = f"{axis}: {name}, its magnet is good, {read:.3f} of a turn"
    if table.lowest_reading <= read <= table.highest_reading:
        return fine(found)
    return wrong(
        f"{found}, outside {table.lowest_reading:g} to {table.highest_reading:g}",
        f"Here its reading jumps: put {axis}.sensor.zero_turn outside the axis's range, and calibrate again.",
    )


def _compass(machine: Machine, config: Config) -> Finding:
    table = config.compass
    with machine.chips.bus(table.bus) as bus:
        try:
            found = _heading(machine.chips, bus, config)
        except HardwareError as fault:
            return refused("compass", fault)
    pi = known(machine.model)
    if table.bus == HEADER_BUS and machine.is_pi and not (pi and "pi5" in pi.filters):
        return warn(
            f"{found}; on bus 1 this Pi's controller garbles its answers",
            "Give it a bus of its own, dtoverlay=i2c-gpio,bus=3 in config.txt, and compass.bus = 3.",
        )
    return fine(found)


def _heading(chips: Chips, bus: Bus, config: Config) -> str:
    compass = chips.compass(bus, config)
    heading_deg, learnt = compass.heading_deg(), compass.calibration()
    return (
        f"compass: BNO055 at 0x{config.compass.address:02x}, {heading_deg:.0f}° magnetic, "
        f"magnetometer calibrated {learnt.magnetometer} of 3"
    )
