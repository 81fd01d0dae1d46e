"""What the service manager starts when program and sentinel are dead: how little it loads, and what it asks the kernel.

The structures are written down here once more, from linux/gpio.h. That relays open is tried on a real kernel
(tests/kernel).
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import pytest

import hw.safety.off_at_once
from hw.safety.off_at_once import READ_LINES, REQUEST, request, switch_off

SCRIPT = Path(hw.safety.off_at_once.__file__)
UNIT = Path(__file__).parents[3] / "install" / "rotator.service"


class Attribute(ctypes.Structure):
    _fields_ = (
        ("id", ctypes.c_uint32),
        ("padding", ctypes.c_uint32),
        ("value", ctypes.c_uint64),
        ("mask", ctypes.c_uint64),
    )


class LineConfig(ctypes.Structure):
    _fields_ = (
        ("flags", ctypes.c_uint64),
        ("num_attrs", ctypes.c_uint32),
        ("padding", ctypes.c_uint32 * 5),
        ("attrs", Attribute * 10),
    )


class LineRequest(ctypes.Structure):
    _fields_ = (
        ("offsets", ctypes.c_uint32 * 64),
        ("consumer", ctypes.c_char * 32),
        ("config", LineConfig),
        ("num_lines", ctypes.c_uint32),
        ("event_buffer_size", ctypes.c_uint32),
        ("padding", ctypes.c_uint32 * 5),
        ("fd", ctypes.c_int32),
    )


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-I", "-S", *arguments]
    return subprocess.run(command, check=False, capture_output=True, text=True)


@pytest.mark.parametrize(("active_low", "flags"), [(False, 0b1000), (True, 0b1010)])
def test_the_kernel_reads_outputs_that_are_off(active_low: bool, flags: int) -> None:
    asked = LineRequest.from_buffer_copy(request([17, 27, 4], active_low=active_low))
    assert (asked.num_lines, list(asked.offsets[:4])) == (3, [17, 27, 4, 0])
    assert asked.config.flags == flags
    # No attribute names a value: each output begins inactive, which is off at either level.
    assert asked.config.num_attrs == 0
    assert asked.consumer == b"rotator-off"


@pytest.mark.parametrize(("active_low", "flags"), [(False, 0), (True, 0b10)])
def test_brakes_are_looked_at_as_they_are_before_they_engage(active_low: bool, flags: int) -> None:
    # No direction asks for the lines as they are: with one, the look itself would switch them.
    asked = LineRequest.from_buffer_copy(request([16], active_low=active_low, output=0))
    assert asked.config.flags == flags
    # _IOWR(0xB4, 0x0E, struct gpio_v2_line_values), which has two u64: the levels, and which of them are asked for.
    assert READ_LINES == (0b11 << 30) | (16 << 16) | (0xB4 << 8) | 0x0E


def test_the_file_of_the_lines_is_found_in_the_kernels_answer() -> None:
    answer = LineRequest.from_buffer_copy(request([17], active_low=False))
    answer.fd = 42
    assert REQUEST.unpack(bytes(answer))[-1] == 42


def test_without_a_file_there_is_nothing_to_switch_off(tmp_path: Path) -> None:
    # The program never came so far, or it ran a simulation.
    assert run(str(SCRIPT), str(tmp_path / "relay-lines")).returncode == 0


def test_a_device_that_is_no_gpio_chip_refuses() -> None:
    with pytest.raises(OSError, match="Inappropriate ioctl for device"):
        # Only lines that are held are asked for again: else the service would stand still for all this time.
        switch_off(os.devnull, [17], active_low=False, patience_s=3600.0)


def test_the_unit_starts_it_without_packages() -> None:
    first = next(line for line in UNIT.read_text().splitlines() if line.startswith("ExecStopPost="))
    assert "/bin/python -I -S " in first
    assert f"/{SCRIPT.parent.name}/{SCRIPT.name} " in first
