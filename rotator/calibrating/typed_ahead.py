"""Entries between the terminal, or standard input, and the guide: when each may be given to it.

Knows that keys act at once and that lines wait for their question. Does not know the questions.
"""

from __future__ import annotations

from collections import deque

from rotator.calibrating.entries import Entry, Keyboard, StopNow, Word, from_line
from rotator.calibrating.guide import Guide


class TypedAhead:
    def __init__(self) -> None:
        self.keyboard = Keyboard()
        self._waiting: deque[Entry] = deque()
        self._by_key = False

    def key(self, pressed: str) -> None:
        """A key acts at once: a press that no question could take is not carried out later."""
        self._by_key = True
        entry = self.keyboard.key(pressed)
        if entry is not None:
            self._waiting.append(entry)

    def line(self, text: str | None) -> None:
        """A line waits for its question. `s` stops at once and clears the waiting lines. None: the input has ended."""
        entry = Word.QUIT if text is None else from_line(text)
        if isinstance(entry, StopNow):
            self._waiting.clear()
        self._waiting.append(entry)

    def next(self, guide: Guide) -> Entry | None:
        """The entry to give to the guide now."""
        if not self._waiting or not (self._by_key or guide.ready(self._waiting[0])):
            return None
        return self._waiting.popleft()
