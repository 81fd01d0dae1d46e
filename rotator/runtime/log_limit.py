"""Limits repeated log lines: a text passes at once, its repetitions once a minute with a count.

Knows texts and the time. Does not write the log.
"""

from __future__ import annotations

from collections.abc import Callable

EVERY_S = 60.0
MOST = 5
"""Different texts admitted in one minute. A limit is needed: the angles of a moving target make each text different."""


class LogLimit:
    """`clock` gives seconds. Each text is admitted once in `every_s`, and at most `most` different texts."""

    def __init__(self, clock: Callable[[], float], every_s: float = EVERY_S, most: int = MOST) -> None:
        self._clock = clock
        self._every_s = every_s
        self._most = most
        self._until_s = clock()
        self._admitted: set[str] = set()
        self._withheld = 0

    def admit(self, text: str) -> str | None:
        """The line to log now, with the count of lines withheld before it; None: log nothing."""
        now_s = self._clock()
        if now_s >= self._until_s:
            self._until_s = now_s + self._every_s
            self._admitted = {text}
            withheld, self._withheld = self._withheld, 0
            return f"{text} ({withheld} similar lines before this one are not shown)" if withheld else text
        if text in self._admitted or len(self._admitted) >= self._most:
            self._withheld += 1
            return None
        self._admitted.add(text)
        return text
