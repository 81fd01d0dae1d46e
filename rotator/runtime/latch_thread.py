"""Writes a latched stop, or a vain try, to its file at once, in a thread of its own: control never waits for a disk.

Knows when to write, and when to try again on a card that refuses. `rotator.store` knows the files' forms.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")

LATCH_THREAD, TRIES_THREAD = "latch", "tries"
"""The names of the threads."""
AGAIN_S = 10.0
"""Seconds of pause after a failed write before the same is tried again. Something new does not wait: the file has a
second place, in memory."""
JOIN_S = 2.0


class LatchThread(Generic[T]):
    """`note` may be called from any thread and never waits; of several notes the newest is written."""

    def __init__(
        self, save: Callable[[T], bool], kept: T, *, again_s: float = AGAIN_S, name: str = LATCH_THREAD
    ) -> None:
        """`save` writes the file, and returns False if that failed; the thread calls it.

        `kept`: what the file's last run has left; a damaged file is replaced with it.
        """
        self._save = save
        self._newest = kept
        self._again_s = again_s
        self._news = threading.Condition()
        self._unwritten = self._ending = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self) -> None:
        self.note(self._newest)
        self._thread.start()

    def note(self, newest: T) -> None:
        """This is in force from now on."""
        with self._news:
            self._newest, self._unwritten = newest, True
            self._news.notify()

    def end(self) -> None:
        """Let the thread write the present state, and end. A failed write is tried once more. Returns at once."""
        with self._news:
            self._unwritten = self._ending = True
            self._news.notify()

    def close(self) -> None:
        """As `end`, and wait for the thread; not for a disk that hangs. May be called twice."""
        self.end()
        if self._thread.is_alive():
            self._thread.join(JOIN_S)

    def _run(self) -> None:
        last_try = False
        while True:
            with self._news:
                self._news.wait_for(lambda: self._unwritten)
                self._unwritten, newest = False, self._newest
            done = self._save(newest)
            with self._news:
                # A stop may have come while the disk was slow: the end waits for it too.
                if self._ending and not self._unwritten and (done or last_try):
                    return
                if not done:
                    last_try = self._ending
                    self._news.wait_for(lambda: self._ending or self._unwritten, self._again_s)
                    self._unwritten = True
