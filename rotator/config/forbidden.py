"""The tables [[mount.forbidden]]: sectors in which the antenna would touch something.

Knows their keys, and which of them contradict the range, the park position or each other. Knows no motor.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pydantic import Field

from hw.ports import Axis
from rotator.config.axes import AxisTable
from rotator.config.table import Point, Table

Place = tuple[float, float]
"""An azimuth and an elevation, in degrees on the rotor's own scale."""


class ForbiddenTable(Table):
    name: str = Field(min_length=1, max_length=40)
    """What stands there, as messages name it: `the chimney`."""
    azimuth_deg: Point
    """[from, to] in azimuth, on the rotor's own scale."""
    elevation_deg: Point
    """[from, to] in elevation; beyond 90 the antenna is over the top."""
    margin_deg: float = Field(2.0, ge=0, le=45)
    """Kept free on all sides: for the gears' play, the sensor's error, wind."""

    def faults(self) -> list[str]:
        return [
            f"{axis.value}_deg = [{low_deg:g}, {high_deg:g}] must rise; "
            "a sector across the end of the scale is two tables"
            for axis in Axis
            for low_deg, high_deg in [self.span(axis)]
            if low_deg >= high_deg
        ]

    def span(self, axis: Axis) -> Point:
        return self.azimuth_deg if axis is Axis.AZIMUTH else self.elevation_deg

    def keeps_away(self, axis: Axis, angle_deg: float) -> bool:
        """Whether the sector with its margin holds this angle of the axis."""
        low_deg, high_deg = self.span(axis)
        return low_deg - self.margin_deg < angle_deg < high_deg + self.margin_deg


def forbidden_faults(
    tables: Sequence[ForbiddenTable], axes: Mapping[Axis, AxisTable], places: Mapping[str, Place]
) -> list[str]:
    """What is wrong with the sectors, one sentence each. `places`: by key, where the antenna must be able to stand."""
    faults = []
    for number, table in enumerate(tables):
        where = f'mount.forbidden[{number}] "{table.name}"'
        outside = [axis for axis in Axis if not _overlaps(table.span(axis), axes[axis])]
        for axis in outside:
            limits = f"{axes[axis].min_deg:g} to {axes[axis].max_deg:g}"
            faults.append(f"{where}: {axis.value}_deg lies outside the rotor's range of {limits}")
        if not outside and all(_covers(table, axis, axes[axis]) for axis in Axis):
            faults.append(f"{where} covers the whole range: nothing could move")
        faults += [
            f"{where} holds {key}: the antenna could not stand there"
            for key, place in places.items()
            if all(table.keeps_away(axis, angle_deg) for axis, angle_deg in zip(Axis, place, strict=True))
        ]
    names = [table.name for table in tables]
    faults += [f'two of mount.forbidden are named "{name}"' for name in sorted(set(names)) if names.count(name) > 1]
    return faults


def seen_again(tables: Sequence[ForbiddenTable], axes: Mapping[Axis, AxisTable]) -> list[tuple[str, str]]:
    """What stands in a sector stands in the same direction on another turn, or over the top, if the rotor goes there.

    For each such place without a sector of its own: what and where it is, and the keys of a table for it.
    """
    azimuth, elevation = axes[Axis.AZIMUTH], axes[Axis.ELEVATION]
    found = []
    for table in tables:
        (west_deg, east_deg), (low_deg, high_deg) = table.azimuth_deg, table.elevation_deg
        again = [
            (f"{table.name} stands on the other turn of the azimuth too", turn_deg, low_deg, high_deg)
            for turn_deg in (() if azimuth.endless else (-360.0, 360.0))
        ]
        again += [
            (f"over the top the antenna meets {table.name} too", turn_deg, 180.0 - high_deg, 180.0 - low_deg)
            for turn_deg in (-180.0, 180.0)
        ]
        for sentence, turn_deg, bottom_deg, top_deg in again:
            west, east = max(west_deg + turn_deg, azimuth.min_deg), min(east_deg + turn_deg, azimuth.max_deg)
            bottom, top = max(bottom_deg, elevation.min_deg), min(top_deg, elevation.max_deg)
            if west < east and bottom < top and not _met(tables, (west, east), (bottom, top)):
                keys = f"azimuth_deg = [{west:g}, {east:g}], elevation_deg = [{bottom:g}, {top:g}]"
                found.append((sentence, keys))
    return found


def _met(tables: Sequence[ForbiddenTable], azimuth_deg: Point, elevation_deg: Point) -> bool:
    """Whether one of the sectors lies there, so that a person has thought of it."""
    return any(
        table.azimuth_deg[0] < azimuth_deg[1]
        and azimuth_deg[0] < table.azimuth_deg[1]
        and table.elevation_deg[0] < elevation_deg[1]
        and elevation_deg[0] < table.elevation_deg[1]
        for table in tables
    )


def _overlaps(span: Point, axis: AxisTable) -> bool:
    return span[0] <= axis.max_deg and span[1] >= axis.min_deg


def _covers(table: ForbiddenTable, axis: Axis, limits: AxisTable) -> bool:
    low_deg, high_deg = table.span(axis)
    return low_deg - table.margin_deg <= limits.min_deg and high_deg + table.margin_deg >= limits.max_deg
