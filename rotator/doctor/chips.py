"""The checks of the I2C buses and the chips on them: pots on a converter, sensors of an angle, the BNO055.

Knows which readings are plausible, and the likely cause of each bad one. Knows no register. A conversion started here
would spoil one of a running box.
"""

from __future__ import annotations

from collections.abc import Iterator
from statistics import fmean

from hw.ports import Axis, FeelsField, HardwareError
from rotator.assembly.adc import Converter
from rotator.assembly.chips import Bus, Chips
from rotator.config.axes import AxisTable
from rotator.config.chips import ADDRESSES, I2CChip
from rotator.config.model import Config
from rotator.config.sensors import TILTS, SensorTable
from rotator.doctor.finding import Finding, fine, refused, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.setup.pi import known
from rotator.setup.pins import HEADER_BUS

SAMPLES = 20
UNSTEADY = 0.02
"""Largest spread of the samples, as a share of the supply. An antenna at rest, or turning, gives far less."""
AT_RAIL = 0.01
"""A reading this near to 0 or to the supply, as a share of it, means a broken or shorted wire."""

WIRING = "Check its power, SDA and SCL, and that the two are not swapped."


def i2c_bus(machine: Machine, config: Config) -> Iterator[Finding]:
    for number in sorted({chip.bus for chip in config.chips()}):
        try:
            with machine.chips.bus(number):
                yield fine(f"/dev/i2c-{number}")
        except HardwareError as fault:
            if isinstance(fault.__cause__, PermissionError):
                yield wrong(str(fault), f"sudo usermod -aG i2c {machine.user}, then log in again.")
            else:
                yield wrong(str(fault), "sudo rotator setup pins switches it on; then reboot. Is the bus number right?")


def i2c_devices(machine: Machine, config: Config) -> Iterator[Finding]:
    for chip in config.chips():
        taken = {other.address for other in config.chips() if other.bus == chip.bus}
        try:
            with machine.chips.bus(chip.bus) as bus:
                yield _device(bus, chip, set(ADDRESSES.get(chip.part, ())) - taken)
        except HardwareError:
            yield skipped(f"{chip_name(chip.key)}: the bus cannot be opened")


def chip_name(key: str) -> str:
    """`adc` for adc.address, `panel.adc` for panel.adc_address."""
    return key.removesuffix("address").rstrip("._")


def _device(bus: Bus, chip: I2CChip, elsewhere: set[int]) -> Finding:
    name, address, key = chip_name(chip.key), chip.address, chip.key
    try:
        if bus.answers(address):
            return fine(f"{name}: 0x{address:02x} answers")
        others = [other for other in sorted(elsewhere) if bus.answers(other)]
    except HardwareError as fault:
        return wrong(f"{name}: {fault}", "Unplug one device after the other; switch the 5 V off and on.")
    if others:
        seen = " and ".join(f"0x{other:02x}" for other in others)
        return wrong(f"{name}: 0x{address:02x} does not answer, {seen} does", f"{key} = 0x{others[0]:02x}")
    return wrong(f"{name}: 0x{address:02x} does not answer, nor does any other usual address", WIRING)


