"""Writes what the box remembers at once, a latched stop above all: control never waits for a disk.

Knows when to write, and when to try again on a card that refuses. One thread writes the card; while the card hangs,
another one notes in memory what comes. `rotator.store.state` knows what is written.
"""

from __future__ import annotations

import threading

from rotator.store.state import State

STATE_THREAD = "state"
"""The name of the thread that writes the card."""
IN_MEMORY = "-in-memory"
"""The ending of the name of the thread that writes in memory."""
LOOKS_S = 10.0
"""Seconds after which the same is saved again: a card that refused is tried again, and a file that another program has
changed is written. Something new does not wait for that."""
JOIN_S = 2.0


class StateThread:
    """Each note of the state is written soon; of several the newest."""

    def __init__(self, state: State, *, looks_s: float = LOOKS_S) -> None:
        self._state = state
        self._looks_s = looks_s
        self._ending = self._ended = self._again = False
        self._card = threading.Thread(target=self._run, name=STATE_THREAD, daemon=True)
        self._memory = threading.Thread(target=self._run_memory, name=STATE_THREAD + IN_MEMORY, daemon=True)

    def start(self) -> None:
        self._card.start()
        self._memory.start()

    def end(self) -> None:
        """Let the thread write the newest, and end. A failed write is tried once more. Returns at once."""
        with self._state.news:
            self._ending = self._again = True
            self._state.news.notify_all()

    def close(self) -> None:
        """As `end`, and wait for the thread; not for a disk that hangs. May be called twice."""
        self.end()
        if self._card.is_alive():
            self._card.join(JOIN_S)

    def _run(self) -> None:
        last_try = False
        while True:
            self._again = False
            done = self._state.save()
            with self._state.news:
                # A stop may have come while the disk was slow: the end waits for it too, and it is tried twice as well.
                newest = self._ending and not (self._again or self._state.unwritten)
                if newest and (done or last_try):
                    self._ended = True
                    self._state.news.notify_all()
                    return
                last_try = newest
                self._state.news.wait_for(lambda: self._ending or self._state.unwritten, self._looks_s)

    def _run_memory(self) -> None:
        while not self._ended:
            with self._state.news:
                self._state.news.wait_for(lambda: self._ended or self._state.unspared)
            self._state.spare()
