"""The program's side of the sentinel: starts the process, and reports each lease of a relay to it.

Knows the child process and its pipe. Does not know when a relay is on: the relay bank calls `renew` and `rest`.
"""

from __future__ import annotations

import errno
import os
import select
import subprocess
import sys
from collections.abc import Collection
from contextlib import suppress
from fcntl import F_SETPIPE_SZ, fcntl
from pathlib import Path
from secrets import token_hex

from hw.drives.brake import BRAKES
from hw.ports import HardwareError
from hw.safety.lines_off import RelayLines
from hw.safety.sentinel_process import READY, UNBRAKED

START_S = 20.0
"""Seconds allowed for the start of the process."""
END_S = 6.0
"""Seconds allowed for the end of the process, before it is killed."""
PIPE_BYTES = 4096
"""The pipe's size. It is small: when the sentinel stops reading, the pipe is full after minutes of motion, and `renew`
raises. `is_awake` tells it within seconds."""
OOM_SCORE = 300
"""When memory runs out, the kernel must kill the program before its sentinel: the child keeps the lower score."""


class Sentinel:
    """Starts the process. Raises HardwareError when it does not start: no relay may close then."""

    def __init__(self, lines: RelayLines) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "hw.safety.sentinel_process", lines.to_text()],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C in the terminal is for the program alone
        )
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._pipe = self._process.stdin
        self._asked = self._heard = b""
        os.set_blocking(self._pipe.fileno(), False)
        fcntl(self._pipe, F_SETPIPE_SZ, PIPE_BYTES)
        if not self._is_ready():
            self.close()
            raise HardwareError("the sentinel, which opens the relays if the program dies, does not start")
        os.set_blocking(self._process.stdout.fileno(), False)
        _die_first()

    @property
    def pid(self) -> int:
        return self._process.pid

    def renew(self) -> None:
        """A relay is on, or is about to close. Raises HardwareError when the sentinel has gone or does not read."""
        try:
            self._send(b"+")
        except OSError as fault:
            raise HardwareError(f"the sentinel (process {self.pid}) is gone or stuck: no relay may close") from fault

    def is_awake(self) -> bool:
        """Whether it has answered the last question. If so, the next one is asked. Of one thread."""
        assert self._process.stdout is not None
        with suppress(OSError, ValueError):
            self._heard += os.read(self._process.stdout.fileno(), PIPE_BYTES)
        if not self._heard.endswith(self._asked):
            return False
        # Drawn by lot, so that no earlier answer is taken for this one's.
        self._asked, self._heard = token_hex(4).encode(), b""
        with suppress(OSError):  # what does not reach it has no answer either
            self._send(self._asked)
        return True

    def rest(self) -> None:
        """All relays are off."""
        # A failure does no harm here: the next renewal fails too, and raises.
        with suppress(OSError):
            self._send(b"-")

    def unbraked(self, lines: Collection[str]) -> None:
        """These brakes are off: they engage later than the relays open. Raises HardwareError as `renew`."""
        said = sum(1 << place for place, line in enumerate(BRAKES.values()) if line in lines)
        try:
            self._send(UNBRAKED[said : said + 1])
        except OSError as fault:
            raise HardwareError(f"the sentinel (process {self.pid}) is gone or stuck: no brake may be off") from fault

    def dismiss(self) -> None:
        """All relays are off and stay off: the sentinel ends without switching the lines."""
        with suppress(OSError):
            self._send(b".")

    def close(self) -> None:
        """End the process. May be called twice.

        A sentinel that was not dismissed switches the lines off: release them before this call.
        """
        assert self._process.stdout is not None
        self._pipe.close()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stdout.close()

    def _send(self, command: bytes) -> None:
        """Raises OSError."""
        if self._pipe.closed:  # another file may have its number now
            raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))
        os.write(self._pipe.fileno(), command)

    def _is_ready(self) -> bool:
        assert self._process.stdout is not None
        answered, _, _ = select.select([self._process.stdout], [], [], START_S)
        return bool(answered) and os.read(self._process.stdout.fileno(), len(READY)) == READY


def _die_first() -> None:
    score = Path("/proc/self/oom_score_adj")
    with suppress(OSError, ValueError):
        if int(score.read_text()) < OOM_SCORE:
            score.write_text(str(OOM_SCORE))