def pots(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        with machine.chips.converter(config) as converter:
            if converter.answers():
                yield from _readings(converter, config)
            elif config.adc.chips():  # the check of the I2C devices explains it
                yield skipped("the converter does not answer")
            else:
                yield wrong("the converter does not answer", config.adc.suspicion)
    except HardwareError:
        yield skipped("the bus cannot be read")


def _readings(converter: Converter, config: Config) -> Iterator[Finding]:
    adc = config.adc
    pots = {axis: adc.channel(axis) for axis in config.fitted if config.has_pot(axis)}
    try:
        volts = {channel: [converter.inputs.volts(channel) for _ in range(SAMPLES)] for channel in pots.values()}
    except HardwareError as fault:
        yield wrong(str(fault), adc.suspicion)
        return
    try:
        supply_v = converter.supply_v()
    except HardwareError as fault:
        supply = "" if adc.reference_channel is None else adc.input_name(adc.reference_channel)
        yield wrong(str(fault), f"Wire the pots' supply to {supply}, or remove adc.reference_channel.")
        return
    for axis, channel in pots.items():
        yield _reading(axis.value, config.axis(axis), adc.input_name(channel), supply_v, volts[channel])


def _reading(axis: str, table: AxisTable, pin: str, supply_v: float, volts: list[float]) -> Finding:
    readings = [sample_v / supply_v for sample_v in volts]
    least, most, mean = min(readings), max(readings), fmean(readings)
    if most - least > UNSTEADY:
        return wrong(
            f"{axis}: unsteady, {least:.3f} to {most:.3f} on {pin}",
            "A loose wire or plug, an input that is not wired, or RF: see: rotator help pot-jumps",
        )
    found = f"{axis}: {mean:.3f} of the supply, {fmean(volts):.2f} V on {pin}"
    if table.lowest_reading <= mean <= table.highest_reading:
        return fine(found)
    outside = f"{found}, outside {table.lowest_reading:g} to {table.highest_reading:g}"
    if mean > 1 + AT_RAIL:
        return wrong(outside, "The pot's supply is above adc.supply_v: is it 5 V? See: rotator help pots-on-5-v")
    if mean >= 1 - AT_RAIL:
        return wrong(outside, "The pot's ground lead is broken, or its wiper is shorted to the supply.")
    if mean <= AT_RAIL:
        return wrong(outside, "Wiper or supply lead broken, wiper shorted to ground, or the pots' supply is off.")
    return wrong(
        outside,
        f"If the antenna stands at an end: fit end resistors (rotator help wiring), or widen {axis}.lowest_reading "
        f"and {axis}.highest_reading.",
    )


NAMES = {"mt6701-ssi": "MT6701", "lsm303-accel": "LSM303DLHC", "lsm303-mag": "LSM303DLHC"}
"""What stands on a chip, where that is not the word of the file in capitals."""


def sensed(config: Config) -> list[Axis]:
    """The axes with a sensor chip."""
    return [axis for axis in config.fitted if config.axis(axis).sensor.kind not in ("own", "pot")]


def _printed(sensor: SensorTable) -> str:
    """The name that stands on the chip."""
    return NAMES.get(sensor.kind, sensor.kind.upper())


def counters(config: Config) -> list[Axis]:
    """The axes that an LS7366R counts."""
    keys = {key for use in config.kind.spi_uses() if use.table == "bridge" for key in use.selects}
    return [axis for axis in config.fitted if f"{axis.value}.select" in keys]


def sensors(machine: Machine, config: Config) -> Iterator[Finding]:
    for axis in sensed(config):
        table = config.axis(axis).sensor
        absent = _at(machine.chips, *table.i2c, f"{axis.value}: {_printed(table)}") if table.i2c else None
        yield absent or _angle(machine.chips, config, axis)
    for axis in counters(config):
        try:
            worth = "a place" if machine.chips.counter_placed(config, axis) else "no place yet"
            yield fine(f"{axis.value}: LS7366R answers, its count is {worth}")
        except HardwareError as fault:
            yield refused(axis.value, fault)
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


def _angle(chips: Chips, config: Config, axis: Axis) -> Finding:
    table = config.axis(axis)
    try:
        with chips.sensor(config, axis) as sensor:
            read = sensor.read()
            field_ut = sensor.field_ut if isinstance(sensor, FeelsField) else None
    except HardwareError as fault:
        return refused(axis.value, fault)
    place = table.sensor.i2c
    name = _printed(table.sensor) + (f" at 0x{place[1]:02x}" if place else "")
    if table.sensor.kind in TILTS:
        return fine(f"{axis.value}: {name} feels 1 g, {read:.1f}° up")
    if field_ut:
        ahead_ut, left_ut = field_ut
        found = f"{axis.value}: {name} feels {ahead_ut:.1f} µT ahead and {left_ut:.1f} µT to the left, {read:.0f}°"
        if table.sensor.learnt:
            return fine(found)
        return warn(f"{found}, not calibrated", "Run rotator calibrate compass; see: rotator help compass")
    return _turn(axis.value, table, name, read)


def _turn(axis: str, table: AxisTable, name: str, read: float) -> Finding:
    magnet = "it tells nothing of its magnet" if table.sensor.kind == "mt6701" else "its magnet is good"
    found = f"{axis}: {name}, {magnet}, {read:.3f} of a turn"
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
