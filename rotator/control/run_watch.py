"""How long a motor may run in one go, where nothing else can be seen of it: an axis that counts.

Knows what the relays do and how long the travel takes. A count cannot run the wrong way, nor without the relays: who
counts takes the direction from them. That no pulse comes, the counter sees.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.motion import Motor
from rotator.control.mount import Range
from rotator.status import Fault

TRAVEL_SHARE, TRAVEL_MORE_S = 1.3, 5.0
"""How much longer than from end to end a motor may run in one go."""

WAYS = {
    (Axis.AZIMUTH, Direction.PLUS): "clockwise",
    (Axis.AZIMUTH, Direction.MINUS): "counter-clockwise",
    (Axis.ELEVATION, Direction.PLUS): "up",
    (Axis.ELEVATION, Direction.MINUS): "down",
}


def endless(axis: Axis, direction: Direction, run_s: float, limits: Range, speed_dps: float) -> Fault | None:
    """The fault of having run that way for so long."""
    longest_s = TRAVEL_SHARE * (limits.max_deg - limits.min_deg) / speed_dps + TRAVEL_MORE_S
    if run_s <= longest_s:
        return None
    measured = f"{run_s:.0f} s {WAYS[axis, direction]} in one go"
    return Fault("motor on longer than the travel takes", axis, measured, f"{longest_s:.0f} s")


class RunWatch:
    """One axis, as `safety.MotionWatch` sees one: tell it every reading and every change of the relays."""

    notices: tuple[str, ...] = ()

    def __init__(self, axis: Axis, limits: Range, motors: Mapping[Direction, Motor]) -> None:
        self._axis = axis
        self._limits = limits
        self._motors = motors
        self._direction = Direction.OFF
        self._since_s = 0.0

    def driven(self, now_s: float, direction: Direction) -> None:
        if direction is not self._direction:
            self._direction, self._since_s = direction, now_s

    def see(self, at_s: float, _angle_deg: float) -> Fault | None:
        if self._direction is Direction.OFF:
            return None
        speed_dps = self._motors[self._direction].speed_dps
        return endless(self._axis, self._direction, at_s - self._since_s, self._limits, speed_dps)

    def forbids(self, _direction: Direction) -> bool:
        """Nothing here sees whether a contact has let go; the dead time is longer than the coast."""
        return False

    def accuse(self, _direction: Direction) -> Fault | None:
        return None

    def acknowledge(self) -> None:
        pass
