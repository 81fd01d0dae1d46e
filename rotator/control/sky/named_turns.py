"""A timed table with an azimuth above 360 or an elevation above 90: its writer has chosen the turns of the axes.

So the antenna follows it exactly as it is written: nothing is chosen here, neither a turn nor a way over the top nor a
moment to unwind. Its angles become axis angles like those of a program's orders. Knows the mount. Knows no motors.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, direction
from rotator.control.sky.known_path import Row
from rotator.control.sky.mount import Mount, Unreachable
from rotator.control.sky.timed_table import (
    SMOOTH_S,
    TimedTable,
    above_elevation,
    beyond_azimuth,
    in_sector,
    place_of,
)


def names_turns(rows: Sequence[Row]) -> bool:
    """Whether the writer of this table has chosen the turns of the axes."""
    return any(azimuth_deg > FULL_TURN_DEG or elevation_deg > ZENITH_DEG for _, azimuth_deg, elevation_deg in rows)


def smooth_turns(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The same rows, and points of a smooth curve between rows that are far apart. Each angle has its own curve.

    No point is beyond the smallest and the largest angle of the table, because these may be the rotor's limits.
    """
    found: list[Row] = []
    least_deg, most_deg = ([choose(row[axis] for row in rows) for axis in (1, 2)] for choose in (min, max))
    for index in range(len(rows) - 1):
        (a_s, *a_deg), (b_s, *b_deg) = rows[index], rows[index + 1]
        found.append(rows[index])
        lasts_s = b_s - a_s
        leaves, arrives = _speed_dps(rows, index), _speed_dps(rows, index + 1)
        for step in range(1, max(1, math.ceil(lasts_s / SMOOTH_S - 1e-6))):
            share = step * SMOOTH_S / lasts_s
            angles_deg = [
                _hermite(a_deg[axis], b_deg[axis], leaves[axis] * lasts_s, arrives[axis] * lasts_s, share)
                for axis in range(2)
            ]
            azimuth_deg, elevation_deg = (
                min(max(each, low), high) for each, low, high in zip(angles_deg, least_deg, most_deg, strict=True)
            )
            found.append((a_s + share * lasts_s, azimuth_deg, elevation_deg))
    return (*found, rows[-1])


def _speed_dps(rows: Sequence[Row], at: int) -> tuple[float, float]:
    before, after = rows[max(0, at - 1)], rows[min(len(rows) - 1, at + 1)]
    lasts_s = after[0] - before[0]
    return (after[1] - before[1]) / lasts_s, (after[2] - before[2]) / lasts_s


def _hermite(a_deg: float, b_deg: float, leaves_deg: float, arrives_deg: float, share: float) -> float:
    s2, s3 = share * share, share**3
    ends_deg = (2 * s3 - 3 * s2 + 1) * a_deg + (3 * s2 - 2 * s3) * b_deg
    return ends_deg + (s3 - 2 * s2 + share) * leaves_deg + (s3 - s2) * arrives_deg


def axis_rows(table: TimedTable, points: Sequence[Row], mount: Mount) -> tuple[Row, ...] | str:
    """The axis angles of each point; a sentence if the antenna cannot be there."""
    found: list[Row] = []
    for point in points:
        where, (at_s, azimuth_deg, elevation_deg) = place_of(table, point), point
        if elevation_deg > mount.elevation.max_deg + 1e-6:
            return above_elevation(where, mount)
        try:
            axis_az_deg, axis_el_deg = mount.axis_angles(azimuth_deg, elevation_deg, azimuth_deg)
        except Unreachable:
            axis_az_deg, axis_el_deg = math.inf, 0.0
        assert axis_el_deg is not None, "an order with both angles gives both"
        if abs(axis_az_deg - azimuth_deg) > FULL_TURN_DEG / 2:
            return f"{beyond_azimuth(where, mount)}, on the turn that the table names"
        if mount.inside_deg(axis_az_deg, axis_el_deg) > 0:
            return in_sector(where)
        found.append((at_s, axis_az_deg, axis_el_deg))
    return tuple(found)


def on_the_sky(row: Row) -> Row:
    """The direction of a row, as displays show it."""
    at_s, azimuth_deg, elevation_deg = row
    return at_s, *direction(azimuth_deg, elevation_deg)
