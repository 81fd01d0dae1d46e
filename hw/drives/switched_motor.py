"""One motor and its two relays, as they were last switched: what is on, until when, and when it was last switched off.

Knows that a reversal waits for the dead time. Knows no output line, no other motor and no clock: the bank of relays
tells it each change.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.drives.motor_supply import NEVER_S
from hw.ports import Direction


@dataclass(slots=True)
class SwitchedMotor:
    on: Direction = Direction.OFF
    """The direction of the relay that is closed; OFF: both are open."""
    until_s: float = NEVER_S
    """When its command expires."""
    last: Direction = Direction.OFF
    """The direction of the last run."""
    stopped_s: float = NEVER_S
    """When the motor was last switched off. A reversal waits for the dead time from this moment."""

    @property
    def runs(self) -> bool:
        return self.on is not Direction.OFF

    def may_turn(self, direction: Direction, now_s: float, dead_time_s: float) -> bool:
        """Whether the motor may start. A reversal at full speed breaks gears and burns contacts; the same direction may
        go on at once."""
        return self.last in (Direction.OFF, direction) or now_s >= self.stopped_s + dead_time_s

    def note_start(self, direction: Direction) -> None:
        self.on = self.last = direction

    def note_stop(self, now_s: float) -> None:
        if self.runs:
            self.on, self.stopped_s = Direction.OFF, now_s
