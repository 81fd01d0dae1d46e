"""When the antenna turns right round (a swing) to follow a target that has crossed the end of the azimuth range.

A target that goes to and fro across that end must not cause a swing each time. The first swing begins at once. Each
further one within two minutes waits twice as long as the one before, and it begins only if the target stays beyond the
end for that time. Meanwhile the antenna waits at the end of the range, a few degrees from the target. Knows moments.
Knows no angles.
"""

from __future__ import annotations

import math

FIRST_WAIT_S = 3.0
LONGEST_WAIT_S = 96.0
QUIET_S = 120.0
"""After this time in which no swing was needed, the next one begins at once again."""


class Swings:
    """Moments are seconds on one clock."""

    def __init__(self) -> None:
        self._wait_s = 0.0
        """How long a target must stay beyond the end of the range before the next swing."""
        self._asked_s = -math.inf
        """When the target last needed a swing."""
        self._since_s: float | None = None
        """Since when the target has needed a swing; None: the antenna follows it without one."""

    def due(self, now_s: float) -> bool:
        """Whether the target has needed a swing for long enough."""
        return self._since_s is not None and now_s - self._since_s >= self._wait_s

    def may_begin(self, now_s: float) -> bool:
        """The target needs a swing. True: it begins now."""
        if now_s - self._asked_s > QUIET_S:
            self._wait_s = 0.0
        self._asked_s = now_s
        if self._since_s is None:
            self._since_s = now_s
        if not self.due(now_s):
            return False
        self._since_s = None
        self._lengthen()
        return True

    def forgo(self) -> None:
        """The target needs no swing any more."""
        self._since_s = None

    def break_off(self) -> None:
        """The target is back within the range, and the swing is given up half way: the next one waits for longer."""
        self._since_s = None
        self._lengthen()

    def _lengthen(self) -> None:
        self._wait_s = min(max(2.0 * self._wait_s, FIRST_WAIT_S), LONGEST_WAIT_S)
