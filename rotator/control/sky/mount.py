"""Turns a direction in the sky into axis angles: the only place that does.

Knows the range of each axis, its overlap, whether the antenna may go over the top, how the mount really stands, the
horizon of trees and roofs, and the park position. Knows nothing of motors, sensors or time.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Collection
from dataclasses import dataclass, replace

from hw.ports import Axis
from rotator.control.refused import Refused
from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, direction, great_circle_deg, turn_deg
from rotator.control.sky.pointing_model import PERFECT, PointingModel

_EITHER_WAY_DEG = 1.0
"""A target that passes the zenith turns in azimuth by half a turn. As orders come in whole degrees, a turn that differs
from half a turn by less than this may go either way."""
LEAST_WEIGHT = 0.1
"""Near the zenith azimuth hardly matters. But an azimuth that a person orders there must still turn the antenna."""
_ROUNDS = 2
"""After this many rounds the azimuth for an elevation at its limit is right to 0.1°, with terms of up to 5°."""


def counted_target(
    fitted: Collection[Axis], antenna: tuple[float, float], target: tuple[float, float]
) -> tuple[float, float]:
    """The direction from which an error is counted. An axis that is not fitted misses no target: there the antenna's
    own angle counts, and with azimuth alone both are compared at the horizon."""
    if Axis.ELEVATION not in fitted:
        return target[0], antenna[1]
    return target if Axis.AZIMUTH in fitted else (antenna[0], target[1])


class Unreachable(Refused):
    """The axes cannot point there. The text gives the reason."""


@dataclass(frozen=True, slots=True)
class Range:
    """Where an axis may be, in degrees on its own scale."""

    min_deg: float
    max_deg: float

    def nearest(self, angle_deg: float) -> float:
        if angle_deg > self.max_deg:
            return self.max_deg
        return angle_deg if angle_deg > self.min_deg else self.min_deg

    def holds(self, angle_deg: float) -> bool:
        return self.min_deg <= angle_deg <= self.max_deg

    def meets(self, other: Range) -> bool:
        """Whether the two have more than an end in common."""
        return self.min_deg < other.max_deg and other.min_deg < self.max_deg

    def spanning(self, angle_deg: float) -> Range:
        """The same, stretched to hold this angle."""
        return Range(min(self.min_deg, angle_deg), max(self.max_deg, angle_deg))

    def moved(self, by_deg: float) -> Range:
        return Range(self.min_deg + by_deg, self.max_deg + by_deg)

    def widened(self, by_deg: float) -> Range:
        return Range(self.min_deg - by_deg, self.max_deg + by_deg)

    @property
    def middle_deg(self) -> float:
        return (self.min_deg + self.max_deg) / 2

    @property
    def endless(self) -> bool:
        return self == ENDLESS

    @property
    def shown(self) -> Range:
        """The same for people and programs: one turn, where it has no ends."""
        return ONE_TURN if self.endless else self


ENDLESS = Range(-3.6e9, 3.6e9)
"""An axis without ends. Nothing turns for ten million turns, and a degree still has six digits there."""
ONE_TURN = Range(0.0, FULL_TURN_DEG)


@dataclass(frozen=True, slots=True)
class Sector:
    """Where the antenna would touch something: a chimney, a guy wire, the tower."""

    name: str
    azimuth: Range
    elevation: Range
    margin_deg: float
    """What is kept free around it, on each side."""


@dataclass(frozen=True, slots=True)
class Mount:
    azimuth: Range
    elevation: Range
    park_azimuth_deg: float = 0.0
    park_elevation_deg: float = 0.0
    flip: bool = False
    """The antenna may go over the top: the file says that nothing is in its way there."""
    horizon: tuple[tuple[float, float], ...] = ()
    """Points (azimuth, least elevation), azimuth rising from 0 to below 360: trees, the neighbour's roof."""
    sectors: tuple[Sector, ...] = ()
    """Where the antenna must not be, nor pass, on the axes' own scales."""
    model: PointingModel = PERFECT
    """How the mount really stands. Ranges, the park position and sectors are on the axes' own scales; the horizon is
    on the sky."""
    fitted: tuple[Axis, ...] = tuple(Axis)
    """The axes that the rotor has. One that it has not stands at the one angle of its range, and misses no target."""

    def axis_angles(
        self, azimuth_deg: float, elevation_deg: float | None, near_azimuth_deg: float, *, over: bool = False
    ) -> tuple[float, float | None]:
        """Axis angles for an order, on the turn of azimuth nearest to `near_azimuth_deg`. Raises Unreachable.

        For a target below the horizon azimuth follows and elevation rests at its minimum. An elevation above 90° is the
        angle of the axis itself, if the axis has that angle; else the order is turned into the same direction below
        90°. Where azimuth does not reach a direction, the antenna goes over the top, if it may. `over`: it goes over
        the top for any direction.
        """
        if azimuth_deg > 360.0 and self.azimuth.shown.holds(azimuth_deg):  # the sender names the overlap
            near_azimuth_deg = azimuth_deg
        if elevation_deg is None:
            level_deg, _ = self._angles(azimuth_deg, 0.0)
            return self._turn(level_deg, near_azimuth_deg), None
        if elevation_deg > ZENITH_DEG and not self.elevation.holds(elevation_deg):
            azimuth_deg, elevation_deg = direction(azimuth_deg, elevation_deg)
        axis_azimuth_deg, axis_elevation_deg = self._angles(azimuth_deg, elevation_deg)
        if over or (self.flip and not self._turns(axis_azimuth_deg)):
            there = self._angles(azimuth_deg + 180.0, 180.0 - elevation_deg)
            if over or self._turns(there[0]):
                axis_azimuth_deg, axis_elevation_deg = there
        axis_azimuth_deg = self._turn(axis_azimuth_deg, near_azimuth_deg)
        return axis_azimuth_deg, self.clear_deg(axis_azimuth_deg, axis_elevation_deg)

    def parked(self) -> tuple[float, float]:
        """The park position, a place on the axes' own scales. Raises Unreachable."""
        # Not the other turn of the overlap, which would wind the cables.
        azimuth_deg = self._turn(self.park_azimuth_deg, self.park_azimuth_deg)
        elevation_deg = self.clear_deg(azimuth_deg, self.park_elevation_deg)
        if not self.elevation.holds(self.park_elevation_deg):
            limits = f"{self.elevation.min_deg:g} to {self.elevation.max_deg:g}"
            raise Unreachable(f"elevation {self.park_elevation_deg:g} is outside the rotor's range of {limits} degrees")
        if self.inside_deg(azimuth_deg, elevation_deg) > 0:
            raise Unreachable("it lies in a forbidden sector")
        return azimuth_deg, elevation_deg

    def pointed(self, axis_azimuth_deg: float, axis_elevation_deg: float) -> tuple[float, float]:
        """Where the antenna points at these axis angles, as an order would name it: on the same turn, and above 90°
        where it is over the top."""
        return self.model.pointed(axis_azimuth_deg, axis_elevation_deg)

    def on_the_way(
        self, azimuth_deg: float, elevation_deg: float, from_azimuth_deg: float, *, flipped: bool
    ) -> tuple[float, float]:
        """Axis angles for a direction, the short way from this azimuth. They may be beyond the limits, as a way may be.
        Half a turn is as short on both sides: then the side within the range is taken."""
        if flipped:
            azimuth_deg, elevation_deg = azimuth_deg + 180.0, 180.0 - elevation_deg
        azimuth_deg, elevation_deg = self._angles(azimuth_deg, elevation_deg)
        turned_deg = turn_deg(from_azimuth_deg, azimuth_deg)
        there_deg = from_azimuth_deg + turned_deg
        if abs(turned_deg) >= 180.0 - _EITHER_WAY_DEG:
            other_deg = there_deg - math.copysign(360.0, turned_deg)
            if self.azimuth.holds(other_deg) and not self.azimuth.holds(there_deg):
                there_deg = other_deg
        return there_deg, elevation_deg

    def places(self, azimuth_deg: float, elevation_deg: float) -> list[tuple[float, float, bool]]:
        """Every place at which the axes point in that direction, and whether it is over the top. Of an azimuth without
        ends one place each."""
        ways = [(*self._angles(azimuth_deg, elevation_deg), False)]
        if self.flip and elevation_deg <= ZENITH_DEG:
            ways.append((*self._angles(azimuth_deg + 180.0, 180.0 - elevation_deg), True))
        return [
            (turn_deg, self.clear_deg(turn_deg, axis_elevation_deg), over)
            for way_deg, axis_elevation_deg, over in ways
            for turn_deg in self._turns(way_deg)
        ]

    def azimuth_weight(self, elevation_deg: float) -> float:
        """How far on the sky one degree of azimuth moves the antenna, at least LEAST_WEIGHT, with a target so high.

        An antenna that is not raised to its target turns to the side of it where it is seen: there a degree is one.
        """
        if Axis.ELEVATION not in self.fitted:
            return 1.0
        return max(LEAST_WEIGHT, abs(math.cos(math.radians(elevation_deg))))

    def off_deg(self, antenna: tuple[float, float], target: tuple[float, float]) -> float:
        """How far off its target the antenna points, on the sky; with one axis alone, on that axis."""
        return great_circle_deg(*antenna, *counted_target(self.fitted, antenna, target))

    def near_deg(self, azimuth_deg: float, near_azimuth_deg: float) -> float:
        """On an axis without ends: the same direction on the turn nearest to another angle; else as it is."""
        if not self.azimuth.endless:
            return azimuth_deg
        return azimuth_deg + FULL_TURN_DEG * round((near_azimuth_deg - azimuth_deg) / FULL_TURN_DEG)

    def about(self, azimuth_deg: float) -> Mount:
        """An axis without ends meets each sector again in each turn: the mount with ends a turn and more away from this
        angle, and with the sectors up to there. Any other mount as it is."""
        if not self.azimuth.endless:
            return self
        first_deg = FULL_TURN_DEG * (azimuth_deg // FULL_TURN_DEG - 1)
        turns_deg = [first_deg + FULL_TURN_DEG * turn for turn in range(3)]
        sectors = [replace(each, azimuth=each.azimuth.moved(by_deg)) for by_deg in turns_deg for each in self.sectors]
        return replace(self, azimuth=Range(first_deg, first_deg + 3 * FULL_TURN_DEG), sectors=tuple(sectors))

    def inside_deg(self, axis_azimuth_deg: float, axis_elevation_deg: float) -> float:
        """How far inside a sector, or its margin, this place is; 0 where it is free."""
        if self.azimuth.endless:
            return self.about(axis_azimuth_deg).inside_deg(axis_azimuth_deg, axis_elevation_deg)
        depths_deg = (
            sector.margin_deg
            + min(
                axis_azimuth_deg - sector.azimuth.min_deg,
                sector.azimuth.max_deg - axis_azimuth_deg,
                axis_elevation_deg - sector.elevation.min_deg,
                sector.elevation.max_deg - axis_elevation_deg,
            )
            for sector in self.sectors
        )
        return max((0.0, *depths_deg))

    def clear_deg(self, axis_azimuth_deg: float, elevation_deg: float) -> float:
        """The elevation nearest to the one asked for that is within limits and above the horizon there."""
        elevation_deg = self.elevation.nearest(elevation_deg)
        if not self.horizon:
            return elevation_deg
        sky_azimuth_deg, sky_elevation_deg = self.pointed(axis_azimuth_deg, elevation_deg)
        if sky_elevation_deg > ZENITH_DEG:
            highest_deg = 180.0 - self.horizon_deg(sky_azimuth_deg + 180.0)
            return self.elevation.nearest(elevation_deg + min(0.0, highest_deg - sky_elevation_deg))
        least_deg = self.horizon_deg(sky_azimuth_deg)
        return self.elevation.nearest(elevation_deg + max(0.0, least_deg - sky_elevation_deg))

    def _angles(self, azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
        """Axis angles at which the antenna points there, as the mount really stands. They may be beyond the limits.

        Where elevation stops at its limit, azimuth points at the target with elevation at that limit.
        """
        if self.model.perfect:
            return azimuth_deg, elevation_deg
        axis_azimuth_deg, axis_elevation_deg = self.model.axis_angles(azimuth_deg, elevation_deg)
        rests_deg = self.elevation.nearest(axis_elevation_deg)
        over = elevation_deg > ZENITH_DEG
        if rests_deg == axis_elevation_deg or self.model.over_the_top(rests_deg) is not over:
            return axis_azimuth_deg, axis_elevation_deg
        follows_deg = axis_azimuth_deg
        for _ in range(_ROUNDS):
            _, low_deg = self.pointed(follows_deg, rests_deg)
            follows_deg, _ = self.model.axis_angles(azimuth_deg, low_deg)
        return follows_deg, axis_elevation_deg

    def horizon_deg(self, azimuth_deg: float) -> float:
        """How high trees and roofs stand there: straight lines between the points, all the way round."""
        if not self.horizon:
            return 0.0
        azimuth_deg %= 360.0
        last = self.horizon[-1]
        around = ((last[0] - 360.0, last[1]), *self.horizon, (self.horizon[0][0] + 360.0, self.horizon[0][1]))
        at = bisect_right(around, azimuth_deg, key=lambda point: point[0])
        (az_a, el_a), (az_b, el_b) = around[at - 1], around[at]
        return el_a + (azimuth_deg - az_a) / (az_b - az_a) * (el_b - el_a)

    def _turn(self, azimuth_deg: float, near_deg: float) -> float:
        """The place on the scale that is nearest. Raises Unreachable."""
        turns = [self.near_deg(each, near_deg) for each in self._turns(azimuth_deg)]
        if not turns:
            limits = f"{self.azimuth.min_deg:g} to {self.azimuth.max_deg:g}"
            raise Unreachable(f"azimuth {azimuth_deg:g} is outside the rotor's range of {limits} degrees")
        return min(turns, key=lambda turn_deg: abs(turn_deg - near_deg))

    def _turns(self, azimuth_deg: float) -> list[float]:
        """Every place on the scale that points there; the only one where azimuth is not fitted, one of them where it
        has no ends."""
        if Axis.AZIMUTH not in self.fitted:
            return [self.azimuth.min_deg]
        if self.azimuth.endless:
            return [azimuth_deg % FULL_TURN_DEG]
        first = math.ceil((self.azimuth.min_deg - azimuth_deg) / 360.0)
        last = math.floor((self.azimuth.max_deg - azimuth_deg) / 360.0)
        return [azimuth_deg + 360.0 * turn for turn in range(first, last + 1)]
