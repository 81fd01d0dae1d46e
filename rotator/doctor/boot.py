"""The checks of what the Pi does with the relay lines when nobody holds them: at its start, and after a crash.

Knows config.txt as the firmware reads it, the pins' pulls, and the kernel's habit of leaving outputs as they were.
Writes nothing: `rotator setup pins` does.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import gpios, relay_pins

CONFIG_TXT = ("/boot/firmware/config.txt", "/boot/config.txt")
"""Where it is since Debian 12, and where it was before."""
# Which boards a [filter] of config.txt means (Raspberry Pi documentation, "Conditional filters").
FILTERS = {
    "all": ("",),
    "pi0": ("Raspberry Pi Zero",),
    "pi0w": ("Raspberry Pi Zero W",),
    "pi02": ("Raspberry Pi Zero 2",),
    "pi1": ("Raspberry Pi Model", "Raspberry Pi Compute Module Rev"),
    "pi2": ("Raspberry Pi 2",),
    "pi3": ("Raspberry Pi 3", "Raspberry Pi Compute Module 3"),
    "pi3+": ("Raspberry Pi 3 Model A Plus", "Raspberry Pi 3 Model B Plus"),
    "pi4": ("Raspberry Pi 4", "Raspberry Pi Compute Module 4"),
    "pi400": ("Raspberry Pi 400",),
    "pi5": ("Raspberry Pi 5", "Raspberry Pi Compute Module 5"),
    "pi500": ("Raspberry Pi 500",),
    "cm4": ("Raspberry Pi Compute Module 4",),
    "cm5": ("Raspberry Pi Compute Module 5",),
}
PULLED_UP, PULLED_DOWN = range(9), range(9, 28)
"""At power-on (BCM2835 ARM Peripherals, table 6-31; the Pi 5 does the same)."""

SETUP = "sudo rotator setup pins, then reboot."


def released_lines(machine: Machine, config: Config) -> Iterator[Finding]:
    if config.rotor.hardware == "sim" or not machine.is_pi:
        yield skipped(_why_not(config))
        return
    driver = "pinctrl_rp1" if machine.model.startswith(FILTERS["pi5"]) else "pinctrl_bcm2835"
    persist = machine.text(f"/sys/module/{driver}/parameters/persist_gpio_outputs")
    written = any("strict_gpiod" in _switched_on(line) for line in in_effect(machine))
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
    closes = config.relays.active == "high"
    pulled_on = PULLED_UP if closes else PULLED_DOWN
    pins = relay_pins(config)
    driven_on = {pin: key for pin, key in pins.items() if levels.get(pin) is closes}
    not_driven = [pin for pin in pins if pin not in levels]
    for pin, key in driven_on.items():
        yield wrong(f"config.txt drives {gpios([pin])} {_level(closes)} at the start, which closes {key}", SETUP)
    if risky := [pin for pin in not_driven if pin in pulled_on]:
        yield wrong(f"{gpios(risky)}: pulled {_level(closes)} at the start, which closes the relay", SETUP)
    if quiet := [pin for pin in not_driven if pin not in pulled_on]:
        yield warn(f"{gpios(quiet)}: off at the start by a weak pull only", SETUP)
    if len(driven_on) + len(not_driven) < len(pins):
        off = [pin for pin in pins if pin in levels and pin not in driven_on]
        yield fine(f"{gpios(off)} driven {_level(not closes)}, off, a few seconds after power-on")


def in_effect(machine: Machine) -> list[str]:
    """The lines of config.txt that count on this board, without its comments."""
    text = next((text for path in CONFIG_TXT if (text := machine.text(path)) is not None), "")
    lines, counts = [], True
    for line in (line.strip() for line in text.splitlines()):
        if line.startswith("[") and line.endswith("]"):
            counts = machine.model.startswith(FILTERS.get(line[1:-1].lower(), ("no such board",)))
        elif counts and line and not line.startswith("#"):
            lines.append(line)
    return lines


def driven_at_boot(machine: Machine) -> dict[int, bool]:
    """The pins that config.txt makes outputs, with their levels. A later line wins."""
    levels: dict[int, bool] = {}
    for line in in_effect(machine):
        if not (parts := re.fullmatch(r"gpio=([\d,-]+)=([a-z0-9,]+)", line)):
            continue
        does = parts[2].split(",")
        for pin in _pins(parts[1]):
            if {"dh", "dl"} & {*does} and ("op" in does or pin in levels):
                levels[pin] = "dh" in does
            elif {"ip", "a0", "a1", "a2", "a3", "a4", "a5"} & {*does}:
                levels.pop(pin, None)
    return levels


def _pins(text: str) -> Iterator[int]:
    for part in text.split(","):
        first, _, last = part.partition("-")
        if first.isdigit() and (last or first).isdigit():
            yield from range(int(first), int(last or first) + 1)


def _switched_on(line: str) -> list[str]:
    """The parameters that a dtparam line switches on."""
    key, _, values = line.partition("=")
    pairs = [value.partition("=") for value in values.split(",")] if key == "dtparam" else []
    return [name for name, _, value in pairs if value in ("", "on", "true", "yes", "1")]


def _why_not(config: Config) -> str:
    return "the rotor is simulated" if config.rotor.hardware == "sim" else "not a Raspberry Pi"


def _level(high: bool) -> str:
    return "high" if high else "low"
