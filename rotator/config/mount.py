"""The table `[mount]`: how the two axes carry the antenna, where it may not point, and how it really stands.

Knows the keys and the rules inside the table. Does not know how `[mount.model]` turns directions into axis angles, nor
how it is found.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, field_validator

from rotator.config.forbidden import ForbiddenTable
from rotator.config.table import Point, Table

SkyRow = Annotated[tuple[float, float, float, float], Field(strict=False)]
"""Azimuth and elevation of the axes, on the rotor's own scale; azimuth and elevation of what the boom pointed at."""
POINT_BOUNDS = ((-360.0, 720.0), (-90.0, 210.0), (0.0, 360.0), (-10.0, 90.0))


class MountTerms(Table):
    ia_deg: float = Field(0.0, ge=-10, le=10)
    """The azimuth reads too much."""
    ie_deg: float = Field(0.0, ge=-10, le=10)
    """The elevation reads too little."""
    an_deg: float = Field(0.0, ge=-10, le=10)
    """The mast leans north."""
    aw_deg: float = Field(0.0, ge=-10, le=10)
    """The mast leans west."""
    ca_deg: float = Field(0.0, ge=-10, le=10)
    """The boom points left of square to the cross axis."""
    npae_deg: float = Field(0.0, ge=-10, le=10)
    """The cross axis hangs down on its left."""


class MountModelTable(MountTerms):
    points: list[SkyRow] = Field(default_factory=list, max_length=200)
    """Where the terms come from: azimuth and elevation of the rotor, then of the sky."""

    @field_validator("points")
    @classmethod
    def _are_places(cls, points: list[SkyRow]) -> list[SkyRow]:
        for point in points:
            for value, (low, high) in zip(point, POINT_BOUNDS, strict=True):
                if not low <= value <= high:
                    raise ValueError(f"{value:g} of the point {list(point)} must be from {low:g} to {high:g}")
        return points


class MountTable(Table):
    flip: Literal["off", "over-top"] = "off"
    """`over-top`: the box may turn the antenna over the top. Only after you have watched antenna and cables clear the
    mast."""
    north: Literal["true", "magnetic"] = "true"
    """The north of the azimuth scale; orders and reports always use true north."""
    declination_deg: float | None = Field(None, ge=-180, le=180)
    """How far a compass points east of true north (west: minus); `magnetic` needs it."""
    tolerance: Literal["sky", "axis"] = "sky"
    """What `tolerance_deg` means, for motors on relays. Degrees on the sky, ahead of a moving target; or, as an Arduino
    does it, of each axis from the latest order."""
    park_azimuth_deg: float = Field(0.0, ge=-360, le=720)
    park_elevation_deg: float = Field(0.0, ge=-90, le=210)
    """The park position, on the rotor's own scale: from `min_deg` to `max_deg`, and in no sector. Left out: 0, or
    what the rotor has nearest to it."""
    park_after_s: float = Field(0.0, ge=0, le=86_400)
    """In AUTO, park so long after the last order is done; 0: never."""
    horizon: list[Point] = Field(default_factory=list)
    """Points [azimuth, lowest elevation] of trees and roofs, or of the sea below; azimuths rise from 0 to below 360."""
    forbidden: list[ForbiddenTable] = Field(default_factory=list, max_length=16)
    """Where the antenna would touch something: no path crosses it. 16 at most."""
    model: MountModelTable = MountModelTable.model_construct()
    """How the mount really stands, as `rotator calibrate sky` finds it."""

    def faults(self) -> Iterator[str]:
        if self.north == "magnetic" and self.declination_deg is None:
            yield 'north = "magnetic" needs declination_deg, how far east of true north a compass points'

    @field_validator("horizon")
    @classmethod
    def _horizon_rises(cls, points: list[tuple[float, float]]) -> list[tuple[float, float]]:
        azimuths = [azimuth_deg for azimuth_deg, _ in points]
        if any(not 0 <= azimuth_deg < 360 for azimuth_deg in azimuths) or azimuths != sorted(set(azimuths)):
            raise ValueError("azimuths must rise from point to point, from 0 to below 360")
        if any(not -90 <= elevation_deg <= 90 for _, elevation_deg in points):
            raise ValueError("elevations must be from -90 to 90")
        return points
