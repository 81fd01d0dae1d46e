"""The list of all checks, in the order of the report, and the function that runs them.

An exception in one check becomes a finding, and the others still run. The checks themselves are in the files beside
this one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.assembly.chips import simulated_chips
from rotator.config.load import ConfigError, load
from rotator.config.model import Config
from rotator.doctor import (
    account,
    axes,
    chips,
    computer,
    controllers,
    kept,
    links,
    outputs,
    running,
    switches,
    wires,
)
from rotator.doctor.finding import Check, Finding, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.setup.pins import closing, off_lines

CONFIGURATION: Check[[Path | None]] = Check(
    "configuration", "each key and value of the file is allowed", axes.configuration
)

OF_THE_MACHINE: tuple[Check[[Machine]], ...] = (
    Check("python", "version 3.11 to 3.13", computer.python),
    Check("packages", "gpiod 2.1 or later, smbus2, pyserial", computer.packages),
    Check("kernel", "version 5.10 or later; the model of the Pi", computer.kernel),
    Check("power", "under-voltage now, or since the start", computer.power),
    Check("temperature", "processor below 80 °C", computer.temperature),
    Check("clock", "set by the network", computer.clock),
    Check("watchdog", "restarts a frozen computer", computer.watchdog),
    Check("service", "if installed: it runs, and starts with the Pi", computer.service),
    Check("running box", "its faults, who has stopped it, its notes", running.running_box),
)

OF_THE_STATION: tuple[Check[[Machine, Config]], ...] = (
    Check("axes", "each has limits, a direction check, and a calibration if it needs one", axes.axes),
    Check(
        "sectors", "what stands in a forbidden sector is fenced off on other turns and over the top too",
        axes.sectors, concerns=lambda config: config.mount.forbidden,
    ),
    Check(
        "counts", "the saved counts are valid; each axis is homed", kept.counts,
        concerns=lambda config: config.rotor.hardware == "pi" and any(map(config.counts, Axis)),
    ),
    Check(
        "GPIO chip", "the chip of the 40-pin header is there, and opens",
        wires.gpio_chip, on_chips=True, concerns=wires.lines,
    ),
    Check(
        "GPIO lines", "no other program holds a line of the box", wires.gpio_lines, on_chips=True, concerns=wires.lines
    ),
    Check("I2C bus", "it is there, and opens", chips.i2c_bus, on_chips=True, concerns=Config.chips),
    Check(
        "I2C devices", "every chip in the file answers; if not, which address does",
        chips.i2c_devices, on_chips=True, concerns=Config.chips,
    ),
    Check(
        "pots", "steady readings, within lowest_reading and highest_reading \\*",
        chips.pots, on_chips=True, alone=True, concerns=lambda config: config.uses_adc,
    ),
    Check(
        "sensors", "encoders: magnet; LS7366R: answers; gravity: 1 g; compass: field \\*",
        chips.sensors, on_chips=True, alone=True,
        concerns=lambda config: config.compass.chips() or chips.sensed(config) or chips.counters(config),
    ),
    Check(
        "PCA9685", "the chips of servos and panel answer, and were not reset",
        outputs.output_boards, on_chips=True, concerns=outputs.boards,
    ),
    Check(
        "moteus", "library, adapter; both controllers: supply, fault, known angle \\*",
        controllers.moteus, on_chips=True, alone=True, concerns=lambda config: config.rotor.type == "moteus",
    ),
    Check(
        "controller", "its port, and the angle that it tells \\*", controllers.ready_made, alone=True,
        concerns=lambda config: config.rotor.type == "controller" and config.rotor.hardware == "pi",
    ),
    Check(
        "SPI", "for chips on the kernel's SPI: the package spidev, and the devices",
        outputs.spi, on_chips=True, concerns=outputs.kernels_spi,
    ),
    Check(
        "PWM", "the header's hardware PWM is there", outputs.pwm, on_chips=True,
        concerns=lambda config: config.rotor.type == "h-bridge" or "pwm" in {s.output for s in config.speeds.values()},
    ),
    Check(
        "switches", "stop button and limit switches are closed; position of the mode switch \\*",
        switches.switches, on_chips=True, alone=True,
        concerns=lambda config: config.panel.switches or config.limits.switches,
    ),
    Check(
        "released lines", "`strict_gpiod`: the relays open when the program dies",
        wires.released_lines, on_a_pi=True, concerns=closing,
    ),
    Check(
        "boot pins", "`gpio=` in config.txt: relays and enable lines are off while the Pi starts",
        wires.boot_pins, on_a_pi=True, concerns=off_lines,
    ),
    Check("serial ports", "those of the links are there, open, and free of consoles", links.serial_ports),
    Check("pseudo-terminals", "those of the links can be created", links.pseudo_terminals),
    Check("TCP ports", "those of the links are free or the box's; which are open to the network", links.tcp_ports),
    Check("page's port", "free, or the box's; open to the network?", links.page_port),
    Check("UDP ports", "the same for links that receive datagrams", links.udp_ports),
    Check(
        "elements", "the files can be read and are not old; fetching works",
        kept.elements, concerns=lambda config: config.sky.elements or config.sky.fetch,
    ),
    Check("groups", "those that the file needs, for you and the service's user", account.groups),
    Check("state folder", "writable, and the card is not full", account.state_folder),
)  # fmt: skip
"""A check is left out if the configuration has no such part."""


@dataclass(frozen=True, slots=True)
class Examination:
    """(name of the check, finding), in the order of the report. A check may have several findings."""

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
    simulated = config is not None and config.simulated
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
        for finding in _safely(look_of(check), replace(machine, chips=simulated_chips(config)), config):
            yield replace(finding, found=f"simulated: {finding.found}")
    else:
        yield from _safely(look_of(check), machine, config)


def look_of(check: Check[[Machine, Config]]) -> Callable[[Machine, Config], Iterator[Finding]]:
    """What the check does, or why it is not done now."""

    def look(machine: Machine, config: Config) -> Iterator[Finding]:
        left_alone = wires.running(machine, config) if check.alone else None
        if check.on_a_pi and config.simulated:
            left_alone = skipped("the rotor is simulated")
        elif check.on_a_pi and not machine.is_pi:
            left_alone = skipped("not a Raspberry Pi")
        yield from check.look(machine, config) if left_alone is None else [left_alone]

    return look


def _safely(look: Callable[..., Iterator[Finding]], *arguments: Any) -> Iterator[Finding]:
    try:
        yield from look(*arguments)
    except Exception as fault:  # A bug in one check must not hide the others.
        yield wrong(
            f"the check itself failed: {type(fault).__name__}: {fault}", "A bug of this program: please report it."
        )
