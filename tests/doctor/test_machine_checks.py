"""The checks that need no configuration: a healthy Pi passes each, and each damage is told with its cure."""

from __future__ import annotations

import sys
from dataclasses import replace
from types import ModuleType

import pytest

from hw.buses.gpio import real_gpiod
from rotator.doctor.checks import OF_THE_MACHINE
from rotator.doctor.finding import Check
from rotator.doctor.machine import Machine
from tests.doctor.conftest import Pi


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("python", "Python 3.11.2, 64-bit"),
        ("packages", "gpiod 2.3.0, smbus2 0.5.0, pyserial 3.5"),
        ("kernel", "Linux 6.12.34+rpt-rpi-v8 (aarch64, 64-bit), Raspberry Pi 4 Model B Rev 1.4"),
        ("power", "no sag since the start (0x0)"),
        ("temperature", "48 °C"),
        ("clock", "set by the network"),
        ("watchdog", "restarts a frozen computer after 15 s"),
    ],
)
def test_a_healthy_pi(pi: Pi, name: str, found: str) -> None:
    finding = pi.only(name)
    assert (finding.mark, finding.found, finding.advice) == ("✓", found, "")


@pytest.mark.parametrize("check", OF_THE_MACHINE, ids=lambda check: check.name)
def test_a_machine_that_tells_nothing_ends_no_check(pi: Pi, check: Check[[Machine]]) -> None:
    bare = replace(pi.machine, root=pi.folder / "nothing", programs=str(pi.folder / "nothing"), packages=())
    assert list(check.look(bare))


# --- software


@pytest.mark.parametrize("version", [(3, 10, 12), (3, 14, 0)])
def test_another_python(pi: Pi, version: tuple[int, int, int]) -> None:
    pi.change(python=version, pointer_bits=32)
    finding = pi.only("python")
    assert finding.ok is False
    assert "32-bit" in finding.found
    assert "3.11, 3.12 or 3.13" in finding.advice


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


def test_an_old_kernel(pi: Pi) -> None:
    pi.change(kernel=("5.4.83-v7l+", "armv7l"))
    finding = pi.only("kernel")
    assert finding.ok is False
    assert "32-bit" in finding.found
    assert "apt full-upgrade" in finding.advice


def test_a_pc_is_no_pi(pi: Pi) -> None:
    pi.remove("/proc/device-tree/model")
    assert pi.only("kernel").found.endswith("not a Raspberry Pi")


# --- power and heat; bits of `vcgencmd get_throttled`, Raspberry Pi documentation


@pytest.mark.parametrize(
    ("bits", "mark", "words"),
    [
        ("0x1", "✗", "under-voltage now"),
        ("0x50005", "✗", "under-voltage now, throttled now"),
        ("0x50000", "!", "under-voltage since the start, throttled since the start"),
        ("0x2", "!", "clock capped now"),
        ("0x80008", "!", "too hot now"),
        ("0x20000", "!", "clock capped since the start"),
    ],
)
def test_a_sagging_supply(pi: Pi, bits: str, mark: str, words: str) -> None:
    pi.program("vcgencmd", f"echo throttled={bits}")
    finding = pi.only("power")
    assert (finding.mark, finding.found) == (mark, f"{words} ({bits})")
    assert ("power supply" in finding.advice) == ("under-voltage" in words)


def test_without_vcgencmd_the_kernel_tells(pi: Pi) -> None:
    (pi.folder / "bin" / "vcgencmd").unlink()
    pi.write("/sys/devices/platform/soc/soc:firmware/get_throttled", "50005\n")
    assert pi.only("power").ok is False


@pytest.mark.parametrize(("alarm", "mark"), [("0", "✓"), ("1", "✗")])
def test_a_kernel_that_only_knows_the_alarm(pi: Pi, alarm: str, mark: str) -> None:
    pi.program("vcgencmd", "exit 1")
    pi.write("/sys/class/hwmon/hwmon0/name", "cpu_thermal\n")
    pi.write("/sys/class/hwmon/hwmon1/name", "rpi_volt\n")
    pi.write("/sys/class/hwmon/hwmon1/in0_lcrit_alarm", f"{alarm}\n")
    assert pi.only("power").mark == mark


def test_where_nothing_tells_of_the_supply(pi: Pi) -> None:
    pi.program("vcgencmd", "echo VCHI initialization failed")
    assert pi.only("power").mark == "–"


