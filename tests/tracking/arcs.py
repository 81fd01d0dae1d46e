"""Targets for plans: a made-up arc over the station, and the satellites of 2025 on orbits turned by a few degrees.

Computes what a flight is worth, and where the antenna stands, by other means than the plan: second by second from the
target itself. Knows none of the plan's own looks, courses or cuts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

from rotator.control.sky.angles import turn_deg
from rotator.control.sky.flight_plan import Antenna, PlannedMotor
from rotator.control.sky.mount import Mount, Range
from rotator.orbits.earth import Site
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import Sight, Target
from rotator.tracking.planned import Followed, PlannedPass
from tests.orbits.test_satellite import FLYING

AZIMUTH_DPS, ELEVATION_DPS = 6.0, 2.7
MOTORS = PlannedMotor(AZIMUTH_DPS, 0.17, 4.0), PlannedMotor(ELEVATION_DPS, 0.17, 4.0)
FULL = Mount(Range(0, 450), Range(0, 180))
SINGLE = Mount(Range(0, 360), Range(0, 90))
OVER = Mount(Range(0, 360), Range(0, 180), flip=True)
BERLIN = Site(52.5, 13.4, 50.0)
EPOCH_S = FLYING["ISS"].epoch_utc_s
LOST_DEG = 10.0


@dataclass(frozen=True, slots=True)
class Arc:
    """It rises once, at `aos_s`, moves evenly in azimuth, and is highest in the middle."""

    name: str
    aos_s: float
    seconds: float
    from_deg: float
    turn_deg: float
    top_deg: float

    @property
    def los_s(self) -> float:
        return self.aos_s + self.seconds

    def sight(self, utc_s: float) -> Sight:
        share = (utc_s - self.aos_s) / self.seconds
        height_deg = self.top_deg * (1.0 - (2.0 * share - 1.0) ** 2)
        return Sight((self.from_deg + share * self.turn_deg) % 360.0, max(height_deg, -60.0), 1000.0)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


def satellites(count: int) -> list[Satellite]:
    """So many satellites like RS-44, SO-50 and ISS, spread over the sky."""
    kinds = sorted(FLYING)
    return [
        Satellite(
            replace(
                FLYING[kinds[number % len(kinds)]],
                name=f"{kinds[number % len(kinds)]} {number}",
                ascending_node_deg=(53.0 * number) % 360.0,
                mean_anomaly_deg=(97.0 * number) % 360.0,
            ),
            BERLIN,
        )
        for number in range(count)
    ]


def antenna(mount: Mount, stands_deg: tuple[float, float] = (0.0, 0.0)) -> Antenna:
    return Antenna(mount, *MOTORS, stands_deg)


def travel_s(a: tuple[float, float], b: tuple[float, float]) -> float:
    return max(abs(b[0] - a[0]) / AZIMUTH_DPS, abs(b[1] - a[1]) / ELEVATION_DPS)


def worth(followed: Followed, begin_s: float, end_s: float, azimuth_deg: float, mount: Mount) -> float:
    """Minutes times priority, half as much at the horizon as overhead, less by the square of the error: of a flight
    that goes on from `azimuth_deg`, limits aside, without an unwind."""
    target, priority = followed.target, followed.priority
    total, before_deg = 0.0, target.sight(begin_s).azimuth_deg
    for at_s in seconds_between(begin_s, end_s, 2.0):
        sight = target.sight(at_s)
        azimuth_deg += turn_deg(before_deg, sight.azimuth_deg)
        before_deg = sight.azimuth_deg
        height_rad = math.radians(max(0.0, sight.elevation_deg))
        off_deg = min(90.0, abs(azimuth_deg - mount.azimuth.nearest(azimuth_deg))) * math.cos(height_rad)
        kept = 1.0 - min(1.0, off_deg / LOST_DEG) ** 2
        total += priority * kept * (1.0 + math.sin(height_rad)) / 2.0 * 2.0 / 60.0
    return total


def seconds_between(begin_s: float, end_s: float, step_s: float) -> Sequence[float]:
    return [begin_s + step_s * (count + 0.5) for count in range(max(1, round((end_s - begin_s) / step_s)))]


def places_at_end(each: PlannedPass, target: Target, mount: Mount) -> list[tuple[float, float]]:
    """Where the antenna may stand when a flight ends: one place if it followed the target all the way, else every
    turn on which it may have ended."""
    flight = each.flight
    assert flight is not None
    last = target.sight(flight.end_s)
    azimuth_deg, before_deg = flight.wait_deg[0], target.sight(flight.begin_s).azimuth_deg
    over = flight.over_the_top
    if flight.lost_s == 0 and abs(turn_deg(before_deg + 180.0 * over, azimuth_deg)) < 1e-6:
        for at_s in (*seconds_between(flight.begin_s, flight.end_s, 3.0), flight.end_s):
            here_deg = target.sight(at_s).azimuth_deg
            azimuth_deg += turn_deg(before_deg, here_deg)
            before_deg = here_deg
        return [_stands(mount, azimuth_deg, last.elevation_deg, over=over)]
    return [
        _stands(mount, last.azimuth_deg + turn, last.elevation_deg, over=flipped)
        for flipped in (False, True)
        for turn in ((-180.0, 180.0) if flipped else (-360.0, 0.0, 360.0))
    ]


def _stands(mount: Mount, azimuth_deg: float, elevation_deg: float, *, over: bool) -> tuple[float, float]:
    kept_deg = mount.azimuth.nearest(azimuth_deg)
    return kept_deg, mount.clear_deg(kept_deg, 180.0 - elevation_deg if over else elevation_deg)


CELL_S = 2.0 / ELEVATION_DPS


def round_s(mount: Mount, a: tuple[float, float], b: tuple[float, float]) -> float:
    """The quickest way from one place to another on a chart in which the sectors are blocked. A cell is as far as each
    motor turns in `CELL_S`: so the chart is searched ring by ring."""
    wide_deg, high_deg = AZIMUTH_DPS * CELL_S, ELEVATION_DPS * CELL_S
    start, end = ((round(place[0] / wide_deg), round(place[1] / high_deg)) for place in (a, b))
    ring, done, count = {start}, {start}, 0
    while ring and end not in ring:
        count += 1
        around = {(i + di, j + dj) for i, j in ring for di, dj in product((-1, 0, 1), (-1, 0, 1))} - done
        done |= around
        ring = {cell for cell in around if _free(mount, (cell[0] * wide_deg, cell[1] * high_deg))}
    return count * CELL_S if ring else math.inf


def _free(mount: Mount, place: tuple[float, float]) -> bool:
    return mount.azimuth.holds(place[0]) and mount.elevation.holds(place[1]) and not mount.inside_deg(*place)


def follow(*targets: Target, priority: float = 1.0) -> list[Followed]:
    return [Followed(target, priority) for target in targets]
