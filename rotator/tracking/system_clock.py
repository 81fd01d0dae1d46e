"""Whether this computer's clock has been set by a time server, and how far it may be off: a Raspberry Pi has no clock
of its own.

Knows two ways to ask: the kernel, which every time service informs (adjtimex(2)); and systemd's `timedatectl`, which
asks the kernel for a service without that right. Does not know the use of the answer.
"""

from __future__ import annotations

import ctypes
import subprocess

ASSUMED_ERROR_S = 1.0
"""Error in seconds assumed for a clock that a person calls right, or if the system reports no smaller one."""
CRYSTAL_SHARE = 0.1
"""The kernel lets its largest error grow by 500 ppm. A computer's crystal is off by a tenth of that."""


class _Timex(ctypes.Structure):
    """The beginning of `struct timex`. With zeros in it adjtimex asks, and changes nothing."""

    _fields_ = (
        ("modes", ctypes.c_uint),
        ("offset", ctypes.c_long),
        ("freq", ctypes.c_long),
        ("maxerror", ctypes.c_long),
        ("esterror", ctypes.c_long),
        ("rest", ctypes.c_char * 512),  # 208 bytes in all at most, on the machines that are known
    )


_ERROR = 5
"""TIME_ERROR: the clock is not synchronised."""
_TIMEDATECTL = ("timedatectl", "show", "--property=NTPSynchronized", "--value")
PATIENCE_S = 10.0
SET_AGAIN_S, UNSET_AGAIN_S, LONG_UNSET_AGAIN_S = 600.0, 5.0, 30.0
"""Seconds that an answer is kept: "set" for long, because it seldom changes; "not set" for a short time, because
the operator waits for it."""
SOON_S = 120.0
"""Seconds after which an unset clock is asked less often: without a network it may take hours."""


class SystemClock:
    """`is_set` may be read from any thread; `look` takes some milliseconds, and belongs to one thread."""

    def __init__(self) -> None:
        self.is_set = False
        """The result of the latest `look`."""
        self.error_s = ASSUMED_ERROR_S
        """How far the clock may be off in seconds, at the latest `look`."""
        self._again_s = 0.0
        self._unset_since_s: float | None = None

    def look(self, now_s: float) -> None:
        """Ask again if the last answer is old. `now_s`: on any clock that only goes forward."""
        if now_s >= self._again_s:
            by_kernel, self.error_s = _by_kernel()
            self.is_set = by_kernel if (told := _by_timedatectl()) is None else told
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


def _by_kernel() -> tuple[bool, float]:
    """Whether the clock is set, and its error in seconds. If the kernel does not answer: not set."""
    asked = _Timex()
    try:
        state = int(ctypes.CDLL(None).adjtimex(ctypes.byref(asked)))
    except (OSError, AttributeError):
        return False, ASSUMED_ERROR_S
    if not 0 <= state < _ERROR:
        return False, ASSUMED_ERROR_S
    return True, expected_s(asked.maxerror, asked.esterror)


def expected_s(most_us: int, estimated_us: int) -> float:
    """From the kernel's largest and estimated error in microseconds. Not every time service tells the second one."""
    error_s = (estimated_us if estimated_us > 0 else CRYSTAL_SHARE * most_us) / 1e6
    return min(ASSUMED_ERROR_S, max(0.0, error_s))
