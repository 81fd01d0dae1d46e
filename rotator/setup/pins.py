"""The lines of config.txt that keep relays and enable lines off from power-on until the program drives them.

Knows the pins of the 40-pin header, their pulls and their other uses. The kind of rotor names the lines. Works on texts
and writes no file.
"""

from __future__ import annotations

import re
from pathlib import Path

from rotator.config.chips import SpiUse
from rotator.config.kinds.kind import OffLine
from rotator.config.model import Config
from rotator.setup import boot_config
from rotator.setup.blocks import Block
from rotator.setup.boot_config import Setting
from rotator.setup.pi import Pi
from rotator.setup.plan import ChangeSet, Files, SetupError, planned

STRICT, I2C, SPI = "dtparam=strict_gpiod", "dtparam=i2c_arm=on", "dtparam=spi=on"
BLOCK = Block(
    "rotator setup pins",
    re.compile(r"\[all\]|gpio=[0-9,]+=op,d[lh]|" + "|".join(map(re.escape, (STRICT, I2C, SPI)))),
)

I2C_MODULE = Path("etc/modules-load.d/rotator-pins.conf")
_I2C_DEV = "# /dev/i2c-1 for the box's chips. Removed by `rotator setup pins --undo`.\ni2c-dev\n"

HEADER_BUS = 1
I2C_NAMES = ("i2c_arm", "i2c", "i2c1")
"""Three names of the same parameter."""
PULLED_UP = range(9)
"""GPIO 0 to 8 have a pull-up while the Pi starts, 9 to 27 a pull-down (BCM2835 ARM Peripherals, GPIO pull table)."""


def off_lines(config: Config) -> dict[int, OffLine]:
    """Each line that must be off while the Pi starts, by GPIO."""
    return {line.pin: line for line in config.off_lines()}


def off_levels(config: Config) -> dict[int, str]:
    """The off level of each line as config.txt writes it: `dl` low, `dh` high."""
    return {pin: "dh" if line.off_high else "dl" for pin, line in off_lines(config).items()}


def closing(config: Config) -> dict[int, OffLine]:
    """The lines that close a contact, by GPIO. The contact must open when the program dies."""
    return {pin: line for pin, line in off_lines(config).items() if line.switches}


def plan(files: Files, root: Path, boot: Path, config: Config, pi: Pi | None) -> ChangeSet:
    """The changes and warnings. Raises SetupError for an unfit pin, or a contradicting line of config.txt."""
    _refuse(config)
    before = str(files[boot] or "")
    others = [each for each in boot_config.settings(BLOCK.without(before)) if each.may_hold_on(pi)]
    _keep_off_the_buses(config, others)
    wanted = _missing(config, others)
    i2c_dev = _I2C_DEV if _uses_header_i2c(config) else None
    text = BLOCK.into(before, ["[all]", *wanted] if wanted else [])
    return planned(files, {boot: text, root / I2C_MODULE: i2c_dev}, [boot], _pulls(config))


def undone(files: Files, root: Path, boot: Path) -> ChangeSet:
    """The changes that remove the lines of `plan`, and no others."""
    return planned(files, {boot: BLOCK.without(str(files[boot] or "")), root / I2C_MODULE: None}, [boot])


def _uses_header_i2c(config: Config) -> bool:
    return any(chip.bus == HEADER_BUS for chip in config.chips())


def _kernel_spi(config: Config) -> list[SpiUse]:
    return [use for use in config.spi_uses() if use.kernel]


def _refuse(config: Config) -> None:
    if config.simulated:
        raise SetupError(
            'the configuration is of a simulated rotor (hardware = "sim"): '
            'write your pins, and hardware = "pi" under [rotor], into it; then run this again'
        )
    for pin, line in off_lines(config).items():
        if pin > 27:
            raise SetupError(f"{line.key} = {pin} is not on the 40-pin header: take one from 4 to 27")
        if pin < 2:
            raise SetupError(
                f"{line.key} = {pin} is the pin of the ID EEPROM, which the Pi reads as it starts: take another pin"
            )


