"""What each check of the machine and its links tells of a healthy Pi, and of one thing that is damaged on it."""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import partial
from types import ModuleType

import pytest

from hw.buses.gpio import real_gpiod
from rotator.doctor.checks import OF_THE_MACHINE
from rotator.doctor.finding import Check
from rotator.doctor.machine import Machine
from tests.doctor.conftest import STATION, Pi
from tests.doctor.rows import (
    ALICE,
    GROUPS_OF_OTHERS,
    MODEL,
    NO_RUN,
    PASSWD,
    PEAK,
    RUNNING,
    SERVICE,
    STATE,
    UNIT,
    Row,
    link,
    named,
    of,
    service,
    stat,
)


def points(target: str, pi: Pi) -> None:
    pi.machine.at("/var/lib/rotator/gs232").symlink_to(target)


MACHINE = [
    Row("python", "✓ Python 3.11.2, 64-bit →"),
    Row("python", "✗ Python 3.10.12, 32-bit → Python 3.11, 3.12", now={"python": (3, 10, 12), "pointer_bits": 32}),
    Row("python", "✗ Python 3.14.0", now={"python": (3, 14, 0)}),
    Row("packages", "✓ gpiod 2.3.0, smbus2 0.5.0, pyserial 3.5 →"),
    Row("kernel", "✓ Linux 6.12.34+rpt-rpi-v8 (aarch64, 64-bit), Raspberry Pi 4 Model B Rev 1.4"),
    Row("kernel", "✗ Linux 5.4.83-v7l+ (armv7l, 32-bit), Raspberry Pi 4 Model B Rev 1.4 → The kernel is older than "
        "5.10: sudo apt full-upgrade", now={"kernel": ("5.4.83-v7l+", "armv7l")}),
    Row("kernel", "✓ Linux 6.12.34+rpt-rpi-v8 (aarch64, 64-bit), not a Raspberry Pi", files={MODEL: None}),
    Row("power", "✓ no sag since the start (0x0) →"),
    Row("power", "✗ under-voltage now (0x1) → Use the Pi's own power supply",
        programs={"vcgencmd": "echo throttled=0x1"}),
    Row("power", "✗ under-voltage now, throttled now (0x50005)", programs={"vcgencmd": "echo throttled=0x50005"}),
    Row("power", "! under-voltage since the start, throttled since the start (0x50000) → Use the Pi's own power",
        programs={"vcgencmd": "echo throttled=0x50000"}),
    Row("power", "! clock capped now (0x2) → The Pi is or was too hot", programs={"vcgencmd": "echo throttled=0x2"}),
    Row("power", "✗ under-voltage now, throttled now",
        files={"/sys/devices/platform/soc/soc:firmware/get_throttled": "50005\n"}, programs={"vcgencmd": ""}),
    *(
        Row("power", f"{mark} ", programs={"vcgencmd": "exit 1"}, files={
            "/sys/class/hwmon/hwmon0/name": "cpu_thermal\n",
            "/sys/class/hwmon/hwmon1/name": "rpi_volt\n",
            "/sys/class/hwmon/hwmon1/in0_lcrit_alarm": f"{alarm}\n",
        })
        for alarm, mark in ("0✓", "1✗")
    ),
    Row("power", "– this computer does not report", programs={"vcgencmd": "echo VCHI initialization failed"}),
    Row("temperature", "✓ 48 °C →"),
    Row("temperature", "! 82 °C → The Pi slows down from 80 °C on: give it air, shade or a heat sink.",
        files={PEAK: "82300\n"}),
    Row("clock", "✓ set by the network →"),
    Row("clock", "! not set by the network → Orders from a PC do not need it", programs={"timedatectl": "echo no"}),
    Row("clock", "✓ set by the network",
        files={"/run/systemd/timesync/synchronized": ""}, programs={"timedatectl": ""}),
    Row("clock", "✓ set by chrony", programs={"timedatectl": "", "chronyc": "echo 'Leap status     : Normal'"}),
    Row("clock", "! not set", programs={"timedatectl": "", "chronyc": "echo 'Leap status     : Not synchronised'"}),
    Row("watchdog", "✓ restarts a frozen computer after 15 s →"),
    Row("watchdog", "! no program feeds it: a frozen computer stays frozen → Write [Manager] and RuntimeWatchdogSec=15",
        files={STATE: "inactive\n"}),
    Row("watchdog", "✓ restarts", files={STATE: None}, programs={"systemctl": "echo 15s"}),
    Row("watchdog", "! no program feeds it", files={STATE: None}, programs={"systemctl": "echo infinity"}),
    Row("watchdog", "! there is no /dev/watchdog", files={"/dev/watchdog": None}),
    Row("watchdog", "– there is no /dev/watchdog", files={"/dev/watchdog": None, MODEL: None}),
    Row("service", f"– {NO_RUN}"),
    Row("service", "✓ active (running), enabled →", files={SERVICE: UNIT}, programs={"systemctl": RUNNING}),
    Row("service", "✗ failed (failed), enabled → The last lines of journalctl -u rotator",
        files={SERVICE: UNIT}, programs={"systemctl": service("enabled", "failed", "failed")}),
    Row("service", "✗ activating (auto-restart), enabled → The last lines of journalctl",
        files={SERVICE: UNIT}, programs={"systemctl": service("enabled", "activating", "auto-restart")}),
    Row("service", "! inactive (dead), enabled → sudo systemctl start rotator",
        files={SERVICE: UNIT}, programs={"systemctl": service("enabled", "inactive", "dead")}),
    Row("service", "! active (running), disabled → It will not start by itself after a power cut",
        files={SERVICE: UNIT}, programs={"systemctl": service("disabled", "active", "running")}),
    Row("service", "✓ active (running), enabled →", files=stat("002"), programs={"systemctl": RUNNING}),
    Row("service", "! active (running), enabled; the threads that stop a motor have no priority",
        files=stat("000"), programs={"systemctl": RUNNING}),
    Row("service", "– installed; systemd does not answer here",
        files={"/usr/lib/systemd/system/rotator.service": UNIT}, programs={"systemctl": "exit 1"}),
]  # fmt: skip
WAYS_IN = [
    Row("serial ports", "✓ /dev/ttyGS0 is there", more=link("serial", "/dev/ttyGS0"), files={"/dev/ttyGS0": ""}),
    Row("serial ports", "✗ /dev/ttyGS0 is not there → sudo rotator setup usb-serial",
        more=link("serial", "/dev/ttyGS0")),
    Row("serial ports", "✗ /dev/ttyUSB0 is not there → Plug it in (the box waits for it), or name one of those "
        "that are there: /dev/ttyACM0.", more=link("serial", "/dev/ttyUSB0"), files={"/dev/ttyACM0": ""}),
    Row("serial ports", "✗ /dev/ttyS0: the kernel's console is on it",
        more=link("serial", "/dev/ttyS0"), files={"/dev/ttyS0": "", "/proc/cmdline": "console=ttyS0,115200"}),
    Row("serial ports", "✗ /dev/serial0: the kernel's console is on it, and its messages would be orders → sudo raspi-",
        more=link("serial", "/dev/serial0"), files={"/dev/ttyS0": "", "/proc/cmdline": "console=ttyS0,115200"},
        spoil=lambda pi: pi.machine.at("/dev/serial0").symlink_to("ttyS0")),
    Row("serial ports", "– rfc2217://box:2217: opened when", more=link("serial", "rfc2217://box:2217")),
    Row("pseudo-terminals", "✓ /run/rotator/gs232 will be made", more=link("pty", "/run/rotator/gs232")),
    *(
        Row("pseudo-terminals", f"✓ /var/lib/rotator/gs232 → {target}{words} →", spoil=partial(points, target),
            more=link("pty", "/var/lib/rotator/gs232"))
        for target, words in ((".", ""), ("gone", " (left by a box that died, will be replaced)"))
    ),
    Row("pseudo-terminals", "✗ /run/gs232: a file of that name is in the way → Remove it",
        more=link("pty", "/run/gs232"), files={"/run/gs232": ""}),
    Row("TCP ports", "! 0.0.0.0:15331: free, and open to the network: every machine on it can turn the antenna → allow",
        more=link("tcp", "0.0.0.0:15331")),
    Row("TCP ports", "✓ 0.0.0.0:15331: free, and open to the network; it is read_only: nothing there turns the antenna",
        more=link("tcp", "0.0.0.0:15331", "read_only = true\n")),
    Row("TCP ports", "✓ 0.0.0.0:15331: free, and open to the network for 192.168.1.20, 10.0.0.0/8 (allow)",
        more=link("tcp", "0.0.0.0:15331", 'allow = ["192.168.1.20", "10.0.0.0/8"]\n')),
    Row("TCP ports", "✓ localhost:15332: free →", more=link("tcp", "localhost:15332")),
    Row("TCP ports", "✗ 192.0.2.7:4533: cannot listen there: Cannot assign requested address → Use an address of this",
        more=link("tcp", "192.0.2.7:4533")),
    Row("TCP ports", "✗ no-such-host.invalid:4533: no machine has that name → Use an address of this machine",
        more=link("tcp", "no-such-host.invalid:4533")),
    Row("UDP ports", "! 0.0.0.0:15333: free, and open to the network", more=link("udp", "0.0.0.0:15333")),
    Row("groups", "✓ pi is a member of gpio, i2c →"),
    Row("groups", "✓ pi is a member of dialout, gpio, i2c →", more=link("serial", "/dev/ttyGS0")),
    Row("groups", "✗ pi is not in gpio, i2c → sudo usermod -aG gpio,i2c pi", files={"/etc/group": GROUPS_OF_OTHERS}),
    Row("groups", "✓ the service gives rotator its groups → \n✓ pi is a member of",
        files={SERVICE: UNIT, "/etc/passwd": PASSWD}),
    Row("groups", "✗ rotator is not in gpio, i2c → sudo usermod -aG gpio,i2c rotator, then",
        files={SERVICE: "[Service]\nUser=rotator\n", "/etc/passwd": PASSWD}),
    Row("groups", "✗ there is no user rotator", files={SERVICE: UNIT}),
    Row("groups", "\n! alice is not in", files={SERVICE: UNIT, "/etc/passwd": ALICE}, now={"user": "alice"}),
    Row("groups", "✓ root needs none", now={"user": "root"}),
    Row("groups", "✓ pi is a member of dialout →", base=of("moteus")),
    Row("groups", "✓ pi is a member of gpio, spi", base=of("digipot"), more='[digipot]\nspi = "kernel"\nenable = 16\n'),
    Row("state folder", "✓ /var/lib/rotator: 20.0 GB free →"),
    Row("state folder", "! /var/lib/rotator: 0.3 GB free → The card is nearly full: sudo apt clean",
        now={"free_bytes": lambda _path: 300_000_000}),
    Row("state folder", "✗ /var/lib/rotator: 0.0 GB free → The card is full", now={"free_bytes": lambda _path: 4096}),
    Row("state folder", "✗ /dev/watchdog cannot be written to: the learnt motor speeds would be lost → sudo install -d "
        "-o pi /dev/watchdog", base=STATION.replace("/var/lib/rotator/", "/dev/watchdog/")),
]  # fmt: skip


