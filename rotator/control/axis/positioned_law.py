"""The law for a drive that goes to an angle by itself: where to send it now, and how fast it is to move on.

The sibling of `switched_law`. Knows one axis: its limits, how far its drive may rest from its place, how hard it
brakes. Knows nothing of the sky, of faults, or of who gave the order.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.settings import PositionedSettings
from rotator.control.axis.stray_watch import COMING_DEG
from rotator.control.commands import Steer
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path

RATE_OVER_S = 0.25
"""The rate of the target is the mean over this time, half of it before now."""
SOON_S = 0.04
"""A motor that brakes begins to brake this much early: the next command may come too late."""
STILL_DPS = 0.05
"""A target slower than this stands still."""
ANYWHERE = Range(-math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class Sent:
    """Where the drive was sent, and when."""

    steer: Steer
    at_s: float
    jog: Direction = Direction.OFF
    """The direction of the jog that has sent it; OFF: no jog has."""

    def place_deg(self, now_s: float) -> float:
        """Where the axis should be by now."""
        return self.steer.angle_deg + self.steer.rate_dps * (now_s - self.at_s)


class PositionedLaw:
    """`braking_deg`: how far the motor goes on from its full speed. `lease_s`: how long a command lives."""

    def __init__(self, settings: PositionedSettings, braking_deg: float, lease_s: float) -> None:
        self._settings = settings
        self._braking_deg = braking_deg
        self._lease_s = lease_s

    def aim(self, target_deg: float, until_s: float) -> Steer:
        """To a target that stands still."""
        return self._within(target_deg, 0.0, until_s)

    def follow(self, now_s: float, path: Path, until_s: float) -> Steer:
        """Along with a target that moves. It brakes before a limit, so that it comes to rest there, not beyond."""
        before_deg, after_deg = path.angle_deg(now_s - RATE_OVER_S / 2), path.angle_deg(now_s + RATE_OVER_S / 2)
        steer = self._within(path.angle_deg(now_s), (after_deg - before_deg) / RATE_OVER_S, until_s)
        if not steer.rate_dps or not self._braking_deg:
            return steer
        limit_deg = self._settings.limits.max_deg if steer.rate_dps > 0 else self._settings.limits.min_deg
        brakes = abs(limit_deg - steer.angle_deg) <= self._brakes_deg(steer.rate_dps)
        return Steer(limit_deg, 0.0, until_s) if brakes else steer

    def jog(
        self,
        now_s: float,
        angle_deg: float,
        direction: Direction,
        until_s: float,
        sent: Sent | None,
        *,
        settling: bool,
        lost: bool = False,
    ) -> Steer | None:
        """On from where this jog sent it last, at its own speed, up to its limit; at first from where it is.

        `settling`: it does not follow yet. `lost`: the angle is not that of the antenna, and no limit can be known.
        None: it is at its limit, and the jog is over.
        """
        limits = ANYWHERE if lost else self._settings.limits
        limit_deg = limits.max_deg if direction > 0 else limits.min_deg
        if sent is None and (limit_deg - angle_deg) * direction <= self._settings.near_deg:
            return None
        goes_on = sent is not None and sent.jog is direction and not settling
        from_deg = sent.place_deg(now_s) if sent is not None and goes_on else angle_deg
        # Where it can just brake, it is steered to its limit again and again: `hold` would let it come to rest beyond.
        if (limit_deg - from_deg) * direction <= self._braking_deg:
            return Steer(limit_deg, 0.0, until_s)
        return self._within(from_deg, self._settings.speed_dps * direction, until_s, limits)

    def jog_to(self, end_deg: float, angle_deg: float, until_s: float) -> Steer | None:
        """To the end of a jog that may go no further. None: it is there, and the jog is over."""
        steer = self._within(end_deg, 0.0, until_s)
        return None if self._arrived(steer, angle_deg) else steer

    def towards(self, steer: Steer, angle_deg: float | None) -> Direction:
        """The direction in which it has to turn for that; OFF: it is there, or its angle is not known."""
        if angle_deg is None or self._arrived(steer, angle_deg):
            return Direction.OFF
        ahead_deg = steer.angle_deg - angle_deg
        towards = ahead_deg if abs(ahead_deg) >= self._settings.near_deg else steer.rate_dps
        return Direction.PLUS if towards > 0 else Direction.MINUS

    def blocked(self, steer: Steer, angle_deg: float, switches: Collection[Direction]) -> Direction | None:
        """The direction of this command, where its limit switch is open."""
        ahead_deg = steer.angle_deg + steer.rate_dps * self._lease_s - angle_deg
        towards = Direction.PLUS if ahead_deg > 0 else Direction.MINUS
        return towards if towards in switches and abs(ahead_deg) >= COMING_DEG else None

    def _within(self, angle_deg: float, rate_dps: float, until_s: float, limits: Range | None = None) -> Steer:
        """Not beyond the limits: there it stays, while the target moves on."""
        limits = limits or self._settings.limits
        kept_deg = limits.nearest(angle_deg)
        outward = (kept_deg == limits.max_deg and rate_dps > 0) or (kept_deg == limits.min_deg and rate_dps < 0)
        return Steer(kept_deg, 0.0 if outward or kept_deg != angle_deg else rate_dps, until_s)

    def _brakes_deg(self, rate_dps: float) -> float:
        """How far it goes on from that speed, if it begins to brake with one of the next commands."""
        share = min(1.0, abs(rate_dps) / self._settings.speed_dps)
        return share**2 * self._braking_deg + share * self._settings.speed_dps * SOON_S

    def _arrived(self, steer: Steer, angle_deg: float) -> bool:
        return abs(steer.angle_deg - angle_deg) < self._settings.near_deg and abs(steer.rate_dps) < STILL_DPS
