"""Where in the sky the antenna cannot point, as areas to shade: past the ends of an axis, or in a forbidden sector.

Asks the mount for each direction, so it cannot differ from what an order gets. The horizon of trees and roofs is left
out: it is drawn by itself. Knows no motor, and no picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby

from rotator.control.sky.mount import Mount

WIDE_DEG, HIGH_DEG = 2, 1
"""The width and the height of what is looked at; a direction in its middle stands for it."""
WITHIN_DEG = 0.5
"""The antenna points there if it comes so near."""
Area = tuple[float, float, float, float]
"""Azimuth from and to, from 0 to 360; elevation from and to, up to 90."""


def unreached(mount: Mount) -> list[Area]:
    bare = replace(mount, horizon=())
    columns = [(az, tuple(_spans(bare, az + WIDE_DEG / 2))) for az in range(0, 360, WIDE_DEG)]
    areas: list[Area] = []
    for spans, group in groupby(columns, key=lambda column: column[1]):
        alike = list(group)
        areas += [(alike[0][0], alike[-1][0] + WIDE_DEG, *span) for span in spans]
    return areas


def _spans(mount: Mount, azimuth_deg: float) -> Iterator[tuple[float, float]]:
    looks = ((el, _reaches(mount, azimuth_deg, el + HIGH_DEG / 2)) for el in range(0, 90, HIGH_DEG))
    for reached, group in groupby(looks, key=lambda look: look[1]):
        if not reached:
            els = [el for el, _ in group]
            yield els[0], els[-1] + HIGH_DEG


def _reaches(mount: Mount, azimuth_deg: float, elevation_deg: float) -> bool:
    there = azimuth_deg, elevation_deg
    return any(
        mount.inside_deg(*axes) <= 0.0 and mount.off_deg(mount.pointed(*axes), there) <= WITHIN_DEG
        for *axes, _ in mount.places(*there)
    )
