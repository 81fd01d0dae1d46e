"""The latest bytes of all links for the page, in the lines of `rotator monitor`.

Knows numbered lines. The bytes of a link take one entry of a bounded list, and never wait for a reader. A slow reader
misses lines, and gets their number. Does not know the readers.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.monitor.tap import Tap

MOST_LINES, LONGEST_LINE = 1000, 600


@dataclass(frozen=True, slots=True)
class Lines:
    """`upto`: number of the next line. `missed`: how many lines before these are lost."""

    lines: Sequence[str]
    upto: int
    missed: int


class WireLog:
    """`keep` and `forget` are called in the thread of the links; `after` in any other."""

    def __init__(self, tap: Tap) -> None:
        self._tap = tap
        self._lines: deque[tuple[int, str]] = deque(maxlen=MOST_LINES)
        self._next = 0
        self.greeting: Sequence[str] = ()
        """The first lines of a recording."""

    def keep(self) -> None:
        self.greeting = self._tap.greeting()
        self._tap.listeners.append(self._hear)

    def forget(self) -> None:
        if self._hear in self._tap.listeners:
            self._tap.listeners.remove(self._hear)

    def _hear(self, line: str) -> None:
        if len(line) > LONGEST_LINE:
            line = f"{line[:LONGEST_LINE]} …"
        self._lines.append((self._next, line))
        self._next += 1

    def recording(self) -> list[str]:
        """All kept lines, in the form of `rotator monitor`."""
        return [*self.greeting, *(line for _, line in list(self._lines))]

    def after(self, number: int, most: int = MOST_LINES) -> Lines:
        """The lines from this number on, the oldest first. All lines if the number is too high: from an earlier run."""
        if number > self._next:
            number = 0
        if number >= self._next:
            return Lines((), number, 0)
        kept = [each for each in list(self._lines) if each[0] >= number][:most]
        if not kept:
            return Lines((), number, 0)
        return Lines([line for _, line in kept], kept[-1][0] + 1, kept[0][0] - number)