def test_a_hot_pi(pi: Pi) -> None:
    pi.write("/sys/class/thermal/thermal_zone0/temp", "82300\n")
    finding = pi.only("temperature")
    assert (finding.mark, finding.found) == ("!", "82 °C")
    assert "heat sink" in finding.advice


# --- the clock


def test_a_clock_that_nobody_set(pi: Pi) -> None:
    pi.program("timedatectl", "echo no")
    finding = pi.only("clock")
    assert finding.mark == "!"
    assert "timedatectl set-ntp true" in finding.advice


def test_timesyncd_leaves_a_file(pi: Pi) -> None:
    (pi.folder / "bin" / "timedatectl").unlink()
    pi.write("/run/systemd/timesync/synchronized")
    assert pi.only("clock").mark == "✓"


@pytest.mark.parametrize(("leap", "mark"), [("Normal", "✓"), ("Not synchronised", "!")])
def test_chrony_tells_too(pi: Pi, leap: str, mark: str) -> None:
    (pi.folder / "bin" / "timedatectl").unlink()
    pi.program("chronyc", f"echo 'Leap status     : {leap}'")
    assert pi.only("clock").mark == mark


# --- the watchdog


def test_a_watchdog_that_nobody_feeds(pi: Pi) -> None:
    pi.write("/sys/class/watchdog/watchdog0/state", "inactive\n")
    finding = pi.only("watchdog")
    assert finding.mark == "!"
    assert "RuntimeWatchdogSec=15" in finding.advice


@pytest.mark.parametrize(("asked_for", "mark"), [("15s", "✓"), ("0", "!"), ("infinity", "!")])
def test_a_kernel_that_does_not_tell_the_watchdogs_state(pi: Pi, asked_for: str, mark: str) -> None:
    pi.remove("/sys/class/watchdog/watchdog0/state")
    pi.program("systemctl", f"echo {asked_for}")
    assert pi.only("watchdog").mark == mark


def test_a_pi_without_a_watchdog(pi: Pi) -> None:
    pi.remove("/dev/watchdog")
    assert pi.only("watchdog").mark == "!"
    pi.remove("/proc/device-tree/model")
    assert pi.only("watchdog").mark == "–"


# --- the service


@pytest.mark.parametrize(
    ("state", "mark", "advice"),
    [
        (("enabled", "active", "running"), "✓", ""),
        (("enabled", "failed", "failed"), "✗", "journalctl -u rotator"),
        (("enabled", "activating", "auto-restart"), "✗", "journalctl -u rotator"),
        (("enabled", "inactive", "dead"), "!", "systemctl start rotator"),
        (("disabled", "active", "running"), "!", "systemctl enable rotator"),
    ],
)
def test_the_service(pi: Pi, state: tuple[str, str, str], mark: str, advice: str) -> None:
    enabled, active, sub = state
    pi.write("/etc/systemd/system/rotator.service", "[Service]\nUser=rotator\n")
    pi.program("systemctl", f"echo UnitFileState={enabled}; echo ActiveState={active}; echo SubState={sub}")
    finding = pi.only("service")
    assert finding.mark == mark
    assert advice in finding.advice


@pytest.mark.parametrize(("policies", "mark"), [("002", "✓"), ("000", "!")])
def test_whether_its_motor_threads_go_before_other_programs(pi: Pi, policies: str, mark: str) -> None:
    pi.write("/etc/systemd/system/rotator.service", "[Service]\nUser=rotator\n")
    pi.program(
        "systemctl", "echo UnitFileState=enabled; echo ActiveState=active; echo SubState=running; echo MainPID=7"
    )
    for number, policy in enumerate(policies):
        pi.write(f"/proc/7/task/{number}/stat", f"{number} (rotator run) S {'0 ' * 37}{policy} 0 0")
    finding = pi.only("service")
    assert (finding.mark, "no priority" in finding.found) == (mark, mark == "!")


def test_no_service(pi: Pi) -> None:
    assert (pi.only("service").mark, pi.only("service").found[:13]) == ("–", "not installed")


def test_a_service_without_a_systemd_that_answers(pi: Pi) -> None:
    pi.write("/usr/lib/systemd/system/rotator.service", "[Service]\n")
    pi.program("systemctl", "echo 'System has not been booted with systemd' >&2; exit 1")
    assert pi.only("service").mark == "–"
