"""The checks of the I2C buses, of the chips on them, and of the pots on a converter.

Knows the likely cause of each bad reading. A conversion started here
would spoil one of a running box.
"""

from __future__ import annotations

from collections.abc import Iterator
from statistics import fmean

from hw.ports import Axis, HardwareError
from rotator.assembly.adc import Converter
from rotator.assembly.chips import Bus
from rotator.config.axes import AxisTable
from rotator.config.chips import ADDRESSES, I2CChip
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine

SAMPLES = 20
UNSTEADY = 0.02
"""Largest spread of the samples, as a share of the supply. An antenna at rest, or turning, gives far less."""
AT_RAIL = 0.01
"""A reading this near to 0 or to the supply, as a share of it, means a broken or shorted wire."""

WIRING = "Check its power, SDA and SCL, and that the two are not swapped."


def has_chips(config: Config) -> bool:
    return bool(config.chips())


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


def has_pots(config: Config) -> bool:
    return config.uses_adc


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
    pots = {axis: adc.channel(axis) for axis in Axis if config.has_pot(axis)}
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
