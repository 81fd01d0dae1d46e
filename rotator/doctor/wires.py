"""The checks of the GPIO chip and its lines, and the test for a running box that other checks use.

Knows the key of every line, and the signs of a running box: its socket, and its names on lines. Takes no line, so these
checks also work while the box is running.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from hw.ports import HardwareError
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import SERVICE_FOLDERS, Machine

OURS = "rotator-"
"""The prefix of the names under which our programs hold lines."""
MONITOR = "monitor"
"""The socket of a running box, in systemd's folder or beside the state file."""


def lines(config: Config) -> dict[int, str]:
    """The GPIOs that the box takes, with their keys. The kernel holds those of its own SPI."""
    kernels = {key for use in config.spi_uses() if use.kernel for _, key in use.lines}
    return {pin: key for pin, key in config.pins() if key not in kernels}


def has_lines(config: Config) -> bool:
    return bool(lines(config))


def gpio_chip(machine: Machine, config: Config) -> Iterator[Finding]:
    try:
        chip = machine.chips.header(config)
        machine.chips.holders(config, [])
    except HardwareError as fault:
        yield wrong(str(fault), _chip_advice(machine, fault))
    else:
        yield fine(chip)


def gpio_lines(machine: Machine, config: Config) -> Iterator[Finding]:
    pins = lines(config)
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
    """Whether a program of ours runs this station: its socket is there, or it holds a line. Never in a simulation.

    Raises HardwareError if the GPIO chip cannot be asked.
    """
    if config.rotor.hardware == "sim":
        return False
    places = [str(folder / MONITOR) for folder in (*SERVICE_FOLDERS[:1], Path(config.state.path).parent)]
    if machine.listening.intersection([config.monitor.path or "", *places]):
        return True
    pins = lines(config)
    return bool(pins) and any(owner.startswith(OURS) for owner in machine.chips.holders(config, pins).values())


def running(machine: Machine, config: Config) -> Finding | None:
    """A finding if the chips must not be read now; None: they may be read."""
    try:
        if box_is_running(machine, config):
            return skipped("the box is running and reads them itself; see its terminal, or rotator where")
    except HardwareError:
        return skipped("not read: the box may be running, and the GPIO chip cannot be asked")
    return None


def gpios(pins: Iterable[int]) -> str:
    return "GPIO " + ", ".join(str(pin) for pin in pins)


def _chip_advice(machine: Machine, fault: HardwareError) -> str:
    if isinstance(fault.__cause__, PermissionError):
        return f"sudo usermod -aG gpio {machine.user}, then log in again."
    if isinstance(fault.__cause__, FileNotFoundError):
        return "Leave relays.chip out: the chip with the 40-pin header is then found by its label."
    return 'hardware = "pi" is for a Raspberry Pi: elsewhere name the chip with relays.chip, or set hardware = "sim".'
