"""Whether a positioned axis follows: it stands where it was sent, or it comes nearer.

Knows where the drive was sent and where the axis is. A modelled angle always agrees with its model. What was seen lasts
while the drive holds in between, and until the axis comes nearer.
"""

from __future__ import annotations

import math

from hw.ports import Axis
from rotator.control.commands import Steer
from rotator.faults import Fault, FaultKind

STRAY_DEG = 5.0
STRAY_S = 1.7
"""An axis this far from where it was sent, and not coming nearer for so long, does not follow."""
TURNED_BACK_S = 0.4
"""An axis that has to turn back first is seen to come nearer so long after it stood: a moteus at 20°/s² from 30°/s
takes 1.5 s and this."""
COMING_DEG, COMING_NOISES = 0.5, 6.0
"""An axis that has moved further than both towards its place is coming nearer."""
SLOW_SHARE = 0.25
"""A motor at this share of its speed still comes nearer in time; a target faster than that leaves it behind soon."""


class StrayWatch:
    """`speed_dps`: of the motor; `accel_dps2`: how hard it brakes, None: it stops at once."""

    def __init__(self, axis: Axis, speed_dps: float, accel_dps2: float | None = None) -> None:
        self._axis = axis
        self._speed_dps = speed_dps
        self._stray_s = max(STRAY_S, speed_dps / accel_dps2 + TURNED_BACK_S) if accel_dps2 else STRAY_S
        self._coming_deg: float | None = None
        """Where the axis was when it was last seen to come nearer, or how far it has gone astray since."""
        self._strayed_s = 0.0
        """For how long it was sent since then."""
        self._sent_s: float | None = None
        """The moment of the last look at it while it was sent somewhere."""

    def clear(self) -> None:
        """The fault is acknowledged."""
        self._coming_deg = self._sent_s = None
        self._strayed_s = 0.0

    def see(
        self, now_s: float, steered: Steer | None, angle_deg: float | None, noise_deg: float = 0.0, *, settling: bool
    ) -> Fault | None:
        """`noise_deg`: the scatter of the readings. `settling`: the axis does not follow yet, for a reason that passes
        by itself.
        """
        if steered is None or angle_deg is None:
            self._sent_s = None
            return None
        passed_s, self._sent_s = now_s - (now_s if self._sent_s is None else self._sent_s), now_s
        ahead_deg = steered.angle_deg - angle_deg
        near = abs(ahead_deg) < STRAY_DEG
        runs_on = abs(steered.rate_dps) > SLOW_SHARE * self._speed_dps
        towards = steered.rate_dps if near and runs_on else ahead_deg
        nearer_deg = 0.0 if self._coming_deg is None else (angle_deg - self._coming_deg) * math.copysign(1.0, towards)
        coming_deg = max(COMING_DEG, COMING_NOISES * noise_deg)
        if (near and not runs_on) or settling or self._coming_deg is None or nearer_deg >= coming_deg:
            self._coming_deg, self._strayed_s = angle_deg, 0.0
            return None
        if nearer_deg < 0.0:
            self._coming_deg = angle_deg
        self._strayed_s += passed_s
        patience_s = max(self._stray_s, coming_deg / (SLOW_SHARE * self._speed_dps))
        if near or self._strayed_s < patience_s:
            return None
        measured = f"it is at {angle_deg:.1f}°, {abs(ahead_deg):.1f}° from where it should be"
        return Fault(FaultKind.NOT_FOLLOWING, self._axis, measured, f"{STRAY_DEG:g}° for {patience_s:.2g} s")
