"""The kernel's software watchdog: a /dev/watchdog that says it would have rebooted, instead of doing it.

Knows its ioctls (linux/watchdog.h) and its last words in the kernel's log. Loaded with soft_noboot=1 by the stage.
"""

from __future__ import annotations

import fcntl
import os
import struct
import subprocess
from typing import Self

DEVICE = "/dev/watchdog"
SET_TIMEOUT_S = 0xC0045706
KEEP_ALIVE = 0x80045705
LAST_WORDS = "softdog: Triggered - Reboot ignored"


class Watchdog:
    """Open: it must be fed. Closed properly: it sleeps again."""

    def __init__(self, timeout_s: int) -> None:
        self._heard = _times_triggered()
        self._fd = os.open(DEVICE, os.O_WRONLY)
        fcntl.ioctl(self._fd, SET_TIMEOUT_S, struct.pack("i", timeout_s))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        os.write(self._fd, b"V")  # "magic close": the next close disarms it
        os.close(self._fd)

    def feed(self) -> None:
        fcntl.ioctl(self._fd, KEEP_ALIVE, struct.pack("i", 0))

    def fired(self) -> bool:
        """It would have rebooted the machine since it was opened."""
        return _times_triggered() > self._heard


def _times_triggered() -> int:
    return subprocess.run(["dmesg"], check=True, capture_output=True, text=True).stdout.count(LAST_WORDS)
