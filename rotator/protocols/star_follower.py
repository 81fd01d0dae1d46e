"""Follows a star: the antenna goes to it, and with it, until a stop, another order, or its setting.

Knows when another program or a person has taken the antenna: the target in the status is then no longer the one
ordered here. Does not know bytes: the sessions of the telescope protocols do.
"""

from __future__ import annotations

from collections.abc import Callable

from rotator.exchange.orders import Aim
from rotator.exchange.sources import Refusal
from rotator.orbits.celestial import Sky, Star
from rotator.protocols.session import Box

EVERY_S = 1.0
"""The time between two orders while a star is followed. In a second it moves 0.004°."""
LATE_BEATS = 3
"""The control loop may be late with an order. After so many beats without it the antenna is another's."""
BELOW = "Object Below Horizon"
_SAME_DEG = 1e-6


class StarFollower:
    """`remark` takes a line for the log: why the antenna no longer follows."""

    def __init__(self, box: Box, sky: Sky, remark: Callable[[str], None]) -> None:
        self._box = box
        self._sky = sky
        self._remark = remark
        self._star: Star | None = None
        self._ordered = (0.0, 0.0)
        self._late = 0

    def go(self, star: Star) -> Refusal | None:
        """Go to a star and follow it. A Refusal: it is below the horizon, or the box refuses the order."""
        self._star = None
        direction = self._sky.direction(star)
        if direction[1] < 0:
            self._remark("a target below the horizon is not obeyed")
            return Refusal(BELOW)
        refused = self._box.order(Aim(*direction))
        if refused is None:
            self._star, self._ordered, self._late = star, direction, 0
        return refused

    def end(self) -> None:
        """Follow nothing: another order or a stop has come."""
        self._star = None

    @property
    def follows(self) -> Star | None:
        """The star that is followed now."""
        return self._star

    def beat(self) -> None:
        """Order the star's direction anew. The session calls this every second or so."""
        if self._star is None:
            return
        if not self._is_in_force():
            self._late += 1
            if self._late >= LATE_BEATS:
                self._star = None
                self._remark("no longer follows its star: a stop or another order has come")
            return
        direction = self._sky.direction(self._star)
        if direction[1] < 0:
            self._star = None
            self._remark("no longer follows its star: it has set")
            return
        self._late = 0
        refused = self._box.order(Aim(*direction))
        if refused is None:
            self._ordered = direction
        elif not refused.faulty:  # a fault may pass
            self._star = None

    def _is_in_force(self) -> bool:
        status = self._box.status()
        wanted = (status.wanted_azimuth_deg, status.wanted_elevation_deg)
        return all(
            angle_deg is not None and abs(angle_deg - ordered_deg) < _SAME_DEG
            for angle_deg, ordered_deg in zip(wanted, self._ordered, strict=True)
        )
