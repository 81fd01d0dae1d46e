"""The way of the antenna through the rest of a pass: which turn of the overlap, and whether over the top.

Knows the target's path to where it sets, the ranges and the motors' speeds. A way that leaves the range, and a change
from one way to another, cost the seconds in which the antenna points elsewhere. Knows nothing of steps, relays or
sensors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate

from hw.ports import Axis
from rotator.control.sky.mount import Mount

STEP_S = 5.0
"""The path is looked at this often; `LOOKS` times, or until the target sets."""
LOOKS = 180
LOST_DEG = 10.0
"""A second with a larger error is lost. `best_way` counts a smaller error as a part of a lost second."""
WORTH_S = 5.0
"""A change of way must save this much, so that small changes of the prediction do not turn the antenna."""
EQUAL_S = 2.0
"""Moments for the change that differ by less are equally good. The earliest is taken where the other way reaches the
target already. Else the target has not crossed the end of the range: the change waits as long as nothing is lost by it,
because the target may still turn back."""

Direction = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Way:
    """The axis azimuth that points at the target now, limits aside, and whether elevation goes past the zenith."""

    azimuth_deg: float
    flipped: bool


@dataclass(frozen=True, slots=True)
class Speeds:
    azimuth_dps: float
    elevation_dps: float
    stepped: bool = True
    """By relays, in steps; else the motors follow every path."""


def best_way(mount: Mount, directions: Sequence[Direction], present: Way, speeds: Speeds, *, may_flip: bool) -> Way:
    """The way to be on from now: the present one, or another if the best moment to change is now.

    `directions`: where the target will be, `STEP_S` apart, from now to where it sets.
    """
    here = Flown(mount, directions, present)
    best_s = here.lost_s[-1] - WORTH_S
    if best_s <= 0.0:  # no other way can lose so much less
        return present
    ways = [Way(present.azimuth_deg + turn, present.flipped) for turn in (-360.0, 360.0)]
    if may_flip and mount.flip:
        ways += [Way(present.azimuth_deg + turn, not present.flipped) for turn in (-180.0, 180.0)]
    plans = []
    for way in ways:
        there = Flown(mount, directions, way)
        plans += [(there.lost_after_change_s(here, look, speeds), look, there) for look in range(len(directions))]
    least_s = min(plan[0] for plan in plans)
    if least_s >= best_s:
        return present
    equal = [plan for plan in plans if plan[0] <= least_s + EQUAL_S]
    _, look, there = min(equal, key=lambda plan: (plan[1], plan[0]))
    can_wait = there.errors_deg[look] > 0.0 and any(later and here.lost_s[later] <= 0.0 for _, later, _ in equal)
    return present if look or can_wait else there.way


def share_lost(off_deg: float) -> float:
    """The share of each second that is lost with this error."""
    return min(1.0, off_deg / LOST_DEG) ** 2


def is_seen(mount: Mount, azimuth_deg: float, elevation_deg: float) -> bool:
    """Whether the target is above the horizon, and above trees and roofs: behind them nothing is lost."""
    return elevation_deg >= mount.horizon_deg(azimuth_deg)


class Flown:
    """A way flown to the end: where the axes are, how far they are off, and the seconds lost up to each look."""

    def __init__(self, mount: Mount, directions: Sequence[Direction], way: Way) -> None:
        self.way = way
        self.azimuths_deg: list[float] = []
        self.elevations_deg: list[float] = []
        self.errors_deg: list[float] = []
        """The error at each look; 0 while the target is not seen."""
        losses_s = [0.0]
        azimuth_deg = way.azimuth_deg
        turned, raised = (axis in mount.fitted for axis in Axis)
        for direction_deg, elevation_deg in directions:
            azimuth_deg, axis_el_deg = mount.on_the_way(direction_deg, elevation_deg, azimuth_deg, flipped=way.flipped)
            kept_az_deg, kept_el_deg = mount.azimuth.nearest(azimuth_deg), mount.elevation.nearest(axis_el_deg)
            weight = math.cos(math.radians(elevation_deg)) if raised else 1.0
            off_deg = math.hypot(
                min(abs(azimuth_deg - kept_az_deg), 90.0) * weight if turned else 0.0,
                max(0.0, abs(axis_el_deg - kept_el_deg) - max(0.0, -elevation_deg)) if raised else 0.0,
            )
            if mount.sectors:
                off_deg += mount.inside_deg(kept_az_deg, kept_el_deg)
            self.errors_deg.append(off_deg if is_seen(mount, direction_deg, elevation_deg) else 0.0)
            losses_s.append(share_lost(self.errors_deg[-1]) * STEP_S)
            self.azimuths_deg.append(kept_az_deg)
            self.elevations_deg.append(kept_el_deg)
        self.lost_s = list(accumulate(losses_s))

    def place(self, look: int) -> tuple[float, float]:
        """Where the axes are."""
        return self.azimuths_deg[look], self.elevations_deg[look]

    def holds(self, look: int) -> bool:
        """Whether the antenna reaches the target on this way at this look, or the target is not seen."""
        return look == len(self.azimuths_deg) or self.loss_s(look) < 0.99 * STEP_S

    def loss_s(self, look: int) -> float:
        """Seconds lost from this look to the next."""
        return self.lost_s[look + 1] - self.lost_s[look]

    def change(self, to: Flown, look: int, speeds: Speeds) -> tuple[int, float]:
        """At which look the antenna is on the other way, if it leaves at this one, and the seconds that are lost."""
        travel_s = max(
            abs(to.azimuths_deg[look] - self.azimuths_deg[look]) / speeds.azimuth_dps,
            abs(to.elevations_deg[look] - self.elevations_deg[look]) / speeds.elevation_dps,
        )
        arrival = min(look + math.ceil(travel_s / STEP_S), len(self.lost_s) - 1)
        # A change that the end of the pass cuts short costs no more than what was left of the pass.
        return arrival, min(travel_s, (arrival - look) * STEP_S)

    def lost_after_change_s(self, before: Flown, look: int, speeds: Speeds) -> float:
        """Seconds lost in all, if the antenna changes from `before` to this way at that look."""
        arrival, spent_s = before.change(self, look, speeds)
        return before.lost_s[look] + spent_s + self.lost_s[-1] - self.lost_s[arrival]
