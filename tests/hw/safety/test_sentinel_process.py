"""The sentinel's own part, on real pipes and real processes, with simulated lines.

Its life as a process beside the box is tried on a real kernel (tests/kernel).
"""

from __future__ import annotations

import os
import signal
import subprocess
import threading
import time
from collections.abc import Iterator

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.clock import SimClock
from hw.buses.gpio import GpioOutputs, LinesBusyError
from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines, switch_off
from hw.safety.sentinel_process import SILENCE_S, watch
from tests.tables import every_row

CHIP = "/dev/gpiochip0"
LINES = RelayLines(CHIP, {"azimuth_cw": 22, "azimuth_ccw": 23}, active_low=False)
PATIENCE_S = 20.0


class Program:
    """A process that could be the box, the pipe it would write to, and the sentinel's watch in a thread."""

    def __init__(self) -> None:
        self.process = subprocess.Popen(["sleep", "1000"])
        self.pidfd = os.pidfd_open(self.process.pid)
        self.commands, self.pipe = os.pipe()
        self.answers, self._answering = os.pipe()
        self.off_s: float | None = None
        self.unbraked = 0
        self._thread = threading.Thread(
            target=watch, args=(self.commands, self._answering, self.pidfd, self._off), name="watch"
        )
        self._thread.start()

    def says(self, commands: bytes) -> None:
        os.write(self.pipe, commands)

    def ends(self) -> None:
        os.close(self.pipe)
        self.pipe = -1

    def watch_ended(self) -> bool:
        self._thread.join(PATIENCE_S)
        return not self._thread.is_alive()

    def alive(self) -> bool:
        return self.process.poll() is None

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        if self.pipe >= 0:
            os.close(self.pipe)
        self._thread.join(PATIENCE_S)
        for file in (self.commands, self.answers, self._answering, self.pidfd):
            os.close(file)

    def _off(self, unbraked: int) -> None:
        self.unbraked = unbraked
        self.off_s = time.monotonic()


@pytest.fixture
def program() -> Iterator[Program]:
    made = Program()
    yield made
    made.close()


# --- what it answers


@pytest.mark.parametrize(
    ("said", "question"), [(b"1f", b"1f"), (b"+1f", b"1f"), (b"1f+", b"1f"), (b"1-f-", b"1f")], ids=repr
)
def test_a_question_goes_back_as_it_came(program: Program, said: bytes, question: bytes) -> None:
    program.says(said)
    assert os.read(program.answers, 100) == question
    program.says(b"-.")
    assert program.watch_ended()
    assert program.off_s is None


def test_a_question_is_no_sign_of_a_program_that_keeps_its_leases(program: Program) -> None:
    """Its event loop still asks; the thread that renews the leases hangs."""
    program.says(b"+")
    while program.off_s is None and program.alive():
        program.says(b"1f")
    assert program.watch_ended()
    assert program.process.wait(PATIENCE_S) == -signal.SIGKILL


# --- when it acts


def test_the_end_of_the_pipe_is_the_end_of_the_program(program: Program) -> None:
    program.says(b"+-")
    program.ends()
    assert program.watch_ended()
    assert program.off_s is not None


def test_it_acts_at_the_end_even_after_the_message_that_all_is_off(program: Program) -> None:
    program.ends()
    assert program.watch_ended()
    assert program.off_s is not None


@pytest.mark.parametrize(("said", "number"), [(b"A+", 1), (b"A+-@", 0), (b"+AC-1f", 3), (b"A1f-B+", 2)], ids=repr)
def test_it_knows_which_brakes_are_off_when_the_program_dies(program: Program, said: bytes, number: int) -> None:
    program.says(said)
    program.ends()
    assert program.watch_ended()
    assert program.unbraked == number


def test_silence_with_a_relay_on_ends_the_program_first(program: Program) -> None:
    begun_s = time.monotonic()
    program.says(b"+")
    assert program.watch_ended()
    assert program.process.wait(PATIENCE_S) == -signal.SIGKILL
    assert program.off_s is not None
    assert program.off_s - begun_s >= SILENCE_S


def test_a_program_that_is_gone_already_leaves_the_relays_to_be_opened(program: Program) -> None:
    """Its end of the pipe is still open in another process, so its death shows as silence."""
    program.process.kill()
    program.process.wait()
    program.says(b"+")
    assert program.watch_ended()
    assert program.off_s is not None


def test_a_pipe_that_cannot_be_read_is_no_reason_to_leave_them_closed() -> None:
    offs: list[bool] = []
    reading, writing = os.pipe()
    os.close(reading)
    watch(reading, -1, -1, lambda _unbraked: offs.append(True))
    os.close(writing)
    assert offs == [True]


# --- what it does


def test_lines_left_on_by_the_dead_are_switched_off() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    dead = GpioOutputs(gpio, CHIP, LINES.offsets, consumer="rotator-relays")
    dead.set({"azimuth_cw": True})
    dead.close()
    switch_off(gpio, LINES, clock, clock.sleep, 1.0)
    assert not gpio.level(22)
    assert not gpio.level(23)
    # The lines are free again: the next start of the program takes them.
    GpioOutputs(gpio, CHIP, LINES.offsets, consumer="rotator-relays").close()


def test_active_low_relays_are_off_at_high() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    levels: list[tuple[int, bool]] = []
    gpio.on_edges.append(lambda _now_s, changes: levels.extend(changes.items()))
    switch_off(gpio, RelayLines(CHIP, {"azimuth_cw": 22}, active_low=True), clock, clock.sleep, 1.0)
    assert (22, True) in levels


def test_it_waits_until_the_kernel_has_taken_the_dead_apart() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    dying = GpioOutputs(gpio, CHIP, LINES.offsets, consumer="rotator-relays")
    dying.set({"azimuth_cw": True})
    due_s: list[float] = [clock() + 0.3]

    def let_go(_now_s: float) -> None:
        due_s.clear()
        dying.close()

    clock.add_alarm(lambda: due_s[0] if due_s else None, let_go)
    switch_off(gpio, LINES, clock, clock.sleep, 1.0)
    assert not gpio.level(22)
    assert clock() == pytest.approx(0.3, abs=0.01)


def test_lines_that_are_never_released_are_reported() -> None:
    clock = SimClock()
    gpio = SimGpio(clock)
    GpioOutputs(gpio, CHIP, LINES.offsets, consumer="somebody else")
    with pytest.raises(LinesBusyError, match="azimuth_cw on GPIO22"):
        switch_off(gpio, LINES, clock, clock.sleep, 1.0)


# --- how it gets its lines


@every_row(
    "text", ["", "/dev/gpiochip0", "/dev/gpiochip0 low a=1", "x active-low a", "x active-low a=b", "x active-low a=1=2"]
)
def test_any_other_text_is_refused(text: str) -> None:
    with pytest.raises(HardwareError, match="not a description of relay lines"):
        RelayLines.from_text(text)
