"""Finding the low end stop of an axis that counts pulses. A person orders it, and watches.

Down until no pulse comes for three periods: that is the stop, or a dead contact. So up again until a pulse has come,
and down once more: the same pulses must come back before the contact is quiet again. Then the axis stands at its stop.
Knows what the relays do and how often the contact has changed. Knows no angle, and cannot tell a stop from a branch in
which the antenna hangs: the person who watches can.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from hw.ports import Direction

QUIET_PERIODS = 3.0
PROOF = 2
"""Changes of the contact on the way up that prove it alive: it has closed and opened."""
ALIKE = 1
"""Changes that may be missing on the way back, or be too many: the stop may be at an edge of the contact."""


@dataclass(frozen=True, slots=True)
class HomingSettings:
    """What homing needs to know of an axis."""

    period_s: float
    """From one pulse to the next at full speed."""
    travel_s: float
    """From end to end."""
    coast_s: float
    """From the relay's opening until the motor stands for certain."""
    home_deg: float
    """The angle of the low end stop."""


class _Phase(Enum):
    DOWN = "down"
    UP = "up"
    DOWN_AGAIN = "down again"
    SETTLE = "settle"


class Homing:
    """One axis. Call `step` every cycle for the direction to drive, until it has `homed` or there is a `failure`."""

    def __init__(self, settings: HomingSettings) -> None:
        self.home_deg = settings.home_deg
        self.homed = False
        self.failure = ""
        """Why homing has given up; empty: it has not."""
        self._quiet_after_s = QUIET_PERIODS * settings.period_s
        self._longest_s = 1.5 * settings.travel_s + 2.0 * self._quiet_after_s
        self._coast_s = settings.coast_s
        self._phase = _Phase.DOWN
        self._began_s: float | None = None
        self._still_s = 0.0
        """Since when neither the contact nor the relays have changed."""
        self._driven = Direction.OFF
        self._changes = 0
        self._base = 0
        self._up = 0

    def step(self, now_s: float, driven: Direction, changes: int) -> Direction:
        """The direction to drive now.

        `driven`: what the relays really do, for a reversal takes its dead time; `changes`: of the contact, so far.
        """
        if self._began_s is None:
            self._began_s, self._still_s, self._changes = now_s, now_s, changes
        if driven is not self._driven or changes != self._changes:
            turning_back = driven is Direction.MINUS and self._driven is not Direction.MINUS
            if self._phase is _Phase.DOWN_AGAIN and turning_back:
                self._up, self._base = changes - self._base, changes
            self._driven, self._changes, self._still_s = driven, changes, now_s
        if self.homed or self.failure:
            return Direction.OFF
        if now_s - self._began_s > self._longest_s:
            return self._fail("it was driven for longer than its whole travel takes, and pulses still come")
        still_s = now_s - self._still_s
        wanted = self._wanted()
        quiet = driven is wanted and still_s > self._quiet_after_s
        match self._phase:
            case _Phase.DOWN if quiet:
                self._phase, self._base = _Phase.UP, changes
            case _Phase.UP if changes - self._base >= PROOF:
                self._phase = _Phase.DOWN_AGAIN
            case _Phase.UP if quiet:
                return self._fail("no pulse came in either direction: look at the contact, its wires and the motor")
            case _Phase.DOWN_AGAIN if quiet:
                back = changes - self._base
                if abs(back - self._up) > ALIKE:
                    return self._fail(f"{self._up} edges came on the way up and {back} on the way back")
                self._phase = _Phase.SETTLE
            case _Phase.SETTLE if driven is Direction.OFF and still_s >= self._coast_s:
                self.homed = True
        return self._wanted()

    def _wanted(self) -> Direction:
        match self._phase:
            case _Phase.DOWN | _Phase.DOWN_AGAIN:
                return Direction.MINUS
            case _Phase.UP:
                return Direction.PLUS
            case _Phase.SETTLE:
                return Direction.OFF

    def _fail(self, why: str) -> Direction:
        self.failure = f"not homed: {why}"
        return Direction.OFF
