"""Whether this computer's clock has been set by a time server: a Raspberry Pi has no clock of its own.

Knows two ways to ask: the kernel, which every time service tells (adjtimex(2)), and systemd's `timedatectl`, which asks
the kernel for a service that may not. Does not know what hangs on the answer.
"""

from __future__ import annotations

import ctypes
import subprocess

_ASK_NOTHING = bytes(512)
"""A `struct timex` of zeros asks and changes nothing. It has 208 bytes at most on the machines that are known."""
_ERROR = 5
"""TIME_ERROR: the clock is not synchronised."""
_TIMEDATECTL = ("timedatectl", "show", "--property=NTPSynchronized", "--value")
PATIENCE_S = 10.0
SET_AGAIN_S, UNSET_AGAIN_S, LONG_UNSET_AGAIN_S = 600.0, 5.0, 30.0
"""How long an answer stands: a clock that is set seldom gets lost, and one that is not is waited for."""
SOON_S = 120.0
"""After this time without a network it may take hours."""


class SystemClock:
    """`is_set` may be read from any thread; `look` takes some milliseconds, and belongs to one thread."""

    def __init__(self) -> None:
        self.is_set = False
        """As of the latest look."""
        self._again_s = 0.0
        self._unset_since_s: float | None = None

    def look(self, now_s: float) -> None:
        """Ask again, where the last answer is old. `now_s`: on any clock that only goes forward."""
        if now_s >= self._again_s:
            self.is_set = _by_kernel() if (told := _by_timedatectl()) is None else told
            if self.is_set:
                self._unset_since_s = None
                self._again_s = now_s + SET_AGAIN_S
                return
            self._unset_since_s = now_s if self._unset_since_s is None else self._unset_since_s
            soon = now_s - self._unset_since_s < SOON_S
            self._again_s = now_s + (UNSET_AGAIN_S if soon else LONG_UNSET_AGAIN_S)


def _by_timedatectl() -> bool | None:
    """None: there is no answer."""
    try:
        done = subprocess.run(_TIMEDATECTL, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return {"yes": True, "no": False}.get(done.stdout.strip())


def _by_kernel() -> bool:
    """Where the kernel does not tell: no."""
    try:
        state = int(ctypes.CDLL(None).adjtimex(ctypes.create_string_buffer(_ASK_NOTHING, len(_ASK_NOTHING))))
    except (OSError, AttributeError):
        return False
    return 0 <= state < _ERROR
