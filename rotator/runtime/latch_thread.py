"""Writes a latched stop, a vain try or a doubt about a relay to its file at once: control never waits for a disk.

Knows when to write, when to try again on a card that refuses, and what to note in memory while a card hangs. Each file
has two threads, one for the card and one for memory. `rotator.store` knows the files' forms.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

T = TypeVar("T")

LATCH_THREAD, TRIES_THREAD, RELAYS_THREAD = "latch", "tries", "relays"
"""The names of the threads that write the card."""
IN_MEMORY = "-in-memory"
"""The ending of the names of the threads that write in memory."""
AGAIN_S = 10.0
"""Seconds of pause after a failed write before the same is tried again. Something new does not wait: the file has a
second place, in memory."""
LOOKS_S = 10.0
"""Seconds after which the same content is saved again: it is written if another program has changed the file."""
JOIN_S = 2.0


class LatchThread(Generic[T]):
    """`note` may be called from any thread and never waits; of several notes the newest is written."""

    def __init__(
        self,
        save: Callable[[T], bool],
        kept: T,
        *,
        spare: Callable[[T], None] = lambda _newest: None,
        again_s: float = AGAIN_S,
        name: str = LATCH_THREAD,
    ) -> None:
        """`save` writes the file, and returns False if that failed; the thread calls it. `spare` notes it in memory,
        while `save` still waits for the card.

        `kept`: what the file's last run has left; a damaged file is replaced with it.
        """
        self._save, self._spare = save, spare
        self._newest = kept
        self._again_s = again_s
        self._news = threading.Condition()
        self._unwritten = self._ending = self._ended = False
        self._writing = self._unspared = False
        """The card is being written; meanwhile something newer has come, and is not yet in memory."""
        self._sparing = threading.Lock()
        """The card is written with what memory has, or something newer."""
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._memory = threading.Thread(target=self._run_memory, name=name + IN_MEMORY, daemon=True)

    def start(self) -> None:
        self.note(self._newest)
        self._thread.start()
        self._memory.start()

    def note(self, newest: T) -> None:
        """This is in force from now on."""
        with self._news:
            self._newest, self._unwritten, self._unspared = newest, True, self._writing
            self._news.notify_all()

    def end(self) -> None:
        """Let the thread write the present state, and end. A failed write is tried once more. Returns at once."""
        with self._news:
            self._unwritten = self._ending = True
            self._news.notify_all()

    def close(self) -> None:
        """As `end`, and wait for the thread; not for a disk that hangs. May be called twice."""
        self.end()
        if self._thread.is_alive():
            self._thread.join(JOIN_S)

    def _run(self) -> None:
        last_try = False
        while True:
            with self._news:
                self._news.wait_for(lambda: self._unwritten, LOOKS_S)
            with self._sparing, self._news:
                self._unwritten = self._unspared = False
                self._writing, newest = True, self._newest
            done = self._save(newest)
            with self._news:
                self._writing = False
                # A stop may have come while the disk was slow: the end waits for it too.
                if self._ending and not self._unwritten and (done or last_try):
                    self._ended = True
                    self._news.notify_all()
                    return
                if not done:
                    last_try = self._ending
                    self._news.wait_for(lambda: self._ending or self._unwritten, self._again_s)
                    self._unwritten = True

    def _run_memory(self) -> None:
        while True:
            with self._news:
                self._news.wait_for(lambda: self._unspared or self._ended)
                if self._ended:
                    return
            with self._sparing:
                with self._news:
                    spared, self._unspared, newest = self._unspared, False, self._newest
                if spared:
                    self._spare(newest)
