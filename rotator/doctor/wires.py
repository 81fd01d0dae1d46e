"""The checks of GPIO lines: while the box runs, as the Pi starts and after a crash; and whether a box runs.

Knows the key of every line, the signs of a running box (its socket, and its names on lines), which lines of config.txt
drive a pin, the pulls of the pins, and that a Raspberry Pi's kernel keeps the level of an output after its program has
died. Takes no line, so these checks also work while the box is running, and writes nothing: `rotator setup pins` does.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from hw.ports import HardwareError
from rotator.config.kinds.kind import OffLine
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import SERVICE_FOLDERS, Machine
from rotator.setup.boot_config import Setting, parameters, pins, settings
from rotator.setup.pi import known
from rotator.setup.pins import PULLED_UP, off_lines

OURS = "rotator-"
"""The prefix of the names under which our programs hold lines."""
MONITOR = "monitor"
"""The socket of a running box, in systemd's folder or beside the state file."""


def lines(config: Config) -> dict[int, str]:
    """The GPIOs that the box takes, with their keys. The kernel holds those of its own SPI."""
    kernels = {key for use in config.spi_uses() if use.kernel for _, key in use.lines}
    return {pin: key for pin, key in config.pins() if key not in kernels}


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
        yield fine(f"{gpios(free)}: free")


def box_is_running(machine: Machine, config: Config) -> bool | None:
    """Whether a program of ours runs this station: its socket is there, or it holds a line. Never in a simulation.

    None: the GPIO chip cannot be asked.
    """
    if config.simulated:
        return False
    places = [str(folder / MONITOR) for folder in (*SERVICE_FOLDERS[:1], Path(config.state.path).parent)]
    if machine.listening.intersection([config.monitor.path or "", *places]):
        return True
    ours = lines(config)
    try:
        held = machine.chips.holders(config, ours) if ours else {}
    except HardwareError:
        return None
    return any(owner.startswith(OURS) for owner in held.values())


def running(machine: Machine, config: Config) -> Finding | None:
    """A finding if the chips must not be read now; None: they may be read."""
    match box_is_running(machine, config):
        case True:
            return skipped("the box is running and reads them itself; see its terminal, or rotator where")
        case None:
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


CONFIG_TXT = ("/boot/firmware/config.txt", "/boot/config.txt")
"""The paths since Debian 12, and before."""
SETUP = "sudo rotator setup pins, then reboot."


def released_lines(machine: Machine, _config: Config) -> Iterator[Finding]:
    pi = known(machine.model)
    driver = "pinctrl_rp1" if pi and "pi5" in pi.filters else "pinctrl_bcm2835"
    persist = machine.text(f"/sys/module/{driver}/parameters/persist_gpio_outputs")
    written = [is_on for _, is_on in parameters(in_effect(machine), "strict_gpiod")][-1:] == [True]
    if persist == "N":
        yield fine("the kernel lets a line go when its program dies")
    elif persist is None:
        yield warn(
            f"this kernel does not say what it does when a program dies ({driver} has no persist_gpio_outputs)",
            "On Raspberry Pi OS: sudo apt full-upgrade, then sudo rotator setup pins. Debian's own kernel lets go.",
        )
    elif written:
        yield wrong("strict_gpiod is in config.txt, and not yet in effect", "sudo reboot")
    else:
        yield wrong("the kernel keeps a relay on when the program dies: no dtparam=strict_gpiod", SETUP)


def boot_pins(machine: Machine, config: Config) -> Iterator[Finding]:
    levels = driven_at_boot(machine)
    # A heartbeat is off when it stands still, at either level.
    lines = {pin: line for pin, line in off_lines(config).items() if line.key != "relays.heartbeat"}
    driven_on = {pin: line for pin, line in lines.items() if levels.get(pin) is _on(line)}
    not_driven = {pin: line for pin, line in lines.items() if pin not in levels}
    for pin, line in driven_on.items():
        yield wrong(
            f"config.txt drives {gpios([pin])} {_level(_on(line))} at the start, which switches {line.key} on", SETUP
        )
    risky = {pin: line for pin, line in not_driven.items() if line.switches and (pin in PULLED_UP) is _on(line)}
    for level in (True, False):
        if pins := [pin for pin, line in risky.items() if _on(line) is level]:
            yield wrong(f"{gpios(pins)}: pulled {_level(level)} at the start, which closes the relay", SETUP)
    if quiet := [pin for pin in not_driven if pin not in risky]:
        yield warn(f"{gpios(quiet)}: off at the start by a weak pull only", SETUP)
    for level in (True, False):
        if pins := [pin for pin in lines if pin in levels and pin not in driven_on and levels[pin] is level]:
            yield fine(f"{gpios(pins)} driven {_level(level)}, off, a few seconds after power-on")


def _on(line: OffLine) -> bool:
    """The line's on level: True is high."""
    return not line.off_high


def in_effect(machine: Machine) -> list[Setting]:
    """The settings of config.txt that apply to this board."""
    text = next((text for path in CONFIG_TXT if (text := machine.text(path)) is not None), "")
    return [setting for setting in settings(text) if setting.may_hold_on(known(machine.model))]


def driven_at_boot(machine: Machine) -> dict[int, bool]:
    """The pins that config.txt makes outputs, with their levels. A later line wins."""
    levels: dict[int, bool] = {}
    for _, numbers, does in pins(in_effect(machine)):
        for pin in numbers:
            if {"dh", "dl"} & does and ("op" in does or pin in levels):
                levels[pin] = "dh" in does
            elif {"ip", "a0", "a1", "a2", "a3", "a4", "a5"} & does:
                levels.pop(pin, None)
    return levels


def _level(high: bool) -> str:
    return "high" if high else "low"
