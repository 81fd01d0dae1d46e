"""When to turn right round: a target that wavers across the end of the range must not swing the antenna each time.

Knows moments, and how often the target has asked for a swing lately. Knows no angles. The first swing begins at once;
each further one within two minutes waits twice as long as the one before, and only a target that stays there gets it.
Meanwhile the antenna rests at its end of the range, a few degrees from the target.
"""

from __future__ import annotations

FIRST_WAIT_S = 3.0
LONGEST_WAIT_S = 96.0
QUIET_S = 120.0
"""After so long without a swing or a wish for one, the next swing begins at once again."""


class Swings:
    def __init__(self) -> None:
        self._wait_s = 0.0
        """How long a target must stay beyond the end of the range before the next swing."""
        self._asked_s: float | None = None
        """When a swing was last wished for, or begun."""
        self._since_s: float | None = None
        """Since when the target has been where only a swing leads; None: the antenna can follow it as it stands."""

    def due(self, now_s: float) -> bool:
        """Whether a target that has waited has stayed for long enough."""
        return self._since_s is not None and now_s - self._since_s >= self._wait_s

    def may_begin(self, now_s: float) -> bool:
        """The target asks for a swing. True: it begins now."""
        if self._asked_s is not None and now_s - self._asked_s > QUIET_S:
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
        """The target asks for no swing any more."""
        self._since_s = None

    def break_off(self) -> None:
        """The target is back where it was before the swing began: the next one waits for longer."""
        self._since_s = None
        self._lengthen()

    def _lengthen(self) -> None:
        self._wait_s = min(max(2.0 * self._wait_s, FIRST_WAIT_S), LONGEST_WAIT_S)
