"""How many readings of a sensor are bad: a few are ridden out, more are noticed, and too many are a fault.

Knows which readings are bad. Does not know what makes a reading bad, nor what a motor does meanwhile.
"""

from __future__ import annotations

from collections import deque

from rotator.exchange.faults import Notice

LOOKED_AT = 100
"""Number of latest readings that count: five seconds at 20 Hz, two at 50 Hz."""
NOTICED, NOTICED_NO_MORE = 4, 1
TOO_MANY_BAD = 8
HEALED_S = 1.0
"""A fault for too many bad readings can be acknowledged this long after the last bad one."""
NOTICE = Notice(
    "bad readings now and then: look for a loose wire, a worn pot, or motor cables beside the sensor's", "BAD READINGS"
)


class BadReadings:
    """Give it every reading of one sensor (`note`), in order of time."""

    def __init__(self) -> None:
        self._bad: deque[bool] = deque(maxlen=LOOKED_AT)
        self._count = 0
        self._noticed = False
        self._bad_s: float | None = None
        """When the latest bad reading came."""
        self._too_many = False

    @property
    def count(self) -> int:
        """How many of the latest readings are bad."""
        return self._count

    @property
    def notice(self) -> Notice | None:
        return NOTICE if self._noticed else None

    def note(self, at_s: float, *, bad: bool) -> None:
        """One more reading."""
        if len(self._bad) == LOOKED_AT:
            self._count -= self._bad[0]
        self._bad.append(bad)
        self._count += bad
        if bad:
            self._bad_s = at_s
        if self._count >= NOTICED:
            self._noticed = True
        elif self._count <= NOTICED_NO_MORE:
            self._noticed = False
        self._too_many = self._too_many or self._count >= TOO_MANY_BAD

    def too_many(self, now_s: float) -> bool:
        """Whether the sensor is too bad to move the axis. It is good again after a while without a bad reading."""
        if self._too_many and self._bad_s is not None and now_s - self._bad_s >= HEALED_S:
            self._too_many = False
            self._bad.clear()
            self._count = 0
        return self._too_many
