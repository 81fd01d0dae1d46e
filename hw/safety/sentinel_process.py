"""The sentinel: a small process that opens the relays when the program that closed them is gone or stands still.

Knows the relay lines, the program's process, and one pipe: `+` says that a relay is on (or still on), `-` that all are
off, `.` farewell after a proper end, and its end without one that the program has died, however it did. Knows nothing
else, holds nothing that can hang, and is loaded and locked in memory before the first relay may close. A Raspberry Pi's
kernel leaves outputs as they were when their owner dies; this process is what opens them then.

    python -m hw.safety.sentinel_process watch JSON     started by the program; commands come on standard input
    python -m hw.safety.sentinel_process now FILE       for the service manager, after the program has ended
"""

from __future__ import annotations

import ctypes
import os
import select
import signal
import sys
import time
from collections.abc import Callable
from pathlib import Path

from hw.buses.gpio import real_gpiod
from hw.drives.relays import LONGEST_LEASE_S
from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines, switch_off

SILENCE_S = LONGEST_LEASE_S + 0.2
"""A program that runs says `+` or `-` again before its longest lease is over; after this long it stands still."""
READY = b"ready\n"
PATIENCE_S = 5.0
"""How long a dead process may hold on to its lines."""

_MCL_CURRENT_AND_FUTURE = 3


def watch(commands: int, program: int, off: Callable[[], None]) -> None:
    """Read the pipe `commands` until the program (a pidfd) dies or falls silent with a relay on; then `off`."""
    last_on_s: float | None = None
    while True:
        left_s = None if last_on_s is None else max(0.0, last_on_s + SILENCE_S - time.monotonic())
        ready, _, _ = select.select([commands], [], [], left_s)
        if not ready:
            # Stopped, frozen, or starved: only when it is gone are the lines free, and it cannot switch them on again.
            signal.pidfd_send_signal(program, signal.SIGKILL)
            break
        said = os.read(commands, 4096)
        if not said:
            break
        if said.endswith(b"."):
            return
        last_on_s = time.monotonic() if said.endswith(b"+") else None
    off()


def main(arguments: list[str]) -> int:
    match arguments:
        case ["watch", text]:
            return _watch(RelayLines.from_json(text))
        case ["now", file]:
            return _now(Path(file))
        case _:
            print("usage: python -m hw.safety.sentinel_process watch JSON | now FILE", file=sys.stderr)  # noqa: T201
            return 2


def _watch(lines: RelayLines) -> int:
    # The service manager ends the whole group with SIGTERM; this process ends when its work is done, never before.
    for ignored in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(ignored, signal.SIG_IGN)
    program = os.pidfd_open(os.getppid())
    api = real_gpiod()
    with api.Chip(lines.chip):
        pass  # it is there and may be opened: found out now, not when it matters
    # Without the right to lock memory it works all the same, only slower when memory has run out.
    ctypes.CDLL(None).mlockall(_MCL_CURRENT_AND_FUTURE)
    os.write(sys.stdout.fileno(), READY)
    watch(sys.stdin.fileno(), program, lambda: switch_off(api, lines, time.monotonic, time.sleep, PATIENCE_S))
    return 0


def _now(file: Path) -> int:
    try:
        lines = RelayLines.from_json(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return 0  # the program never came so far as to take its lines, or ran a simulation
    switch_off(real_gpiod(), lines, time.monotonic, time.sleep, PATIENCE_S)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (HardwareError, OSError) as fault:
        sys.exit(f"sentinel: {fault}")
