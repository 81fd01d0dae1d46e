"""The brake of one motor, as a moment: released before the motor starts, engaged when the antenna has come to rest.

Knows when its line was switched, and when its motor was last switched off or seen to turn. Knows no output line, no
other motor and no clock: the bank of relays switches the line, and tells it each change.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.drives.motor_supply import NEVER_S
from hw.ports import Axis

BRAKES: dict[Axis, str] = {Axis.AZIMUTH: "azimuth_brake", Axis.ELEVATION: "elevation_brake"}
"""The lines; on: the brake is released."""
NEVER_READY_S = float("inf")


@dataclass(frozen=True, slots=True)
class BrakeTimes:
    release_s: float
    """The solenoid has surely drawn the brake so long after its line was switched on."""
    rest_s: float
    """The antenna has surely come to rest so long after its motor was switched off, unless it is seen to turn."""
    engage_s: float
    """The brake engages so long after that."""

    @property
    def held_off_s(self) -> float:
        """So long after a run the brake is still off."""
        return self.rest_s + self.engage_s


@dataclass(slots=True)
class Brake:
    times: BrakeTimes
    released_s: float | None = None
    """Since when its line is on; None: it is off, and the brake holds."""
    due_s: float = NEVER_S
    """When it is to engage, unless the motor runs then."""

    @property
    def released(self) -> bool:
        return self.released_s is not None

    def ready(self, now_s: float) -> bool:
        """Whether the motor may start."""
        return self.released_s is not None and now_s >= self.released_s + self.times.release_s

    def keep_off(self, now_s: float) -> None:
        """A run is wanted, or the antenna is seen to turn."""
        self.due_s = max(self.due_s, now_s + self.times.engage_s)

    def note_stop(self, now_s: float) -> None:
        """The motor has been switched off."""
        self.due_s = max(self.due_s, now_s + self.times.held_off_s)
