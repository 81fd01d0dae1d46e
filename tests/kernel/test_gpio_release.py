"""What is left on the pins when the program that held them dies, under both rules that Linux has.

Raspberry Pi kernels leave a line driven (persist); mainline, and a Pi with dtparam=strict_gpiod, gives it up, and the
pull decides. A relay's pin must therefore rest at its pull in the off position, and something must survive the program.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Iterator

import gpiod
import pytest

from hw.buses.gpio import GpioOutputs
from tests.kernel.bench.gpio import GpioChip, persisting
from tests.kernel.bench.waiting import until

PULLED_UP, PULLED_DOWN = 5, 22
HOLDER = """
import gpiod, sys
from hw.buses.gpio import GpioOutputs
lines = GpioOutputs(gpiod, sys.argv[1], {"up": 5, "down": 22}, consumer="holder")
lines.set({"up": sys.argv[2] == "1", "down": sys.argv[2] == "1"})
print("held", flush=True)
sys.stdin.read()
"""


@pytest.fixture
def chip() -> Iterator[GpioChip]:
    with GpioChip() as chip:
        chip.pull(PULLED_UP, up=True)
        chip.pull(PULLED_DOWN, up=False)
        yield chip


def killed_while_holding(chip: GpioChip, level: bool) -> None:
    """A program takes both lines, sets them, and is killed without a chance to clean up."""
    holder = subprocess.Popen(
        [sys.executable, "-c", HOLDER, chip.path, str(int(level))], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    )
    with holder:
        assert holder.stdout is not None
        assert holder.stdout.readline() == b"held\n"
        assert chip.level(PULLED_UP) is chip.level(PULLED_DOWN) is level
        assert used(chip) == {"up": "holder", "down": "holder"}
        holder.send_signal(signal.SIGKILL)
    until(lambda: not used(chip), "the lines given back")


def used(chip: GpioChip) -> dict[str, str]:
    with gpiod.Chip(chip.path) as opened:
        infos = {"up": opened.get_line_info(PULLED_UP), "down": opened.get_line_info(PULLED_DOWN)}
    return {name: info.consumer for name, info in infos.items() if info.used}


@pytest.mark.parametrize("level", [True, False], ids=["high", "low"])
def test_killed_on_a_raspberry_pi_the_lines_stay_as_they_were(chip: GpioChip, level: bool) -> None:
    with persisting(True):
        killed_while_holding(chip, level)
        assert chip.level(PULLED_UP) is chip.level(PULLED_DOWN) is level


def test_killed_on_a_strict_kernel_the_pulls_decide(chip: GpioChip) -> None:
    with persisting(False):
        killed_while_holding(chip, level=True)
        assert chip.level(PULLED_UP)
        assert not chip.level(PULLED_DOWN)


def test_who_comes_next_takes_over_what_was_left_on(chip: GpioChip) -> None:
    with persisting(True):
        killed_while_holding(chip, level=True)
        lines = GpioOutputs(gpiod, chip.path, {"down": PULLED_DOWN}, consumer="next")
        assert not chip.level(PULLED_DOWN), "off in the very call that takes it"
        lines.close()
        assert not chip.level(PULLED_DOWN)
