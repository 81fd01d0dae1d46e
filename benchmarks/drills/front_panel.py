"""The mode and the stop that the front panel's switch and button give at a moment, as the script moves them.

Knows how long a switch must stand still, and that only a turn that begins while the button is out releases a stop. Does
not know orders.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

STILL_S, STILL_AT_MOST_S = 0.95, 1.3
"""A mode switch counts when it has stood still for a second, at the next cycle."""
NO_TURN_S = 0.4
"""Between two looks further apart than this the program did not run."""


@dataclass(frozen=True, slots=True)
class Turned:
    """The mode switch counts in its new position."""

    mode: str
    since_s: float
    """The earliest moment at which the switch may count: a later order may belong to the new mode."""
    releases: bool
    """Whether this turn releases a stop."""


class FrontPanel:
    """Call `turn`, `press` and `pull` for the events of the panel, and `look` in every cycle."""

    def __init__(self) -> None:
        self.mode = self._stands_at = "auto"
        """The mode in force, and the position of the switch."""
        self.pressed = False
        """The stop button is pressed in."""
        self._pulled_s = -math.inf
        self._turn: Turned | None = None
        self._due_s = 0.0
        """When the turn has surely counted."""
        self._released: Turned | None = None
        """A turn that another turn followed before it had surely counted: it may have released a stop or PARK."""
        self._looked_s = 0.0

    @property
    def settled(self) -> bool:
        return self._turn is None

    def may_turn(self, now_s: float) -> bool:
        """Whether the mode switch turns, and may count by now."""
        return self._turn is not None and self._turn.since_s <= now_s

    def turn(self, mode: str, at_s: float) -> None:
        if mode == self._stands_at:
            return  # the switch does not move, so its second of standing still goes on
        self._stands_at = mode
        releases = not self.pressed and self._pulled_s <= at_s
        if self._turn is not None and self._turn.since_s <= at_s and self._turn.releases:
            self._released = replace(self._turn, mode=self._turn.mode if self.mode == "park" else self.mode)
        self._turn, self._due_s = Turned(mode, at_s + STILL_S, releases), at_s + STILL_AT_MOST_S

    def press(self) -> None:
        self.pressed = True

    def pull(self, at_s: float) -> None:
        self.pressed, self._pulled_s = False, at_s

    def look(self, now_s: float) -> Turned | None:
        """The turn that has come to count since the last look."""
        looked_s, self._looked_s = self._looked_s, now_s
        if self._released is not None:
            released, self._released = self._released, None
            self.mode = released.mode
            return released
        if self._turn is None:
            return None
        # If the program did not run, only the time after the switch was moved counts.
        missed_s = now_s - max(looked_s, self._turn.since_s - STILL_S)
        if missed_s > NO_TURN_S:
            self._due_s += missed_s
        if now_s < self._due_s:
            return None
        turn, self._turn = self._turn, None
        self.mode = turn.mode
        return turn
