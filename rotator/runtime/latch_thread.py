"""Writes a latched stop to its file at once, in a thread of its own: the control loop never waits for a disk.

Knows when to write, and when to try again on a card that refuses. `rotator.store.latch` knows the file's form.
"""

from __future__ import annotations

import threading

from rotator.status import Latch
from rotator.store.latch import LatchFile

LATCH_THREAD = "latch"
"""The name of the thread."""
AGAIN_S = 10.0
"""After a failed write the next try waits so long: a dying card is not written for each press."""
JOIN_S = 2.0


class LatchThread:
    """`note` may be called from any thread and never waits; of several notes the newest is written."""

    def __init__(self, file: LatchFile, latch: Latch | None) -> None:
        """`latch`: what the file's last run has left; a damaged file is replaced with it."""
        self._file = file
        self._newest = latch
        self._changed, self._ending = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name=LATCH_THREAD, daemon=True)

    def start(self) -> None:
        self._changed.set()
        self._thread.start()

    def note(self, latch: Latch | None) -> None:
        """This is in force from now on; None: nothing is latched."""
        self._newest = latch
        self._changed.set()

    def close(self) -> None:
        """Write what is in force, and end. A disk that hangs is left behind. May be called twice."""
        self._ending.set()
        self._changed.set()
        if self._thread.is_alive():
            self._thread.join(JOIN_S)

    def _run(self) -> None:
        while True:
            self._changed.wait()
            self._changed.clear()
            done = self._file.save(self._newest)
            if self._ending.is_set():
                return
            if not done:
                self._ending.wait(AGAIN_S)
                self._changed.set()
