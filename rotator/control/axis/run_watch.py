"""The watch over an axis that counts: how long its motor may run in one go, and when its opposite relay may close.

Knows what the relays do, how long the travel takes, and how often the contact has changed. A count cannot run the wrong
way, for the counter takes the direction from the relays. The counter itself sees missing pulses, and pulses at rest.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.motion import Motor
from rotator.control.sky.mount import Range
from rotator.faults import Fault, FaultKind, Notice

TRAVEL_SHARE, TRAVEL_MORE_S = 1.3, 5.0
"""A motor may run this much longer in one go than the travel from end to end takes."""

CUT_BY_HAND = "CUT MOTOR POWER!"
WAYS = {
    (Axis.AZIMUTH, Direction.PLUS): "clockwise",
    (Axis.AZIMUTH, Direction.MINUS): "counter-clockwise",
    (Axis.ELEVATION, Direction.PLUS): "up",
    (Axis.ELEVATION, Direction.MINUS): "down",
}


def endless(axis: Axis, direction: Direction, run_s: float, limits: Range, speed_dps: float) -> Fault | None:
    """The fault of having run in one direction for `run_s`, where that is too long."""
    longest_s = TRAVEL_SHARE * (limits.max_deg - limits.min_deg) / speed_dps + TRAVEL_MORE_S
    if run_s <= longest_s:
        return None
    measured = f"{run_s:.0f} s {WAYS[axis, direction]} in one go"
    return Fault(FaultKind.RUN_TOO_LONG, axis, measured, f"{longest_s:.0f} s")


def unstoppable(kind: FaultKind, axis: Axis, measured: str, limit: str, *, master: bool) -> Fault:
    """A fault that no relay of this axis ends: only the supply does. `master`: an output switches the supply."""
    if master:
        return Fault(kind, axis, f"{measured}; the master is opened", limit, cut=True)
    measured += "; no master is wired, so switch the motors' supply off by hand NOW"
    return Fault(kind, axis, measured, limit, cut=True, act_now=CUT_BY_HAND)


class RunWatch:
    """One axis, in the shape of `MotionWatch`: give it every reading and every change of the relays, in order of time.

    `quiet_s`: the axis stands when its contact has not changed for so long after its relay opened.
    """

    notices: tuple[Notice, ...] = ()
    noise_deg = 0.0
    """A count does not scatter."""

    def __init__(self, axis: Axis, limits: Range, motors: Mapping[Direction, Motor], quiet_s: float) -> None:
        self._axis = axis
        self._limits = limits
        self._motors = motors
        self._quiet_s = quiet_s
        self._direction = Direction.OFF
        self._last = Direction.OFF
        self._since_s = 0.0
        self._changes = 0
        self._changed_s = self._seen_s = -math.inf

    def driven(self, now_s: float, direction: Direction) -> None:
        if direction is self._direction:
            return
        if self._direction is not Direction.OFF:
            self._last = self._direction
        self._direction, self._since_s = direction, now_s

    def see(self, at_s: float, _angle_deg: float, changes: int = 0) -> Fault | None:
        """A reading, and how often the contact has changed."""
        if changes != self._changes:
            self._changes, self._changed_s = changes, at_s
        self._seen_s = at_s
        if self._direction is Direction.OFF:
            return None
        speed_dps = self._motors[self._direction].speed_dps
        return endless(self._axis, self._direction, at_s - self._since_s, self._limits, speed_dps)

    def forbids(self, direction: Direction) -> bool:
        """Whether closing that relay now might work against the opposite one, where that has not let go."""
        if self._direction is not Direction.OFF or direction is not Direction(-self._last):
            return False
        return self._seen_s - max(self._since_s, self._changed_s) < self._quiet_s

    def accuse(self, _direction: Direction) -> Fault | None:
        return None

    def acknowledge(self) -> None:
        pass