def _keep_off_the_buses(config: Config, others: list[Setting]) -> None:
    trades: list[tuple[range, str, Setting | None]] = []
    if _uses_header_i2c(config):
        trades.append((range(2, 4), "the I2C bus of the box's own chips", None))
    trades += [(range(7, 12), f"the SPI bus of the {use.chips}", None) for use in _kernel_spi(config)]
    for pins, bus, names in (
        (range(2, 4), "the I2C bus", I2C_NAMES),
        (range(7, 12), "the SPI bus", ("spi",)),
        (range(14, 16), "the serial port", ("uart0",)),
    ):
        trades += [(pins, bus, setting) for setting, on in boot_config.parameters(others, *names) if on]
    trades += [
        (range(14, 16), "the serial port", setting)
        for setting in others
        if (setting.key == "enable_uart" and setting.value not in boot_config.NO)
        or (setting.key == "dtoverlay" and setting.words[0] in {"uart0", "uart0-pi5", "disable-bt", "miniuart-bt"})
    ]
    for pin, line in off_lines(config).items():
        for pins, bus, setting in trades:
            if pin in pins:
                switched_on = f" (config.txt, {setting})" if setting else ""
                raise SetupError(
                    f"{line.key} = {pin} is a pin of {bus}{switched_on}: take another pin, or switch that off"
                )


def _missing(config: Config, others: list[Setting]) -> list[str]:
    """The lines that config.txt lacks. Raises SetupError if it has an opposite line: the later line wins."""
    levels = off_levels(config)
    done: set[int] = set()
    for setting, pins, words in boot_config.pins(others):
        for pin in sorted(pins & levels.keys()):
            if words & {"ip", "a0", "a1", "a2", "a3", "a4", "a5", "dl", "dh"} - {levels[pin]}:
                raise _contradicts(setting, f"GPIO {pin} has to be op,{levels[pin]}")
            if {"op", levels[pin]} <= words and not setting.filters:
                done.add(pin)
    missing = []
    for level in ("dl", "dh"):
        if pins_left := [pin for pin in levels if levels[pin] == level and pin not in done]:
            missing.append(f"gpio={','.join(map(str, pins_left))}=op,{level}")
    switches: dict[str, tuple[str, ...]] = {}
    if closing(config):
        switches[STRICT] = ("strict_gpiod",)
    if _uses_header_i2c(config):
        switches[I2C] = I2C_NAMES
    if _kernel_spi(config):
        switches[SPI] = ("spi",)
    for line, names in switches.items():
        found = list(boot_config.parameters(others, *names))
        for setting, on in found:
            if not on:
                raise _contradicts(setting, f"{line} is needed")
        if not any(not setting.filters for setting, _ in found):
            missing.append(line)
    return missing


def _contradicts(setting: Setting, needed: str) -> SetupError:
    return SetupError(f"config.txt says otherwise ({setting}), but {needed}: put a # before it and run this again")


def _pulls(config: Config) -> list[str]:
    """Warnings for relays with a pull to their on level while no program drives the pin."""
    lines = closing(config)
    notes = []
    for off_high, way, good in (
        (False, "up", "12, 13, 16, 17, 22 to 27"),
        (True, "down", "4, 5, 6, and 7, 8 without SPI"),
    ):
        wrong = [pin for pin, line in lines.items() if line.off_high is off_high and (pin in PULLED_UP) is not off_high]
        if wrong:
            pins = ", ".join(map(str, wrong))
            level = "low" if off_high else "high"
            notes.append(
                f"WARNING: GPIO {pins}: pulled {way} at power-on and after the program's death, which switches the "
                f"relay ON (on at {level}). Take pins from {good}, or fit 10 kΩ from each relay input to its off level."
            )
    return notes
