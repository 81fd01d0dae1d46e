"""The guard: a thread that ends what has expired, a closed relay or a motor on its way, and touches nothing else.

Knows one drive. Does not know the sensors, the bus or the program that gives the commands, so none of them can
hold a relay on by hanging.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Protocol

from hw.ports import HardwareError

log = logging.getLogger(__name__)

RETRY_S = 0.05
PATIENCE_S = 1.0
"""It looks again after so long even if nothing called it."""


class Expiring(Protocol):
    """A drive whose commands expire."""

    def off(self) -> None:
        """The safe state, from any thread."""

    def due_s(self) -> float | None:
        """The moment `enforce` has something to do; None: nothing does."""

    def enforce(self, now_s: float) -> None:
        """End what has expired. Raises HardwareError."""

    def wait_until_due(self, patience_s: float) -> None:
        """Sleep until `enforce` has something to do, or something changed, or that long."""


class Guard:
    """`alarm`: what a person is to do at once where the drive cannot be switched."""

    def __init__(self, drive: Expiring, clock: Callable[[], float], *, alarm: str = "") -> None:
        self._drive = drive
        self._clock = clock
        self._alarm = alarm
        self._failed = ""
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="guard", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Everything off, then the thread ends. Raises HardwareError if a line cannot be switched."""
        self._stopping.set()
        try:
            self._drive.off()
        finally:
            if self._thread.is_alive():
                self._thread.join(timeout=2 * PATIENCE_S)

    def enforce(self, now_s: float) -> None:
        """End what has expired. What fails is said once, and tried again when this is called again."""
        try:
            self._drive.enforce(now_s)
            self._failed = ""
        except HardwareError as fault:
            if str(fault) != self._failed:
                self._failed = str(fault)
                log.error("%s", f"{self._alarm}: {fault}; trying again" if self._alarm else self._failed)

    def _watch(self) -> None:
        while not self._stopping.is_set():
            self._drive.wait_until_due(PATIENCE_S)
            self.enforce(self._clock())
            if self._failed:
                self._stopping.wait(RETRY_S)
