"""A healthy Raspberry Pi 4 as a folder of files, programs and simulated chips, for tests to damage."""

from __future__ import annotations

import errno
import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NoReturn, cast

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs
from hw.buses.i2c import SmbusI2C
from rotator.assembly.chips import Chips, ask_in_step
from rotator.assembly.simulation import SimulatedStation
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.doctor.checks import OF_THE_MACHINE, OF_THE_STATION, look_of
from rotator.doctor.finding import Finding
from rotator.doctor.machine import Machine
from tests.boxes import free_port

PI_4 = "Raspberry Pi 4 Model B Rev 1.4"
STATION = f"""
[page]
listen = "127.0.0.1:{free_port()}"
[rotor]
hardware = "pi"
[azimuth]
min_deg = 0
max_deg = 450
calibration = [[0.05, 0], [0.95, 450]]
direction_checked = true
[elevation]
min_deg = 0
max_deg = 180
calibration = [[0.05, 0], [0.95, 180]]
direction_checked = true
[state]
path = "/var/lib/rotator/state.json"
"""
STATION_OF = """
[rotor]
type = "{}"
hardware = "pi"
[azimuth]
min_deg = 0
max_deg = 180
direction_checked = true
[elevation]
min_deg = 0
max_deg = 90
direction_checked = true
[state]
path = "/var/lib/rotator/state.json"
[lcd]
kind = "none"
"""


class StaysOpen:
    """A bus that outlives the program that closes it, as a real one does."""

    def __init__(self, bus: SimI2CBus) -> None:
        self._bus = bus

    def i2c_rdwr(self, *messages: Any) -> None:
        self._bus.i2c_rdwr(*messages)

    def close(self) -> None:
        """Others still use it."""


@dataclass
class Pi:
    """`machine` is what is looked at; `config` and `world` are its station, and `found` looks."""

    machine: Machine
    folder: Path
    config: Config
    world: Any

    def write(self, path: str, text: str = "") -> Path:
        file = self.machine.at(path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def remove(self, path: str) -> None:
        self.machine.at(path).unlink()

    def program(self, name: str, script: str) -> None:
        file = self.folder / "bin" / name
        file.write_text(f"#!/bin/sh\n{script}\n")
        file.chmod(0o755)

    def package(self, name: str, version: str) -> None:
        folder = self.folder / "packages" / f"{name}-{version}.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")

    def station(self, more: str, base: str = STATION) -> None:
        """Another configuration, and the chips that fit it."""
        self.config = parse(f"{base}\n{more}", "test")
        clock = SimClock()
        world = self.world = SimulatedStation(self.config, clock, None, (90.0, 45.0)).build()
        clock.sleep(1.0)  # a compass has to boot
        chips = Chips(
            lambda: world.gpio,
            world.gpio.paths(),
            lambda number: SmbusI2C(StaysOpen(world.i2c(number)), f"/dev/i2c-{number}"),
            clock,
            clock.sleep,
            lambda config: ask_in_step(config, cast(Any, world).transport(), clock),
            lambda: world.spidev,
        )
        self.machine = replace(self.machine, chips=chips)

    def kind(self, name: str, more: str = "") -> None:
        """Another kind of rotor on real hardware, set up; a few more tables."""
        self.station(more, base=STATION_OF.format(name))

    def found(self, name: str) -> list[Finding]:
        for check in OF_THE_MACHINE:
            if check.name == name:
                return list(check.look(self.machine))
        look = next(look_of(check) for check in OF_THE_STATION if check.name == name)
        return list(look(self.machine, self.config))

    def looks_at(self, name: str) -> bool:
        """Whether this configuration has anything of the kind."""
        return next(bool(check.concerns(self.config)) for check in OF_THE_STATION if check.name == name)

    def only(self, name: str) -> Finding:
        """The check's only finding."""
        (finding,) = self.found(name)
        return finding

    def change(self, **fields: Any) -> None:
        self.machine = replace(self.machine, **fields)


class Forbidden:
    """The gpiod package as a user outside the group gpio meets it."""

    def Chip(self, path: str) -> NoReturn:  # noqa: N802 - gpiod's own name
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)


MONITOR = "Num       RefCount Protocol Flags    Type St Inode Path\n0000: 00000002 00000000 00010000 0001 01 17 {}\n"


def runs(pi: Pi, monitor: str = "/run/rotator/monitor") -> None:
    """A box is running that has no line: its socket tells, in /proc/net/unix."""
    pi.write("/proc/net/unix", MONITOR.format(monitor))


def hold(pi: Pi, consumer: str, pin: int) -> GpioOutputs:
    return GpioOutputs(pi.world.gpio, "/dev/gpiochip0", {"line": pin}, consumer=consumer)


@pytest.fixture
def pi(tmp_path: Path) -> Pi:
    for folder in ("root", "bin", "packages"):
        (tmp_path / folder).mkdir()
    config = parse(STATION, "test")
    machine = Machine(
        root=tmp_path / "root",
        programs=str(tmp_path / "bin"),
        packages=(str(tmp_path / "packages"),),
        python=(3, 11, 2),
        pointer_bits=64,
        kernel=("6.12.34+rpt-rpi-v8", "aarch64"),
        user="pi",
        free_bytes=lambda _path: 20_000_000_000,
        chips=Chips(lambda: None, None, lambda _number: cast(Any, None), SimClock(), SimClock().sleep),
    )
    pi = Pi(machine, tmp_path, config, None)
    pi.station("")
    for name, version in (("gpiod", "2.3.0"), ("smbus2", "0.5.0"), ("pyserial", "3.5")):
        pi.package(name, version)
    for path, text in FILES.items():
        pi.write(path, text)
    pi.program("vcgencmd", "echo throttled=0x0")
    pi.program("timedatectl", "echo yes")
    pi.machine.at("/var/lib/rotator").mkdir(parents=True)
    return pi


FILES = {
    "/proc/device-tree/model": f"{PI_4}\0",
    "/proc/cmdline": "console=tty1 root=PARTUUID=1-02 rootfstype=ext4 rootwait",
    "/sys/class/thermal/thermal_zone0/temp": "48199\n",
    "/sys/class/watchdog/watchdog0/state": "active\n",
    "/sys/class/watchdog/watchdog0/timeout": "15\n",
    "/dev/watchdog": "",
    "/sys/module/pinctrl_bcm2835/parameters/persist_gpio_outputs": "N\n",
    "/boot/firmware/config.txt": (
        "# For more options see the documentation\ndtparam=i2c_arm=on\ndtparam=audio=on\n\n[cm4]\notg_mode=1\n\n"
        "[all]\ndtparam=strict_gpiod\ngpio=22-25=op,dl\n"
    ),
    "/etc/passwd": "root:x:0:0:root:/root:/bin/bash\npi:x:1000:1000:,,,:/home/pi:/bin/bash\n",
    "/etc/group": "dialout:x:20:pi\npi:x:1000:\ngpio:x:997:pi\ni2c:x:998:pi\nspi:x:999:pi\n",
}
