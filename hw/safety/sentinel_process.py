"""The sentinel: a small process that opens the relays when the program that closed them has died or hangs.

Knows the relay lines, the program's process and one pipe. On the pipe `+` means that a relay is on, `-` that all relays
are off, and `.` that the program ends properly. `@`, `A`, `B` and `C` say which brakes are off: these engage later than
the relays open. All other bytes are a question, which goes back as it came: so the program knows that its sentinel is
awake. The end of the pipe without `.` means that the program has died. Knows no sensor, no order and no configuration.

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
from dataclasses import dataclass

from hw.buses.gpio import real_gpiod
from hw.drives.brake import BRAKES
from hw.drives.leases import LONGEST_LEASE_S
from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines, switch_off
from hw.urgent import hurry

SILENCE_S = LONGEST_LEASE_S + 0.2
"""Seconds of silence after which the program hangs: it writes `+` or `-` again before its longest lease ends."""
UNBRAKED = b"@ABC"
"""By number: 1 for the first axis, 2 for the second."""
READY = b"ready\n"
PATIENCE_S = 5.0
"""Seconds that the sentinel waits until the kernel has freed the lines of a dead process."""

_MCL_CURRENT_AND_FUTURE = 3


def watch(commands: int, answers: int, program: int, off: Callable[[int], None]) -> None:
    """Read the pipe `commands` until the program (a pidfd) ends, dies, or falls silent with a relay on. Questions go
    back on the pipe `answers`.

    Calls `off` at the end with the number of the brakes that are off, unless the program has ended properly.
    """
    heard = _Heard()
    try:
        ended_properly = _read_until_end(commands, answers, program, heard)
    except OSError:
        # Without the pipe the sentinel cannot know whether a relay is on. Off is safe.
        ended_properly = False
    if not ended_properly:
        off(heard.unbraked)


@dataclass(slots=True)
class _Heard:
    """What the program has said last."""

    silent_at_s: float | None = None
    """When it has been silent for too long; None: it may be silent."""
    unbraked: int = 0


def _read_until_end(commands: int, answers: int, program: int, heard: _Heard) -> bool:
    """Whether the program ended properly."""
    os.set_blocking(answers, False)
    while True:
        left_s = None if heard.silent_at_s is None else max(0.0, heard.silent_at_s - time.monotonic())
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
        if question := received.translate(None, b"+-." + UNBRAKED):
            with suppress(BlockingIOError):  # the program reads no answer: nothing here waits for it
                os.write(answers, question)
        if brakes := received.translate(None, question + b"+-."):
            heard.unbraked = UNBRAKED.index(brakes[-1])
        if said := received.translate(None, question + UNBRAKED):
            if said.endswith(b"."):
                return True
            heard.silent_at_s = time.monotonic() + SILENCE_S if said.endswith(b"+") else None


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
        lambda unbraked: switch_off(
            api, lines, time.monotonic, time.sleep, PATIENCE_S, unbraked=_brakes(lines, unbraked)
        ),
    )
    return 0


def _brakes(lines: RelayLines, number: int) -> list[str]:
    """The lines of the brakes that this number names."""
    named = (line for place, line in enumerate(BRAKES.values()) if number >> place & 1)
    return [line for line in named if line in lines.offsets]


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (HardwareError, OSError) as fault:
        sys.exit(f"sentinel: {fault}")
