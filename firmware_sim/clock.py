"""Simulated time: it passes only in `sleep` and `sleep_until`.

Knows the present moment, and the alarms due on the way to a later one. Knows no rotor, no chip and no thread: all code
on a `SimClock` runs in one thread, so that an hour of tracking takes a second.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple


class Alarm(NamedTuple):  # asked some hundred times in each simulated second: a tuple is taken apart faster
    """A call at its moment while the program sleeps, as of a guard or a sampler.

    Of two alarms due at one moment, the one added first rings first.
    """

    due_s: Callable[[], float | None]
    ring: Callable[[float], None]


class SimClock:
    """`clock()` reads the time in seconds; `clock.sleep(seconds)` lets it pass."""

    def __init__(self, start_s: float = 0.0) -> None:
        self._now_s = start_s
        self._alarms: list[Alarm] = []

    def __call__(self) -> float:
        return self._now_s

    def add_alarm(self, due_s: Callable[[], float | None], ring: Callable[[float], None]) -> None:
        """Call `ring(now_s)` when the time reaches `due_s()` (None: nothing is due). `ring` must move `due_s()` on."""
        self._alarms.append(Alarm(due_s, ring))

    def every(self, period_s: float, ring: Callable[[float], None]) -> None:
        """Call `ring(now_s)` now, and then every `period_s` seconds, without drift."""
        start_s, count = self._now_s, 0

        def due_s() -> float:
            return start_s + count * period_s

        def ring_once(now_s: float) -> None:
            nonlocal count
            count += 1
            ring(now_s)

        self.add_alarm(due_s, ring_once)

    def sleep(self, seconds: float) -> None:
        """Let `seconds` pass, and ring the alarms on the way."""
        self.sleep_until(self._now_s + max(0.0, seconds))

    def sleep_until(self, moment_s: float) -> None:
        """Let time pass up to `moment_s`, and ring the alarms on the way, oldest first."""
        while True:
            first, first_s = None, math.inf
            for ask_s, ring in self._alarms:
                due_s = ask_s()
                if due_s is not None and due_s <= moment_s and due_s < first_s:
                    first, first_s = ring, due_s
            if first is None:
                break
            self._now_s = max(self._now_s, first_s)
            first(self._now_s)
        self._now_s = max(self._now_s, moment_s)
