"""The checks of relay and enable lines while no program drives them: as the Pi starts, and after a crash.

Knows which lines of config.txt drive a pin, the pulls of the pins, and that a Raspberry Pi's kernel keeps the level of
an output after its program has died. Writes nothing: `rotator setup pins` does.
"""

from __future__ import annotations

from collections.abc import Iterator

from rotator.config.kinds.kind import OffLine
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import gpios
from rotator.setup.boot_config import Setting, parameters, pins, settings
from rotator.setup.pi import known
from rotator.setup.pins import PULLED_UP, closing, off_lines

CONFIG_TXT = ("/boot/firmware/config.txt", "/boot/config.txt")
"""The paths since Debian 12, and before."""
SETUP = "sudo rotator setup pins, then reboot."


def has_relays(config: Config) -> bool:
    return bool(closing(config))


def has_lines(config: Config) -> bool:
    return bool(off_lines(config))


def released_lines(machine: Machine, config: Config) -> Iterator[Finding]:
    if config.rotor.hardware == "sim" or not machine.is_pi:
        yield skipped(_why_not(config))
        return
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
    if config.rotor.hardware == "sim" or not machine.is_pi:
        yield skipped(_why_not(config))
        return
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


def _why_not(config: Config) -> str:
    return "the rotor is simulated" if config.rotor.hardware == "sim" else "not a Raspberry Pi"


def _level(high: bool) -> str:
    return "high" if high else "low"
