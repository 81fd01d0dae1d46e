"""The same complaint again and again, told seldom: at once the first time, then once a minute with a count.

Knows texts and moments. Knows no log.
"""

from __future__ import annotations

from collections.abc import Callable

EVERY_S = 60.0
MOST = 5
"""Different complaints a minute that are told in full: the angles of a moving target make each one different."""


class LogLimit:
    """`clock` gives seconds."""

    def __init__(self, clock: Callable[[], float], every_s: float = EVERY_S, most: int = MOST) -> None:
        self._clock = clock
        self._every_s = every_s
        self._most = most
        self._until_s = clock()
        self._told: set[str] = set()
        self._withheld = 0

    def tell(self, text: str) -> str | None:
        """What to say now; None: nothing, it has been said."""
        now_s = self._clock()
        if now_s >= self._until_s:
            self._until_s = now_s + self._every_s
            self._told = {text}
            withheld, self._withheld = self._withheld, 0
            return f"{text} ({withheld} more of the kind before)" if withheld else text
        if text in self._told or len(self._told) >= self._most:
            self._withheld += 1
            return None
        self._told.add(text)
        return text
