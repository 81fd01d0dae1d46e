"""A timed table of directions that is tracked as it stands (program track): smooth between rows, checked beforehand.

Knows the mount that shall follow it. Knows no motors, and not where the table comes from.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.angles import Vector, direction_of, unit
from rotator.control.sky.known_path import Row
from rotator.control.sky.mount import Mount

SMOOTH_S = 1.0
"""Between rows that are further apart than this a curve is laid, with points this far apart."""


@dataclass(frozen=True, slots=True)
class TimedTable:
    """Two rows or more, at rising moments: seconds from the moment when it is handed in, or UTC since 1970."""

    name: str
    rows: tuple[Row, ...]
    lines: tuple[int, ...]
    """The line of each row, as a person has written the table."""
    utc: bool = False

    def line(self, at_s: float) -> int:
        """The line of the latest row up to this moment."""
        return self.lines[max(0, bisect_right(self.rows, at_s, key=lambda row: row[0]) - 1)]


def smooth(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The same rows, and points of a curve between those that are far apart.

    The curve goes through the rows, and at each of them on in the direction from the row before to the row after
    (cubic Hermite in space), so that neither azimuth at north nor the zenith is a special place.
    """
    places = [unit(azimuth_deg, elevation_deg) for _, azimuth_deg, elevation_deg in rows]
    found: list[Row] = []
    for index in range(len(rows) - 1):
        (a_s, *_), (b_s, *_) = rows[index], rows[index + 1]
        found.append(rows[index])
        lasts_s = b_s - a_s
        count = math.ceil(lasts_s / SMOOTH_S - 1e-6)
        if count < 2:
            continue
        ends = places[index], places[index + 1]
        speeds = _speed(rows, places, index), _speed(rows, places, index + 1)
        for step in range(1, count):
            share = step / count
            azimuth_deg, elevation_deg = direction_of(_hermite(ends, speeds, share, lasts_s))
            found.append((a_s + share * lasts_s, azimuth_deg % 360.0, elevation_deg))
    return (*found, rows[-1])


def _speed(rows: Sequence[Row], places: Sequence[Vector], at: int) -> Vector:
    """At this row: from the row before to the row after; at an end from the one to the other."""
    before, after = max(0, at - 1), min(len(rows) - 1, at + 1)
    lasts_s = rows[after][0] - rows[before][0]
    east, north, up = ((b - a) / lasts_s for a, b in zip(places[before], places[after], strict=True))
    return east, north, up


def _hermite(ends: tuple[Vector, Vector], speeds: tuple[Vector, Vector], share: float, lasts_s: float) -> Vector:
    """This share of the way from one end to the other, with the speeds at both."""
    (a, b), (leaves, arrives) = ends, speeds
    s2, s3 = share * share, share**3
    of_a, of_b = 2 * s3 - 3 * s2 + 1, 3 * s2 - 2 * s3
    of_leaves, of_arrives = (s3 - 2 * s2 + share) * lasts_s, (s3 - s2) * lasts_s
    east, north, up = (
        of_a * a[axis] + of_b * b[axis] + of_leaves * leaves[axis] + of_arrives * arrives[axis] for axis in range(3)
    )
    return east, north, up


def place_of(table: TimedTable, row: Row) -> str:
    """The line and the angles of a row, as the beginning of a sentence."""
    at_s, azimuth_deg, elevation_deg = row
    return f"line {table.line(at_s)}: azimuth {azimuth_deg:.1f}°, elevation {elevation_deg:.1f}°"


def beyond_azimuth(where: str, mount: Mount) -> str:
    limits = f"{mount.azimuth.min_deg:g}° to {mount.azimuth.max_deg:g}°"
    return f"{where} is outside the rotor's azimuth range of {limits}"


def above_elevation(where: str, mount: Mount) -> str:
    return f"{where} is above the rotor's elevation range, which ends at {mount.elevation.max_deg:g}°"


def in_sector(where: str) -> str:
    return f"{where} is in a forbidden sector, or in its margin"


def hindrance(table: TimedTable, path: Sequence[Row], mount: Mount) -> str:
    """Why the antenna cannot point where the table wants it; empty: it can. `path`: the table, smooth.

    Below the horizon, and behind trees and roofs, elevation rests as low as it may.
    """
    for row in path:
        where, (_, azimuth_deg, elevation_deg) = place_of(table, row), row
        places = mount.places(azimuth_deg, elevation_deg)
        if not places:
            return beyond_azimuth(where, mount)
        high = [place for place in places if mount.pointed(*place[:2])[1] >= elevation_deg - 0.5 or place[2]]
        if not high:
            return above_elevation(where, mount)
        if all(mount.inside_deg(*place[:2]) > 0 for place in high):
            return in_sector(where)
    return ""
