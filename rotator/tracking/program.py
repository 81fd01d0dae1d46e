"""A flight along a timed table that a person has handed in (program track), or along that of a demo pass.

Knows the time from which a table counts. It computes for up to some seconds, so `planner` gives it a process of its
own. Knows no clock and no thread.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from rotator.control.sky.flight_plan import Antenna, plan_flight, plan_given_angles
from rotator.control.sky.known_path import KnownPath, Row
from rotator.control.sky.named_turns import axis_rows, names_turns, on_the_sky, smooth_turns
from rotator.control.sky.timed_table import TimedTable, hindrance, smooth
from rotator.orbits.demo_pass import demo_pass
from rotator.tracking.next_flight import AHEAD_S, LONGEST_S, NextFlight, Now
from rotator.tracking.travel import Travel


class CannotFly(Exception):  # noqa: N818 - a sentence about a table
    """The antenna cannot follow the table, or the table is over. The text says which."""


@dataclass(frozen=True, slots=True)
class Program:
    """`from_loop_s`: start of a table that is not in UTC, on the control loop's clock."""

    table: TimedTable
    from_loop_s: float


BEFORE_DEMO_S = 5.0
"""Seconds to plan a demo pass, before the antenna sets off to where it rises."""


def demo_program(zone: str, times: int, antenna: Antenna | None, now_s: float) -> Program:
    """The demo pass over the continent of this time zone. It rises when the antenna can be there. Raises CannotFly."""
    if antenna is None:
        raise CannotFly("the antenna's angles are not known")
    found = demo_pass(zone)
    rows = found.rows(times)
    table = TimedTable(found.named(times), rows, tuple(range(1, len(rows) + 1)))
    if fault := hindrance(table, rows, antenna.mount):
        raise CannotFly(f"{table.name}, {fault}")
    travel, places = Travel(antenna), antenna.mount.places(*rows[0][1:])
    way_s = max(travel.least_s(antenna.stands_deg, place[:2]) for place in places)
    return Program(table, now_s + BEFORE_DEMO_S + way_s)


def program_flight(program: Program, antenna: Antenna, now: Now) -> NextFlight:
    """The rest of the table, or its next piece. Before its beginning the whole table is checked. Raises CannotFly."""
    table = program.table
    later_s = -now.apart_s if table.utc else program.from_loop_s
    begin_s, end_s = (at_s + later_s for at_s, _, _ in (table.rows[0], table.rows[-1]))
    if end_s <= now.loop_s:
        raise CannotFly(f"{table.name} is over")
    if begin_s > now.loop_s + AHEAD_S:
        raise CannotFly(f"{table.name} begins in {(begin_s - now.loop_s) / 86_400:.0f} days: that is too far ahead")
    if names_turns(table.rows):
        return _as_written(table, later_s, antenna, now)
    points = smooth(table.rows)
    if fault := hindrance(table, points, antenna.mount):
        raise CannotFly(f"{table.name}, {fault}")
    begin_s = max(begin_s, now.loop_s)
    piece_s = min(end_s, begin_s + LONGEST_S)
    path = _between([(at_s + later_s, az_deg, el_deg) for at_s, az_deg, el_deg in points], begin_s, piece_s)
    order = replace(plan_flight(table.name, path, antenna, now.loop_s).order, sets_s=end_s, table=True)
    return NextFlight(begin_s + now.apart_s, piece_s + now.apart_s, order)


def _as_written(table: TimedTable, later_s: float, antenna: Antenna, now: Now) -> NextFlight:
    """The table names its turns: nothing is chosen. Raises CannotFly."""
    points = smooth_turns(table.rows)
    axes = axis_rows(table, points, antenna.mount)
    if isinstance(axes, str):
        raise CannotFly(f"{table.name}, {axes}")
    axes = tuple((at_s + later_s, azimuth_deg, elevation_deg) for at_s, azimuth_deg, elevation_deg in axes)
    begin_s, end_s = max(axes[0][0], now.loop_s), axes[-1][0]
    piece_s = min(end_s, begin_s + LONGEST_S)
    sky = [on_the_sky((at_s + later_s, azimuth_deg, elevation_deg)) for at_s, azimuth_deg, elevation_deg in points]
    path = _between(sky, begin_s, piece_s)
    order = plan_given_angles(table.name, path.rows, axes, antenna, now.loop_s, span_s=(begin_s, piece_s))
    return NextFlight(begin_s + now.apart_s, piece_s + now.apart_s, replace(order, sets_s=end_s, table=True))


def _between(rows: list[Row], begin_s: float, end_s: float) -> KnownPath:
    whole = KnownPath(tuple(rows))
    inside = [row for row in rows if begin_s < row[0] < end_s]
    return KnownPath(((begin_s, *whole.direction(begin_s)), *inside, (end_s, *whole.direction(end_s))))
