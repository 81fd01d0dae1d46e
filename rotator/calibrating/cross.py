"""The cross that a boom scans about its target: its places, in order, and which of them the antenna can go to.

Each arm is scanned there and back. Play in the gears, and a signal that grows meanwhile, shift the peak of one way as
far as that of the other, in the opposite direction: their mean is right. Knows the sphere and the mount. Knows no time
and no receiver.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.angles import direction_of, great_circle_deg, unit
from rotator.control.sky.beam_fit import Heard
from rotator.control.sky.mount import Mount, Unreachable

Beside = tuple[float, float]
"""To the right and above, in degrees on the sky."""

WIDE, NARROW = (1.0, 9), (0.6, 7)
"""How far an arm goes to each side, in beams, and its places."""
EDGE = 0.1
"""A middle this near to the end of an arm, in beams, may as well be beyond it."""
NEARLY = 0.1
"""A place is reached where the boom comes so near to it, in beams."""
LOBE = 0.9
"""How far the main lobe goes from its middle, in beams."""
LEAST_PLACES = 4
"""Of an arm: with fewer there is no peak to be seen."""


@dataclass(frozen=True, slots=True)
class Cross:
    """`centre`: the middle of the cross. `reach`: how far each arm goes to each side, in beams; `count`: its places."""

    centre: Beside
    beam_deg: float
    reach: float
    count: int

    def arms(self) -> tuple[list[Beside], list[Beside]]:
        """Where the target is to seem to be, one place after the other: across, then up and down."""
        right_deg, above_deg = self.centre
        steps = [self.reach * self.beam_deg * (2 * at / (self.count - 1) - 1) for at in range(self.count)]
        across = [(right_deg - step, above_deg) for step in steps]
        upright = [(right_deg, above_deg - step) for step in steps]
        return across, upright


def boom_direction(target: Beside, beside: Beside) -> tuple[float, float]:
    """Where the boom has to point for the target, at this azimuth and elevation, to seem to be so far beside it."""
    azimuth_deg, elevation_deg = target
    az, el = math.radians(azimuth_deg), math.radians(elevation_deg)
    off_deg = math.hypot(*beside)
    if off_deg == 0.0:
        return azimuth_deg, elevation_deg
    off = math.radians(off_deg)
    right, above = -beside[0] / off_deg, -beside[1] / off_deg
    to_right = (math.cos(az), -math.sin(az), 0.0)
    upwards = (-math.sin(el) * math.sin(az), -math.sin(el) * math.cos(az), math.cos(el))
    there = [
        math.cos(off) * ahead + math.sin(off) * (right * r + above * u)
        for ahead, r, u in zip(unit(azimuth_deg, elevation_deg), to_right, upwards, strict=True)
    ]
    boom_azimuth_deg, boom_elevation_deg = direction_of((there[0], there[1], there[2]))
    return boom_azimuth_deg % 360.0, boom_elevation_deg


def within_reach(mount: Mount, direction_deg: tuple[float, float], stands_deg: float, beam_deg: float) -> bool:
    """Whether the boom can go to this direction: range, horizon and sectors leave it free."""
    try:
        azimuth_deg, elevation_deg = mount.axis_angles(*direction_deg, stands_deg)
    except Unreachable:
        return False
    assert elevation_deg is not None, "the direction has an elevation"
    there = mount.pointed(azimuth_deg, elevation_deg)
    near = great_circle_deg(*there, *direction_deg) <= NEARLY * beam_deg
    return near and not mount.inside_deg(azimuth_deg, elevation_deg)


def at_edge(heard: Sequence[Heard], middle: Beside, beam_deg: float) -> bool:
    """Whether the middle lies at the edge of the places that were scanned, so that the true one may lie beyond."""
    room = EDGE * beam_deg
    for at_deg, places in zip(
        middle, ([each.right_deg for each in heard], [each.above_deg for each in heard]), strict=True
    ):
        if not min(places) + room <= at_deg <= max(places) - room:
            return True
    return False


def nearby(heard: Sequence[Heard], middle: Beside, beam_deg: float) -> list[Heard]:
    """What was heard in the main lobe: beyond it a real beam has no bell shape."""
    return [each for each in heard if math.dist((each.right_deg, each.above_deg), middle) <= LOBE * beam_deg]
