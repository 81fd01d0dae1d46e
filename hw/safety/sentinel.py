"""The program's side of the sentinel: starts it, and tells it of every lease.

Knows the child process and its pipe. Does not know when a relay is on: the relay bank says so.
"""

from __future__ import annotations

import os
import select
import subprocess
import sys
from contextlib import suppress
from fcntl import F_SETPIPE_SZ, fcntl
from pathlib import Path

from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines
from hw.safety.sentinel_process import READY

START_S = 20.0
END_S = 6.0
PIPE_BYTES = 4096
"""A sentinel that no longer reads fills so small a pipe within minutes of motion, and is noticed."""
OOM_SCORE = 300
"""The program is to be killed before its sentinel when memory runs out; the child keeps the score it was born with."""


class Sentinel:
    """Started when made. Raises HardwareError when it does not come up: no relay may close then."""

    def __init__(self, lines: RelayLines) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "hw.safety.sentinel_process", "watch", lines.to_json()],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C in the terminal is for the program alone
        )
        assert self._process.stdin is not None
        self._pipe = self._process.stdin.fileno()
        os.set_blocking(self._pipe, False)
        fcntl(self._pipe, F_SETPIPE_SZ, PIPE_BYTES)
        if not self._is_ready():
            self.close()
            raise HardwareError("the sentinel, which opens the relays if the program dies, does not start")
        _die_first()

    @property
    def pid(self) -> int:
        return self._process.pid

    def renew(self) -> None:
        try:
            os.write(self._pipe, b"+")
        except OSError as fault:
            raise HardwareError(f"the sentinel (process {self.pid}) is gone or stuck: no relay may close") from fault

    def rest(self) -> None:
        # A sentinel that is gone needs no news; the next renewal says that it is.
        with suppress(OSError):
            os.write(self._pipe, b"-")

    def dismiss(self) -> None:
        """Every relay is off: it need not look."""
        with suppress(OSError):
            os.write(self._pipe, b".")

    def close(self) -> None:
        """Let it end. Not dismissed, it switches the lines off: they must have been let go."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.close()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()

    def _is_ready(self) -> bool:
        assert self._process.stdout is not None
        answered, _, _ = select.select([self._process.stdout], [], [], START_S)
        return bool(answered) and os.read(self._process.stdout.fileno(), len(READY)) == READY


def _die_first() -> None:
    score = Path("/proc/self/oom_score_adj")
    with suppress(OSError, ValueError):
        if int(score.read_text()) < OOM_SCORE:
            score.write_text(str(OOM_SCORE))
