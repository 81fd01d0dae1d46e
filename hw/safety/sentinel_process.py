"""The sentinel: a small process that opens the relays when the program that closed them has died or hangs.

Knows the relay lines, the program's process and one pipe. On the pipe `+` means that a relay is on, `-` that all relays
are off, and `.` that the program ends properly. All other bytes are a question, which goes back as it came: so the
program knows that its sentinel is awake. The end of the pipe without `.` means that the program has died. Knows no
sensor, no order and no configuration.

It uses no bus, disk or network that could make it hang, and it is loaded and locked in memory before the first relay
may close. It is needed because a Raspberry Pi's kernel keeps the outputs of a dead program as they were.

    python -m hw.safety.sentinel_process LINES     started by the program; commands come on standard input
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import sys
import time
from collections.abc import Callable
from contextlib import suppress

from hw.buses.gpio import real_gpiod
from hw.drives.leases import LONGEST_LEASE_S
from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines, switch_off
from hw.urgent import hurry

SILENCE_S = LONGEST_LEASE_S + 0.2
"""Seconds of silence after which the program hangs: it writes `+` or `-` again before its longest lease ends."""
READY = b"ready\n"
PATIENCE_S = 5.0
"""Seconds that the sentinel waits until the kernel has freed the lines of a dead process."""

_MCL_CURRENT_AND_FUTURE = 3


def watch(commands: int, answers: int, program: int, off: Callable[[], None]) -> None:
    """Read the pipe `commands` until the program (a pidfd) ends, dies, or falls silent with a relay on. Questions go
    back on the pipe `answers`.

    Calls `off` at the end, unless the program has ended properly.
    """
    try:
        ended_properly = _read_until_end(commands, answers, program)
    except OSError:
        # Without the pipe the sentinel cannot know whether a relay is on. Off is safe.
        ended_properly = False
    if not ended_properly:
        off()


def _read_until_end(commands: int, answers: int, program: int) -> bool:
    """Whether the program ended properly."""
    last_on_s: float | None = None
    os.set_blocking(answers, False)
    while True:
        left_s = None if last_on_s is None else max(0.0, last_on_s + SILENCE_S - time.monotonic())
        ready, _, _ = select.select([commands], [], [], left_s)
        if not ready:
            # The program is stopped, frozen or starved. Kill it: only then its lines are free, and it cannot switch
            # them on again. The signal fails if it has just died and a child still holds the pipe open.
            with suppress(OSError):
                signal.pidfd_send_signal(program, signal.SIGKILL)
            return False
        received = os.read(commands, 4096)
        if not received:
            return False
        if question := received.translate(None, b"+-."):
            with suppress(BlockingIOError):  # the program reads no answer: nothing here waits for it
                os.write(answers, question)
        if said := received.translate(None, question):
            if said.endswith(b"."):
                return True
            last_on_s = time.monotonic() if said.endswith(b"+") else None


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print("usage: python -m hw.safety.sentinel_process LINES", file=sys.stderr)  # noqa: T201
        return 2
    return _watch(RelayLines.from_text(arguments[0]))


def _watch(lines: RelayLines) -> int:
    # The service manager sends SIGTERM to the whole group. This process ends when its work is done, never before.
    for ignored in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(ignored, signal.SIG_IGN)
    program = os.pidfd_open(os.getppid())
    api = real_gpiod()
    with api.Chip(lines.chip):
        pass  # a missing chip or permission must show before the first relay closes
    # Without the right to lock memory this fails, and the sentinel is only slower when memory has run out.
    ctypes.CDLL(None).mlockall(_MCL_CURRENT_AND_FUTURE)
    hurry()
    os.write(sys.stdout.fileno(), READY)
    watch(
        sys.stdin.fileno(),
        sys.stdout.fileno(),
        program,
        lambda: switch_off(api, lines, time.monotonic, time.sleep, PATIENCE_S),
    )
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (HardwareError, OSError) as fault:
        sys.exit(f"sentinel: {fault}")
