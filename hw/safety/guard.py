"""The guard: a thread that ends expired commands, so that a relay opens or a motor stops.

Knows one drive. Does not know the sensors or the program that gives the commands: when they hang, the guard still opens
the relay.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Protocol

from hw.ports import HardwareError
from hw.urgent import hurry

log = logging.getLogger(__name__)

GUARD_THREAD = "guard"
"""The name of the thread."""
RETRY_S = 0.05
"""The pause before the next try after a failure, in seconds."""
PATIENCE_S = 1.0
"""The longest sleep, in seconds. After it the guard checks the drive even if nothing has woken the thread."""


class Expiring(Protocol):
    """A drive whose commands expire."""

    def off(self) -> None:
        """The safe state, from any thread. Raises HardwareError."""

    def due_s(self) -> float | None:
        """When `enforce` is due; None: no command can expire."""

    def enforce(self, now_s: float) -> None:
        """End each command that has expired. Raises HardwareError."""

    def wait_until_due(self, patience_s: float) -> None:
        """Sleep until `enforce` is due or a command has changed, but no longer than `patience_s`."""


class Guard:
    """Guards one drive. `clock`: seconds, for the thread. `operator_must`: for the log: the operator's immediate action
    if the drive cannot be switched off.
    """

    def __init__(self, drive: Expiring, clock: Callable[[], float], *, operator_must: str = "") -> None:
        self._drive = drive
        self._clock = clock
        self._operator_must = operator_must
        self._failures: set[str] = set()
        """The failures since the last success. Each is in the log once."""
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

    def linger(self, awaited: Callable[[], bool], longest_s: float) -> None:
        """Wait while the thread works and this is still true, but no longer than that. Without a thread: not at all.

        Raises HardwareError if it is still true then, or the thread has died.
        """
        give_up_s = self._clock() + longest_s
        while self._thread.is_alive() and awaited() and self._clock() < give_up_s:
            self._stopping.wait(RETRY_S)
        if self._started and awaited():
            raise HardwareError("the guard has not engaged a brake: the sentinel does it")

    def check(self) -> None:
        """Raises HardwareError if the thread has ended without `stop`: then no command would expire."""
        if self._started and not self._stopping.is_set() and not self._thread.is_alive():
            raise HardwareError("the guard, which ends expired commands, has died")

    def enforce(self, now_s: float) -> None:
        """End each command that has expired. Logs each failure once and raises none. The next call tries again."""
        try:
            self._drive.enforce(now_s)
        except Exception as failure:
            self._report(failure)
            # When one line fails, the drive itself still opens the others. After a bug the drive may have opened none:
            # the guard then calls `off`, which is other code of the drive.
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
        """Log a failure and the operator's action, the first time only. A bug is logged with its traceback."""
        bug = None if isinstance(failure, HardwareError) else failure
        text = repr(bug) if bug else str(failure)
        # A bug is known by its type: its text may differ at each of 20 tries a second, and would fill the log.
        kind = type(bug).__name__ if bug else text
        if kind in self._failures:
            return
        self._failures.add(kind)
        log.error("%s", f"{self._operator_must}: {text}; trying again" if self._operator_must else text, exc_info=bug)

    def _watch(self) -> None:
        hurry()
        while not self._stopping.is_set():
            try:
                self._drive.wait_until_due(PATIENCE_S)
                now_s = self._clock()
            except Exception as failure:
                # Without the time, every command counts as expired.
                self._report(failure)
                self._switch_off()
                self._stopping.wait(RETRY_S)
                continue
            self.enforce(now_s)
            if self._failures:
                self._stopping.wait(RETRY_S)
