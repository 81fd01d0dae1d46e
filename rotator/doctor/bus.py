"""The checks of the I2C bus: the adapter, the devices on it, and what the pots read.

Knows which addresses such devices have, and what a reading outside the window means. While the box is running it reads
no pot: starting a conversion would spoil one of the box's own.
"""

from __future__ import annotations

from collections.abc import Iterator
from statistics import fmean

from hw.ports import HardwareError
from rotator.config.axes import AxisTable
from rotator.config.model import Config
from rotator.doctor.chips import Bus, Chips
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running

CONVERTERS = range(0x48, 0x4C)
BACKPACKS = (*range(0x20, 0x28), *range(0x38, 0x40))
"""The PCF8574 and the PCF8574A."""
SAMPLES = 20
UNSTEADY = 0.02
"""Of the supply, from the least to the most of the samples: an antenna at rest, or turning, gives far less."""
AT_RAIL = 0.01

WIRING = "Check its power, SDA and SCL, and that the two are not swapped."


def i2c_bus(machine: Machine, config: Config) -> Iterator[Finding]:
    for number in sorted({bus for bus, _ in _devices(config).values()}):
        try:
            with machine.chips.bus(number):
                yield fine(f"/dev/i2c-{number}")
        except HardwareError as fault:
            if isinstance(fault.__cause__, PermissionError):
                yield wrong(str(fault), f"sudo usermod -aG i2c {machine.user}, then log in again.")
            else:
                yield wrong(str(fault), "sudo rotator setup pins switches it on; then reboot. Is the bus number right?")


def i2c_devices(machine: Machine, config: Config) -> Iterator[Finding]:
    for table, (number, address) in _devices(config).items():
        try:
            with machine.chips.bus(number) as bus:
                taken = {there for on, there in _devices(config).values() if on == number}
                yield _device(bus, table, address, taken)
        except HardwareError:
            yield skipped(f"{table}: the bus cannot be opened")


def _device(bus: Bus, table: str, address: int, taken: set[int]) -> Finding:
    usual = CONVERTERS if table == "adc" else BACKPACKS
    try:
        if bus.answers(address):
            return fine(f"{table}: 0x{address:02x} answers")
        others = [other for other in usual if other not in taken and bus.answers(other)]
    except HardwareError as fault:
        return wrong(f"{table}: {fault}", "Unplug one device after the other; switch the 5 V off and on.")
    if others:
        seen = " and ".join(f"0x{other:02x}" for other in others)
        return wrong(f"{table}: 0x{address:02x} does not answer, {seen} does", f"{table}.address = 0x{others[0]:02x}")
    return wrong(f"{table}: 0x{address:02x} does not answer, nor does any other usual address", WIRING)


def pots(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        if box_is_running(machine, config):
            yield skipped("the box is running and reads them itself; its terminal or log tells")
            return
    except HardwareError:
        yield skipped("not read: the box may be running, and the GPIO chip cannot be asked")
        return
    try:
        with machine.chips.bus(config.adc.bus) as bus:
            if bus.answers(config.adc.address):
                yield from _readings(machine.chips, bus, config)
            else:
                yield skipped("the converter does not answer")
    except HardwareError:
        yield skipped("the bus cannot be asked")


def _readings(chips: Chips, bus: Bus, config: Config) -> Iterator[Finding]:
    adc = config.adc
    converter = chips.converter(bus, config)
    axes = (("azimuth", config.azimuth, adc.azimuth_channel), ("elevation", config.elevation, adc.elevation_channel))
    try:
        volts = {channel: [converter.volts(channel) for _ in range(SAMPLES)] for _, _, channel in axes}
    except HardwareError as fault:
        yield wrong(str(fault), "A sick chip, or not an ADS1115 at adc.address.")
        return
    try:
        supply_v = chips.supply_v(converter, config)
    except HardwareError as fault:
        yield wrong(str(fault), f"Wire the pots' supply to A{adc.reference_channel}, or remove adc.reference_channel.")
        return
    for axis, table, channel in axes:
        yield _reading(axis, table, channel, supply_v, volts[channel])


def _reading(axis: str, table: AxisTable, channel: int, supply_v: float, volts: list[float]) -> Finding:
    readings = [sample_v / supply_v for sample_v in volts]
    least, most, mean = min(readings), max(readings), fmean(readings)
    if most - least > UNSTEADY:
        return wrong(
            f"{axis}: unsteady, {least:.3f} to {most:.3f} on A{channel}",
            "A loose wire or plug, an input that is not wired, or RF: see pot jumps in docs/troubleshooting.md.",
        )
    found = f"{axis}: {mean:.3f} of the supply, {fmean(volts):.2f} V on A{channel}"
    if table.lowest_reading <= mean <= table.highest_reading:
        return fine(found)
    outside = f"{found}, outside {table.lowest_reading:g} to {table.highest_reading:g}"
    if mean > 1 + AT_RAIL:
        return wrong(
            outside, "The pot hangs on more than adc.supply_v says: on 5 V? See pots on 5 V in docs/wiring.md."
        )
    if mean >= 1 - AT_RAIL:
        return wrong(outside, "The pot's ground lead is broken, or its wiper is shorted to the supply.")
    if mean <= AT_RAIL:
        return wrong(outside, "Wiper or supply lead broken, wiper shorted to ground, or the pots' supply is off.")
    return wrong(
        outside,
        f"If the antenna stands at an end: fit end resistors (docs/wiring.md), or widen {axis}.lowest_reading "
        f"and {axis}.highest_reading.",
    )


def _devices(config: Config) -> dict[str, tuple[int, int]]:
    """Which table of the file describes what on which bus, at which address."""
    devices = {"adc": (config.adc.bus, config.adc.address)}
    if config.lcd.kind == "pcf8574":
        devices["lcd"] = (config.lcd.bus, config.lcd.address)
    return devices
