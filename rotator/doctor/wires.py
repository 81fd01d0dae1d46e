"""The checks of the GPIO lines: is the chip there, and is each line free.

Knows what every line is for. Takes none of them, so it may look while the box is running.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from hw.ports import HardwareError
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine

OURS = "rotator-"
"""What the names begin with under which our programs hold their lines."""


def gpio_chip(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        chip = machine.chips.header(config)
        machine.chips.holders(config, [])
    except HardwareError as fault:
        yield wrong(str(fault), _chip_advice(machine, fault))
    else:
        yield fine(chip)


def gpio_lines(machine: Machine, config: Config) -> Iterator[Finding]:
    pins = {**relay_pins(config), **_other_pins(config)}
    try:
        held = machine.chips.holders(config, pins)
    except HardwareError:
        yield skipped("the chip cannot be asked")
        return
    for pin, owner in held.items():
        if not owner.startswith(OURS):
            yield wrong(
                f"{gpios([pin])}, {pins[pin]}, is held by {owner}",
                f"Stop that program, or remove the overlay from config.txt; or move {pins[pin]} to a free pin.",
            )
    if ours := [pin for pin, owner in held.items() if owner.startswith(OURS)]:
        yield fine(f"{gpios(ours)} held by the box: it is running")
    if free := [pin for pin in pins if pin not in held]:
        yield fine(f"{gpios(free)} free")


def box_is_running(machine: Machine, config: Config) -> bool:
    """Whether a program of ours holds a relay line. Raises HardwareError where that cannot be told."""
    return any(owner.startswith(OURS) for owner in machine.chips.holders(config, relay_pins(config)).values())


def relay_pins(config: Config) -> dict[int, str]:
    """The lines that close a contact, and the keys that name them."""
    return {pin: f"relays.{key}" for key, pin in config.relays.contacts.items()}


def gpios(pins: Iterable[int]) -> str:
    return "GPIO " + ", ".join(str(pin) for pin in pins)


def _other_pins(config: Config) -> dict[int, str]:
    pins = {} if config.relays.heartbeat is None else {config.relays.heartbeat: "relays.heartbeat"}
    if config.lcd.kind == "gpio":
        pins |= {getattr(config.lcd, key): f"lcd.{key}" for key in ("rs", "e", "d4", "d5", "d6", "d7")}
    return pins


def _chip_advice(machine: Machine, fault: HardwareError) -> str:
    if isinstance(fault.__cause__, PermissionError):
        return f"sudo usermod -aG gpio {machine.user}, then log in again."
    if isinstance(fault.__cause__, FileNotFoundError):
        return "Leave relays.chip out: the chip with the 40-pin header is then found by its label."
    return 'hardware = "pi" is for a Raspberry Pi: elsewhere name the chip with relays.chip, or set hardware = "sim".'
