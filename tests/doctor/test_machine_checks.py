"""The checks that need no configuration, where files and programs alone do not tell: packages, and alarms."""

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


@pytest.mark.parametrize("check", OF_THE_MACHINE, ids=lambda check: check.name)
def test_a_machine_that_tells_nothing_ends_no_check(pi: Pi, check: Check[[Machine]]) -> None:
    bare = replace(pi.machine, root=pi.folder / "nothing", programs=str(pi.folder / "nothing"), packages=())
    assert list(check.look(bare))


# --- software


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


# --- power and heat; bits of `vcgencmd get_throttled`, Raspberry Pi documentation


@pytest.mark.parametrize(("alarm", "mark"), [("0", "✓"), ("1", "✗")])
def test_a_kernel_that_only_knows_the_alarm(pi: Pi, alarm: str, mark: str) -> None:
    pi.program("vcgencmd", "exit 1")
    pi.write("/sys/class/hwmon/hwmon0/name", "cpu_thermal\n")
    pi.write("/sys/class/hwmon/hwmon1/name", "rpi_volt\n")
    pi.write("/sys/class/hwmon/hwmon1/in0_lcrit_alarm", f"{alarm}\n")
    assert pi.only("power").mark == mark


# --- the watchdog
