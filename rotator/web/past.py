"""The last minutes on the page: the points of the strip chart and of the antenna's trail.

Knows a status, and keeps numbers of it. Knows no HTTP and no browser.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from math import isnan, nan
from typing import Annotated

from typing_extensions import TypedDict

from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG
from rotator.exchange.status import AxisStatus, Status
from rotator.views.sky_plot import aimed_at, off_deg
from rotator.web.schema import the

KEPT_S, EVERY_S = 600, 1.0
"""Seconds that the strip chart and the trail go back, and seconds between two points."""


class PastMinutes(TypedDict):
    every_s: float
    rows: Annotated[
        list[list[float | None]], the("seconds from now, azimuth, its target, elevation, its target, error")
    ]


class Past:
    """`status` gives the latest status. `note` is called every `EVERY_S` seconds."""

    def __init__(self, status: Callable[[], Status]) -> None:
        self._status = status
        self._rows: deque[tuple[float, ...]] = deque(maxlen=int(KEPT_S / EVERY_S))

    def note(self) -> None:
        """Add a point."""
        status = self._status()
        row = [status.at_s]
        for axis, aim_deg in zip((status.azimuth, status.elevation), _aims(status), strict=True):
            row += [_number(axis.points_deg), _number(aim_deg)]
        self._rows.append((*row, _number(off_deg(status))))

    def rows(self) -> PastMinutes:
        now_s = self._status().at_s
        return {
            "every_s": EVERY_S,
            "rows": [[round(row[0] - now_s, 2), *(_or_null(value) for value in row[1:])] for row in self._rows],
        }


def target_deg(axis: AxisStatus) -> float | None:
    """What was ordered of an axis, on its own scale as the antenna points; None: no order."""
    return None if axis.ordered_deg is None else axis.ordered_deg + axis.correction_deg


def _aims(status: Status) -> tuple[float | None, float | None]:
    """The wanted angle of each axis, on its own scale: in a planned pass the satellite's, on the antenna's turn."""
    azimuth, elevation = status.azimuth, status.elevation
    there = aimed_at(status) if status.flown else None
    if there is None or azimuth.points_deg is None or elevation.points_deg is None:
        return target_deg(azimuth), target_deg(elevation)
    azimuth_deg, elevation_deg = there
    if elevation.points_deg > ZENITH_DEG:
        azimuth_deg, elevation_deg = azimuth_deg + 180.0, 180.0 - elevation_deg
    return azimuth_deg + FULL_TURN_DEG * round((azimuth.points_deg - azimuth_deg) / FULL_TURN_DEG), elevation_deg


def _number(number: float | None) -> float:
    return nan if number is None else number


def _or_null(number: float) -> float | None:
    return None if isnan(number) else round(number, 2)
