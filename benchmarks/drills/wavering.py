"""A target that wavers across the end of the azimuth range, or moves across it: the antenna may wait at that end.

Knows the rule of docs/pointing.md: the first swing right round begins at once, each further one within two minutes
waits, up to 96 s, for a target that stays. A target that moves is followed on the turn on which it began; once its
path is certain to leave the range, also by half a turn over the zenith, the antenna may unwind ahead of it. Knows only
the directions that were ordered.
"""

from __future__ import annotations

from rotator.control.sky.angles import great_circle_deg

WAVERS_DEG = 90.0
"""An order this far from the order before, or further, is another target."""
REMEMBERS_S = 120.0 + 96.0
"""Within this time after a target last needed a swing, the next swing may have to wait."""
STREAM_ORDERS, STREAM_GAP_S, STREAM_STEP_DEG, SKY_STEP_DEG = 4, 5.0, 10.0, 4.0
"""This many orders for different directions are a moving target, if each two are within this time, and within this
azimuth or this angle on the sky: near the zenith a short way on the sky is a long one in azimuth."""

ZENITH_DEG, HALF_TURN_DEG, NEAR_ZENITH_DEG = 90.0, 180.0, 4.0
CERTAIN_S, AHEAD_S = 45.0, 900.0
"""After `CERTAIN_S` the path of a moving target is certain; the box then predicts it up to `AHEAD_S` ahead."""
SWING_S = 120.0
"""No swing takes longer. So a target must come to the zenith within this time if the antenna swings ahead of it."""


class Wavering:
    """Give it every order for a direction (`ends`), in order of time. The range of azimuth is in true degrees."""

    def __init__(self, low_deg: float, high_deg: float) -> None:
        self._low_deg, self._high_deg = low_deg, high_deg
        self._before_deg: tuple[float, ...] = ()
        """The azimuth angles at which the order before could be met, also beyond the range."""
        self._swung_s = float("-inf")
        self._stream: list[tuple[float, float, float]] = []
        """The latest orders that may belong to one moving target: moment, azimuth on the nearest turn, elevation."""

    def forget(self) -> None:
        """No order is in force any more. The earlier swings still count."""
        self._before_deg = ()
        self._stream.clear()

    def ends(self, now_s: float, turns_deg: list[float], elevation_deg: float) -> tuple[float, ...]:
        """The ends of the range at which the antenna may wait for the target. `turns_deg`: all azimuth angles that
        point at it, on every turn, also beyond the range. At the zenith each azimuth does, and the antenna may stay."""
        overhead = abs(elevation_deg - ZENITH_DEG) < NEAR_ZENITH_DEG
        moves = self._moves(now_s, turns_deg, elevation_deg)
        most_deg = HALF_TURN_DEG if moves else WAVERS_DEG
        near_deg = [
            angle_deg
            for angle_deg in turns_deg
            if any(abs(angle_deg - other_deg) <= most_deg for other_deg in self._before_deg)
        ]
        beyond_deg = [angle_deg for angle_deg in near_deg if not self._low_deg <= angle_deg <= self._high_deg]
        within_deg = [angle_deg for angle_deg in turns_deg if self._low_deg <= angle_deg <= self._high_deg]
        may_wait = bool(beyond_deg) and (moves or now_s - self._swung_s <= REMEMBERS_S)
        # Where two turns point at the target, the antenna may have swung to the further one.
        if beyond_deg or (near_deg and set(within_deg) - set(near_deg)):
            self._swung_s = now_s
        stays_deg = self._before_deg if overhead else ()
        self._before_deg = (*within_deg, *(beyond_deg if may_wait else ()), *stays_deg)
        waits_deg = {min(max(angle_deg, self._low_deg), self._high_deg) for angle_deg in beyond_deg if may_wait}
        return tuple(waits_deg | self._unwinds())

    def _moves(self, now_s: float, turns_deg: list[float], elevation_deg: float) -> bool:
        """Whether this order belongs to a target that moves."""
        if not self._stream:
            within_deg = (angle_deg for angle_deg in turns_deg if self._low_deg <= angle_deg <= self._high_deg)
            near_deg = next(within_deg, turns_deg[0])
        else:
            before_s, before_deg, raised_deg = self._stream[-1]
            near_deg = min(turns_deg, key=lambda angle_deg: abs(angle_deg - before_deg))
            apart_deg = great_circle_deg(before_deg, raised_deg, near_deg, elevation_deg)
            elsewhere = abs(near_deg - before_deg) > STREAM_STEP_DEG and apart_deg > SKY_STEP_DEG
            if now_s - before_s > STREAM_GAP_S or elsewhere:
                self._stream.clear()
        self._stream.append((now_s, near_deg, elevation_deg))
        return len(self._stream) >= STREAM_ORDERS and any(angle_deg != near_deg for _, angle_deg, _ in self._stream)

    def _unwinds(self) -> set[float]:
        """The end of the range to which the antenna may unwind, because a moving target will certainly come there."""
        (began_s, began_deg, low_deg), (now_s, here_deg, raised_deg) = self._stream[0], self._stream[-1]
        if now_s - began_s < CERTAIN_S:
            return set()
        there_deg = here_deg + AHEAD_S * (here_deg - began_deg) / (now_s - began_s)
        soon_deg = raised_deg + SWING_S * (raised_deg - low_deg) / (now_s - began_s)
        climbs = low_deg < raised_deg <= ZENITH_DEG < soon_deg + NEAR_ZENITH_DEG
        # Beyond the zenith the target's azimuth is half a turn further, in either direction.
        turned_deg = HALF_TURN_DEG if climbs else 0.0
        ends = {self._low_deg} if there_deg + turned_deg > self._high_deg else set()
        return ends | {self._high_deg} if there_deg - turned_deg < self._low_deg else ends
