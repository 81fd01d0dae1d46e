"""Satellites that fly together, such as a station and the ships docked to it: one of them represents all.

Knows that elements of one orbit may be of different hours. Does not know what the satellites are.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from contextlib import suppress
from itertools import islice

from rotator.orbits.moments import DAY_S
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, turn_deg

TOGETHER_KM = 5.0
"""The error of elements that are some days old."""
APART_S = 2700.0
"""Seconds between the two comparisons: in this time a satellite that crosses the other's path has left it."""
NEAR_DEG, NEAR_TILT_DEG, NEAR_REV_PER_DAY = 5.0, 0.05, 0.01
"""Mean elements that differ by more, each at its own epoch, belong to two orbits."""


def one_of_each(satellites: Iterable[Satellite]) -> list[Satellite]:
    """Without those that fly with another one that has a lower catalogue number. The order stays."""
    candidates = list(satellites)
    if not candidates:
        return candidates
    # The moment of most of them: one wrong epoch does not move it.
    at_s = sorted(each.elements.epoch_utc_s for each in candidates)[(len(candidates) - 1) // 2]
    around = sorted(candidates, key=lambda each: _on_its_orbit_deg(each, at_s))
    # The first ones again at the end: an orbit is a circle.
    angles_deg = [_on_its_orbit_deg(each, at_s) for each in around]
    wrapped = [*zip(angles_deg, around, strict=True)]
    wrapped += [(deg + 360.0, each) for deg, each in wrapped if deg < NEAR_DEG]
    left_out: set[tuple[int, str]] = set()
    for index, (deg, one) in enumerate(wrapped[: len(candidates)]):
        for other_deg, other in islice(wrapped, index + 1, None):
            # Of a crowd on one orbit the first leaves out all others, and those are not compared among themselves.
            if other_deg - deg > NEAR_DEG or _number(one) in left_out:
                break
            if _number(other) not in left_out and _may_be_one(one, other) and _together(one, other, at_s):
                left_out.add(max(_number(one), _number(other)))
    return [each for each in candidates if _number(each) not in left_out]


def _number(satellite: Satellite) -> tuple[int, str]:
    """Before launch several have one number."""
    return satellite.elements.catalogue_number, satellite.elements.name


def _on_its_orbit_deg(satellite: Satellite, at_s: float) -> float:
    """From the node, about."""
    elements = satellite.elements
    turns = elements.mean_motion_rev_per_day * (at_s - elements.epoch_utc_s) / DAY_S
    return (elements.perigee_argument_deg + elements.mean_anomaly_deg + 360.0 * turns) % 360.0


def _may_be_one(one: Satellite, other: Satellite) -> bool:
    a, b = one.elements, other.elements
    node_deg = turn_deg(a.ascending_node_deg, b.ascending_node_deg)
    return (
        abs(node_deg) < NEAR_DEG
        and abs(a.inclination_deg - b.inclination_deg) < NEAR_TILT_DEG
        and abs(a.mean_motion_rev_per_day - b.mean_motion_rev_per_day) < NEAR_REV_PER_DAY
    )


def _together(one: Satellite, other: Satellite, at_s: float) -> bool:
    with suppress(NotThere):
        return all(_apart_km(one, other, at_s + later_s) < TOGETHER_KM for later_s in (0.0, APART_S))
    return False


def _apart_km(one: Satellite, other: Satellite, at_s: float) -> float:
    a, b = one.sight(at_s), other.sight(at_s)
    across_km = 2 * math.sqrt(a.range_km * b.range_km) * math.sin(math.radians(a.apart_deg(b)) / 2)
    return math.hypot(a.range_km - b.range_km, across_km)
