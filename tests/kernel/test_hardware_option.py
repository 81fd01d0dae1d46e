"""`pytest tests/contract --hardware`, as on a Pi: the kernel's pins and bus, with a stand-in for its pinctrl tool."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.contract.bench import RELAYS
from tests.contract.chips import Chips
from tests.kernel.bench.edges import EdgeRecorder
from tests.kernel.bench.gpio import GpioChip
from tests.kernel.bench.i2c import I2CAdapter

PROJECT = Path(__file__).resolve().parents[2]
PINCTRL = """#!/bin/sh
# As on a Pi 4: "22: op dh pd | hi // GPIO22 = output"
read level < {lines}/sim_gpio$2/value
[ "$level" = 1 ] && level=hi || level=lo
echo "$2: op -- pd | $level // GPIO$2 = output"
"""
CONFIG = """
[rotor]
hardware = "pi"
[adc]
bus = {bus}
[lcd]
kind = "pcf8574"
bus = {bus}
"""


class Pi:
    def __init__(self, header: GpioChip, bus: int, folder: Path) -> None:
        self.header = header
        self._path = f"{folder}:{os.environ['PATH']}"
        self._config = folder / "rotator.toml"
        self._config.write_text(CONFIG.format(bus=bus))
        pinctrl = folder / "pinctrl"
        pinctrl.write_text(PINCTRL.format(lines=header.lines))
        pinctrl.chmod(0o755)

    def check(self, tests: str, *options: str) -> subprocess.CompletedProcess[str]:
        hardware = ["--hardware", "--hardware-config", str(self._config), *options]
        quick = ["-p", "no:cacheprovider", "-p", "no:hypothesispytest"]
        return subprocess.run(
            [sys.executable, "-m", "pytest", *quick, *hardware, tests],
            cwd=PROJECT,
            env=os.environ | {"PATH": self._path},
            capture_output=True,
            text=True,
            check=False,
        )


@pytest.fixture
def pi(tmp_path: Path) -> Iterator[Pi]:
    with GpioChip() as header, I2CAdapter(Chips().wire) as adapter:
        assert adapter.number is not None
        yield Pi(header, adapter.number, tmp_path)


def test_what_a_pi_can_show_passes_and_the_rest_says_why_not(pi: Pi) -> None:
    done = pi.check("tests/contract", "--motors-are-unplugged")
    assert done.returncode == 0, done.stdout
    assert "test_each_pattern" not in done.stdout, "skipped or failed"
    for sentence in ("can put 0.2 V on input 0", "draw a real plug", "it should read SAT A:235 E:025"):
        assert sentence in done.stdout


def test_no_relay_closes_before_somebody_says_that_the_motors_are_unplugged(pi: Pi) -> None:
    with EdgeRecorder(pi.header) as recorder:
        recorder.know(*RELAYS.values())
        done = pi.check("tests/contract/test_relay_bank.py")
        assert done.returncode == 0, done.stdout
        assert "unplug the motors, then add --motors-are-unplugged" in done.stdout
        assert [edge for edge in recorder.edges() if edge.offset in RELAYS.values()] == []
