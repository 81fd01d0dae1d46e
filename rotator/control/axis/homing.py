"""Finding the low end stop, or the low limit switch, of an axis that counts pulses. A person orders it, and watches.

Down until the end shows: the limit switch opens, or, without one, no pulse comes for three periods. A dead contact and
a branch look the same. So up again until pulses have come, and down once more: when the same number comes back, the
axis is home; otherwise it tries again. Changes are counted only while the shaft stands: a shaft that coasts over an
edge of the contact, and turns back there, changes it at any moment. Knows what the relays do, the contact and the
switch. Does not know an angle, and cannot tell a stop from a branch that holds the antenna: the person can.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from hw.ports import Direction
from rotator.control.axis.readings import Condition

QUIET_PERIODS = 3.0
PROOF_CHANGES = 2
"""Changes of the contact on the way up that prove it alive: it has closed and opened."""
ALIKE_CHANGES = 1
"""Changes that may be missing on the way back, or be too many: the end may be at an edge of the contact."""
TRIES = 3
"""Times that the way up and back is tried. A shaft that trembles on an edge changes the contact more often."""
STUCK_CHANGES = 8
"""Changes of the contact on the way up after which a limit switch that is still open does not work."""
CHANGE_SURELY_READ_S = 0.2
"""The time after which a change of the contact has been read for certain."""


@dataclass(frozen=True, slots=True)
class HomingSettings:
    """What homing needs to know of an axis."""

    period_s: float
    """From one pulse to the next at full speed."""
    travel_s: float
    """From end to end."""
    coast_s: float
    """From the relay's opening until the motor stands for certain, and the contact's debounce."""
    home_deg: float
    """The angle at which the axis stands when it is homed."""
    mostly_closed: bool = False
    """The contact is closed for more of a period than it is open."""
    switch: bool = False
    """A limit switch is at the low end."""
    rest_deg: tuple[float, float] = (-math.inf, math.inf)
    """Beyond these angles a motor could turn to its stop without a change of the contact: it is not brought to rest
    there, for nothing would show that its relay has opened."""

    def begin(self, _furthest_deg: float | None) -> Homing:
        """The stop is found from anywhere."""
        return Homing(self)


class _Phase(Enum):
    DOWN = "down"
    BOTTOM = "resting at the end"
    UP = "up"
    TOP = "resting above the end"


_MOTOR = {
    _Phase.DOWN: Direction.MINUS,
    _Phase.BOTTOM: Direction.OFF,
    _Phase.UP: Direction.PLUS,
    _Phase.TOP: Direction.OFF,
}


class Homing:
    """One axis. Call `step` every cycle for the direction to drive, until it has `homed` or there is a `failure`."""

    def __init__(self, settings: HomingSettings) -> None:
        self.home_deg = settings.home_deg
        self.homed = False
        self.failure = ""
        """Why homing has given up; empty: homing continues."""
        self._settings = settings
        self._quiet_after_s = QUIET_PERIODS * settings.period_s
        self._longest_s = 1.5 * settings.travel_s + 2.0 * self._quiet_after_s
        self._phase = _Phase.DOWN
        self._since_s: float | None = None
        """Since when it has been in this phase; None: before the first step."""
        self._still_s = 0.0
        """Since when neither the contact nor the relays have changed."""
        self._driven = Direction.OFF
        self._driven_once = False
        self._changes = 0
        self._base = 0
        """The changes of the contact at the latest rest."""
        self._up: int | None = None
        """How many changes came on the way up; None: before the first way up."""
        self._tries = 0

    @property
    def begun(self) -> bool:
        """The motor has been driven for it."""
        return self._driven_once

    def step(self, now_s: float, driven: Direction, condition: Condition) -> Direction:
        """The direction to drive now. `driven`: what the relays really do, for a reversal takes its dead time."""
        changes = condition.changes
        if self._since_s is None:
            self._since_s, self._still_s, self._changes = now_s, now_s, changes
        if driven is not self._driven or changes != self._changes:
            self._driven, self._changes, self._still_s = driven, changes, now_s
        self._driven_once = self._driven_once or driven is not Direction.OFF
        if self.homed or self.failure:
            return Direction.OFF
        if now_s - self._since_s > self._longest_s:
            return self._fail("its motor ran for longer than the whole travel takes, and pulses still come")
        still_s = now_s - self._still_s
        quiet = driven is _MOTOR[self._phase] and still_s > self._quiet_after_s
        stands = driven is Direction.OFF and still_s >= self._settings.coast_s + CHANGE_SURELY_READ_S
        at_switch = Direction.MINUS in condition.ends
        match self._phase:
            case _Phase.DOWN if at_switch or (quiet and not self._settings.switch):
                self._enter(_Phase.BOTTOM, now_s)
            case _Phase.DOWN if quiet:
                return self._fail("it stands at its stop, and the low limit switch has not opened: look at the switch")
            case _Phase.BOTTOM if stands:
                self._judge(now_s, changes)
            case _Phase.UP if quiet:
                return self._fail("no pulse came in either direction: look at the contact, its wires and the motor")
            case _Phase.UP if at_switch and changes - self._base >= STUCK_CHANGES:
                return self._fail("the low limit switch stays open: look at its wires")
            case _Phase.UP if self._well_above(condition, at_switch=at_switch):
                self._enter(_Phase.TOP, now_s)
            case _Phase.TOP if stands:
                self._up, self._base = changes - self._base, changes
                self._enter(_Phase.DOWN, now_s)
        return Direction.OFF if self.homed or self.failure else _MOTOR[self._phase]

    def _well_above(self, condition: Condition, *, at_switch: bool) -> bool:
        """Pulses have come, and the contact has just entered the wider part of its period: away from its edges."""
        proved = condition.changes - self._base >= PROOF_CHANGES
        return proved and not at_switch and condition.closed is self._settings.mostly_closed

    def _judge(self, now_s: float, changes: int) -> None:
        """The axis stands at an end: at home, where as many changes came on the way back as on the way up."""
        back = changes - self._base
        if self._up is not None and abs(back - self._up) <= ALIKE_CHANGES:
            self.homed = True
        elif self._up is not None and self._tries >= TRIES:
            self._fail(
                f"its contact changed {self._up} times on the way up, {back} times on the way back, also in try {TRIES}"
            )
        else:
            self._tries += 1
            self._base = changes
            self._enter(_Phase.UP, now_s)

    def _enter(self, phase: _Phase, now_s: float) -> None:
        self._phase, self._since_s = phase, now_s

    def _fail(self, why: str) -> Direction:
        self.failure = why
        return Direction.OFF
