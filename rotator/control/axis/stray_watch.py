"""Whether a positioned axis follows: it stands where it was sent, or it comes nearer.

Knows where the drive was sent and where the axis is. A modelled angle always agrees with its model.
"""

from __future__ import annotations

import math

from hw.ports import Axis
from rotator.control.commands import Steer
from rotator.faults import Fault, FaultKind

STRAY_DEG = 5.0
STRAY_S = 3.0
"""An axis this far from where it was sent, and not coming nearer for so long, does not follow. One that has to turn
back first, at 20°/s² from 30°/s, takes half of that time."""
COMING_DEG = 0.5
"""An axis that has moved this far towards its place is coming nearer."""


class StrayWatch:
    def __init__(self, axis: Axis) -> None:
        self._axis = axis
        self._coming: tuple[float, float] | None = None
        """Where the axis was when it was last seen to come nearer, and when."""

    def clear(self) -> None:
        """It is not sent anywhere, or a person has acknowledged the fault."""
        self._coming = None

    def see(self, now_s: float, steered: Steer | None, angle_deg: float | None, *, settling: bool) -> Fault | None:
        """`settling`: the axis does not follow yet, for a reason that passes by itself."""
        if steered is None or angle_deg is None:
            return None
        ahead_deg = steered.angle_deg - angle_deg
        near = abs(ahead_deg) < STRAY_DEG or settling
        if near or self._coming is None or (angle_deg - self._coming[0]) * math.copysign(1, ahead_deg) >= COMING_DEG:
            self._coming = (angle_deg, now_s)
            return None
        if now_s - self._coming[1] < STRAY_S:
            return None
        measured = f"stands at {angle_deg:.1f}°, {abs(ahead_deg):.1f}° from where it was told to be"
        return Fault(FaultKind.NOT_FOLLOWING, self._axis, measured, f"{STRAY_DEG:g}° for {STRAY_S:g} s")
