"""The sky from below the antenna: each direction has its place, and all that is drawn stays inside."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.control.sky.angles import direction
from rotator.control.sky.mount import Mount, Range, Sector
from rotator.exchange.status import AxisStatus, Status
from rotator.views.sky_plot import ANTENNA, BOTH, TARGET, Trail, off_deg, plot
from tests.search import examples
from tests.tables import every_row

COLUMNS, ROWS = 61, 31
STATUS = Status(0.0, AxisStatus(0, 450, 0.0), AxisStatus(0, 180, 0.0))


def at(azimuth_deg: float, elevation_deg: float, target: tuple[float, float] | None = None) -> Status:
    to = target or (None, None)
    return replace(
        STATUS,
        azimuth=replace(STATUS.azimuth, angle_deg=azimuth_deg, target_deg=to[0]),
        elevation=replace(STATUS.elevation, angle_deg=elevation_deg, target_deg=to[1]),
    )


def place(mark: str, status: Status) -> tuple[int, int]:
    rows = [text.plain for text in plot(COLUMNS, ROWS, status, None)][:-1]
    ((row, column),) = [(y, row.index(mark)) for y, row in enumerate(rows) if mark in row]
    return column, row


@every_row(
    ("azimuth_deg", "elevation_deg", "side"),
    [
        (0.0, 10.0, (0, -1)),
        (90.0, 10.0, (1, 0)),
        (180.0, 10.0, (0, 1)),
        (270.0, 10.0, (-1, 0)),
        (450.0, 10.0, (1, 0)),
        (90.0, 170.0, (-1, 0)),
        (123.0, 90.0, (0, 0)),
        (0.0, -5.0, (0, -1)),
    ],
)
def test_north_is_up_and_east_is_right(azimuth_deg: float, elevation_deg: float, side: tuple[int, int]) -> None:
    column, row = place(ANTENNA, at(azimuth_deg, elevation_deg))
    middle = (COLUMNS - 1) // 2, (ROWS - 1) // 2
    assert ((column > middle[0] + 1) - (column < middle[0] - 1), (row > middle[1]) - (row < middle[1] - 1)) == side


def test_antenna_and_target_are_seen_apart_and_together() -> None:
    assert place(TARGET, at(90.0, 10.0, (180.0, 10.0))) == place(ANTENNA, at(180.0, 10.0))
    assert place(BOTH, at(90.0, 10.0, (90.0, 10.0))) == place(ANTENNA, at(90.0, 10.0))


def test_off_target_is_the_angle_on_the_sky() -> None:
    assert off_deg(at(0.0, 0.0)) is None
    assert off_deg(at(0.0, 80.0, (180.0, 80.0))) == pytest.approx(20.0)
    assert off_deg(at(0.0, 80.0, (180.0, 100.0))) == pytest.approx(0.0, abs=1e-5)
    only_azimuth = replace(at(10.0, 0.0), azimuth=replace(STATUS.azimuth, angle_deg=10.0, target_deg=13.0))
    assert off_deg(only_azimuth) == pytest.approx(3.0)


def test_the_trail_is_where_it_has_pointed_in_the_last_20_minutes() -> None:
    trail = Trail()
    for second in range(3000):
        trail.note(replace(at(second / 10.0, 0.0), at_s=float(second)))
    assert trail.ways[0] == (pytest.approx(180.0, abs=1.6), 0.0)
    assert trail.ways[-1] == (pytest.approx(299.9, abs=1.6), 0.0)
    assert len(trail.ways) < 100
    trail.note(replace(STATUS, azimuth=replace(STATUS.azimuth, angle_deg=None), at_s=9999.0))
    assert trail.ways == []


@given(
    st.integers(24, 120),
    st.integers(12, 60),
    st.floats(-180.0, 540.0),
    st.floats(-20.0, 200.0),
    st.lists(st.floats(0.0, 359.0), max_size=3, unique=True),
    st.lists(st.tuples(st.floats(0.0, 400.0), st.floats(0.0, 120.0)), max_size=2),
)
@settings(max_examples=examples(40), deadline=None)
def test_it_fills_its_cells_whatever_is_drawn(  # noqa: PLR0917 - hypothesis fills them in
    columns: int,
    rows: int,
    azimuth_deg: float,
    elevation_deg: float,
    horizon: list[float],
    corners: list[tuple[float, float]],
) -> None:
    mount = Mount(
        Range(-180.0, 540.0),
        Range(0.0, 180.0),
        horizon=tuple((each, 20.0) for each in sorted(horizon)),
        sectors=tuple(Sector("it", Range(az, az + 30.0), Range(el, el + 50.0), 2.0) for az, el in corners),
    )
    texts = plot(columns, rows, at(azimuth_deg, elevation_deg, (0.0, 0.0)), mount, [direction(12.0, 100.0)])
    assert len(texts) == rows
    assert {len(text.plain) for text in texts} == {columns}
    for letter in "NESW":
        assert any(letter in text.plain for text in texts[:-1])
