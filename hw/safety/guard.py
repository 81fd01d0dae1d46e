"""The guard: a thread that ends what has expired, a closed relay or a motor on its way.

Knows one drive. Does not know the sensors, the bus or the program that gives the commands, so none of them can hold a
relay on by hanging.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Protocol

from hw.ports import HardwareError

log = logging.getLogger(__name__)

GUARD_THREAD = "guard"
"""The name of the thread."""
RETRY_S = 0.05
"""The pause before the next try after a failure, in seconds."""
PATIENCE_S = 1.0
"""The longest sleep, in seconds: then the guard looks again even if nothing has woken it."""


class Expiring(Protocol):
    """A drive whose commands expire."""

    def off(self) -> None:
        """The safe state, from any thread. Raises HardwareError."""

    def due_s(self) -> float | None:
        """The moment `enforce` has something to do; None: nothing does."""

    def enforce(self, now_s: float) -> None:
        """End what has expired. Raises HardwareError."""

    def wait_until_due(self, patience_s: float) -> None:
        """Sleep until `enforce` has something to do, or something changed, but no longer than `patience_s`."""


class Guard:
    """Guards one drive. `alarm`: what the operator must do at once where the drive cannot be switched off."""

    def __init__(self, drive: Expiring, clock: Callable[[], float], *, alarm: str = "") -> None:
        self._drive = drive
        self._clock = clock
        self._alarm = alarm
        self._failures: set[str] = set()
        """What has failed since the last success; each is in the log once."""
        self._started = False
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._watch, name=GUARD_THREAD, daemon=True)

    def start(self) -> None:
        self._started = True
        self._thread.start()

    def stop(self) -> None:
        """Switch everything off, then end the thread. May be called again. Raises HardwareError if a line fails."""
        self._stopping.set()
        try:
            self._drive.off()
        finally:
            if self._thread.is_alive():
                self._thread.join(timeout=2 * PATIENCE_S)

    def check(self) -> None:
        """Raises HardwareError when the thread has ended although it was not stopped: then no command would expire."""
        if self._started and not self._stopping.is_set() and not self._thread.is_alive():
            raise HardwareError("the guard, which ends expired commands, has died")

    def enforce(self, now_s: float) -> None:
        """End what has expired. Raises nothing: logs each failure once. The next call tries again."""
        try:
            self._drive.enforce(now_s)
        except Exception as failure:
            self._report(failure)
            # A line that fails is the drive's to handle: it still opens the others. After a bug the drive may have
            # handled nothing, so the guard switches everything off, which takes another way through the drive.
            if not isinstance(failure, HardwareError):
                self._switch_off()
        else:
            self._failures.clear()

    def _switch_off(self) -> None:
        try:
            self._drive.off()
        except Exception as failure:
            self._report(failure)

    def _report(self, failure: Exception) -> None:
        """Log a failure with what to do, the first time only; a bug with its traceback."""
        bug = None if isinstance(failure, HardwareError) else failure
        text = repr(bug) if bug else str(failure)
        # The text of a bug may differ each time, 20 times a second.
        kind = type(bug).__name__ if bug else text
        if kind in self._failures:
            return
        self._failures.add(kind)
        log.error("%s", f"{self._alarm}: {text}; trying again" if self._alarm else text, exc_info=bug)

    def _watch(self) -> None:
        while not self._stopping.is_set():
            try:
                self._drive.wait_until_due(PATIENCE_S)
                now_s = self._clock()
            except Exception as failure:
                # Without a moment to compare with, everything counts as expired.
                self._report(failure)
                self._switch_off()
                self._stopping.wait(RETRY_S)
                continue
            self.enforce(now_s)
            if self._failures:
                self._stopping.wait(RETRY_S)
