"""Every check, in the order of the report, and the examination that makes them.

A check that fails by a mistake of the program does not stop the others. The checks themselves are in the files beside
this one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from rotator.assembly.chips import simulated_chips
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.doctor import (
    account,
    axes,
    boot,
    bus,
    counts,
    health,
    links,
    moteus,
    outputs,
    sensors,
    software,
    switches,
    wires,
)
from rotator.doctor.finding import Check, Finding, skipped, wrong
from rotator.doctor.machine import Machine

CONFIGURATION: Check[[Path | None]] = Check(
    "configuration", "the file can be read, and every key and value in it is allowed", axes.configuration
)

OF_THE_MACHINE: tuple[Check[[Machine]], ...] = (
    Check("python", "its version, 3.11 to 3.13", software.python),
    Check("packages", "gpiod 2.1 or later and not its namesake, smbus2, pyserial", software.packages),
    Check("kernel", "its version, 5.10 or later; which Raspberry Pi it runs on", software.kernel),
    Check("power", "whether the Pi's supply sags, or has sagged since the start", health.power),
    Check("temperature", "the processor's, below 80 °C", health.temperature),
    Check("clock", "whether the network has set it", health.clock),
    Check("watchdog", "whether a frozen computer is restarted", health.watchdog),
    Check("service", "where it is installed: running, and starting by itself", health.service),
)

OF_THE_STATION: tuple[Check[[Machine, Config]], ...] = (
    Check(
        "axes", "what each needs before it may be aimed: limits, direction check, a calibration where it has a pot",
        lambda _machine, config: axes.axes(config),
    ),
    Check(
        "counts", "the file with the counts can be believed; which axis was never homed, or has lost its count",
        counts.counts, concerns=counts.keeps_counts,
    ),
    Check(
        "GPIO chip", "the one with the 40-pin header is there, and yours to open",
        wires.gpio_chip, on_chips=True, concerns=wires.has_lines,
    ),
    Check(
        "GPIO lines", "no other program holds a line of the box, outputs and inputs",
        wires.gpio_lines, on_chips=True, concerns=wires.has_lines,
    ),
    Check("I2C bus", "it is there, and yours to open", bus.i2c_bus, on_chips=True, concerns=bus.has_chips),
    Check(
        "I2C devices", "every chip that the file names answers; if not, which address does",
        bus.i2c_devices, on_chips=True, concerns=bus.has_chips,
    ),
    Check(
        "pots", "they read within their window, and steadily; not while the box is running",
        bus.pots, on_chips=True, concerns=bus.has_pots,
    ),
    Check(
        "sensors", "AS5600 and its magnet, MPU6050 and its 1 g, BNO055 and its heading; not while the box is running",
        sensors.sensors, on_chips=True, concerns=sensors.has_sensors,
    ),
    Check(
        "PCA9685", "those of servos and panel are what they should be, and have not been reset under a running box",
        outputs.output_boards, on_chips=True, concerns=outputs.has_boards,
    ),
    Check(
        "moteus", "library and adapter; both controllers: volts, what stopped them, whether they know where they point",
        moteus.controllers, on_chips=True, concerns=moteus.is_moteus,
    ),
    Check(
        "SPI", "the kernel's, where chips hang on it: the package spidev, and their devices",
        outputs.spi, on_chips=True, concerns=outputs.uses_spi,
    ),
    Check(
        "switches", "stop button and limit switches closed; where the mode switch stands; not while the box is running",
        switches.switches, on_chips=True, concerns=switches.has_switches,
    ),
    Check(
        "released lines", "`strict_gpiod`: relays drop when the program dies",
        boot.released_lines, concerns=boot.has_relays,
    ),
    Check(
        "boot pins", "`gpio=` in config.txt: relays and enable lines are off while the Pi starts",
        boot.boot_pins, concerns=boot.has_lines,
    ),
    Check("serial ports", "those of the links are there, yours to open, and no console", links.serial_ports),
    Check("pseudo-terminals", "those of the links can be made", links.pseudo_terminals),
    Check("TCP ports", "those of the links are free, or the box's; which are open to the network", links.tcp_ports),
    Check("UDP ports", "the same of those that hear datagrams", links.udp_ports),
    Check("groups", "gpio, i2c, spi, dialout: those needed, of you and of the service's user", account.groups),
    Check("state folder", "it can be written to, and the card is not full", account.state_folder),
)  # fmt: skip
"""A check is left out where the configuration has nothing of its kind."""


@dataclass(frozen=True, slots=True)
class Examination:
    """The findings, by the name of the check, in order; a check may have several."""

    findings: tuple[tuple[str, Finding], ...]
    usable: bool
    """The configuration could be loaded."""

    @property
    def exit_code(self) -> int:
        if not self.usable:
            return 2
        return int(any(finding.ok is False for _, finding in self.findings))


def examine(machine: Machine, path: Path | None) -> Examination:
    """`path`: the configuration file; None for the shipped one."""
    findings = [(CONFIGURATION.name, finding) for finding in _safely(CONFIGURATION.look, path)]
    try:
        config = load(path)
    except ConfigError:
        config = None
    for check in OF_THE_MACHINE:
        findings += [(check.name, finding) for finding in _safely(check.look, machine)]
    simulated = config is not None and config.rotor.hardware == "sim"
    for station_check in OF_THE_STATION:
        if config is not None and not station_check.concerns(config):
            continue
        findings += [
            (station_check.name, finding) for finding in _of_station(station_check, machine, config, simulated)
        ]
    return Examination(tuple(findings), config is not None)


def _of_station(
    check: Check[[Machine, Config]], machine: Machine, config: Config | None, simulated: bool
) -> Iterator[Finding]:
    if config is None:
        yield skipped("needs a configuration")
    elif check.on_chips and simulated:
        for finding in _safely(check.look, replace(machine, chips=simulated_chips(config)), config):
            yield replace(finding, found=f"simulated: {finding.found}")
    else:
        yield from _safely(check.look, machine, config)


def _safely(look: Callable[..., Iterator[Finding]], *what: Any) -> Iterator[Finding]:
    try:
        yield from look(*what)
    except Exception as fault:  # one broken check must not hide the others
        yield wrong(f"the check itself failed: {type(fault).__name__}: {fault}", "A mistake of ours: please tell us.")