@pytest.mark.parametrize("row", [*MACHINE, *WAYS_IN], ids=named)
def test_what_is_found(pi: Pi, row: Row) -> None:
    row.judge(pi)


@pytest.mark.parametrize("check", OF_THE_MACHINE, ids=lambda check: check.name)
def test_a_machine_that_tells_nothing_ends_no_check(pi: Pi, check: Check[[Machine]]) -> None:
    bare = replace(pi.machine, root=pi.folder / "nothing", programs=str(pi.folder / "nothing"), packages=())
    assert list(check.look(bare))


def test_an_old_package(pi: Pi) -> None:
    (pi.folder / "packages" / "gpiod-2.3.0.dist-info").rename(pi.folder / "packages" / "away")
    pi.package("gpiod", "1.5.4")
    old, rest = pi.found("packages")
    assert (old.ok, old.found) == (False, "gpiod 1.5.4 is older than 2.1")
    assert "pip install 'gpiod>=2.1'" in old.advice
    assert rest.found == "smbus2 0.5.0, pyserial 3.5"


def test_a_missing_package(pi: Pi) -> None:
    (pi.folder / "packages" / "smbus2-0.5.0.dist-info").rename(pi.folder / "packages" / "away")
    missing = pi.found("packages")[0]
    assert (missing.ok, missing.found) == (False, "smbus2 is not installed")
    assert "pip install 'smbus2>=0.4.2'" in missing.advice


def test_gpiods_namesake_is_told_apart(pi: Pi, monkeypatch: pytest.MonkeyPatch) -> None:
    # Debian 12's own, seen through --system-site-packages, has no version that pip knows
    monkeypatch.setitem(sys.modules, "gpiod", ModuleType("gpiod"))
    pi.change(chips=replace(pi.machine.chips, gpio=real_gpiod))
    namesake = pi.found("packages")[0]
    assert namesake.ok is False
    assert "gpiod 1.x" in namesake.found
    assert "pip install 'gpiod>=2.1'" in namesake.advice
