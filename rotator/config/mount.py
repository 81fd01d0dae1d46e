"""The table `[mount]`: how the two axes carry the antenna, and where it may not point.

Knows the keys and the rules inside the table. How the mount really stands is in `mount_model`.
"""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator, model_validator

from rotator.config.forbidden import ForbiddenTable
from rotator.config.mount_model import MountModelTable
from rotator.config.table import Point, Table


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
    model: MountModelTable = MountModelTable()
    """How the mount really stands, as `rotator calibrate sky` finds it."""

    @model_validator(mode="after")
    def _magnetic_needs_declination(self) -> MountTable:
        if self.north == "magnetic" and self.declination_deg is None:
            raise ValueError('north = "magnetic" needs declination_deg, how far east of true north a compass points')
        return self

    @field_validator("horizon")
    @classmethod
    def _horizon_rises(cls, points: list[tuple[float, float]]) -> list[tuple[float, float]]:
        azimuths = [azimuth_deg for azimuth_deg, _ in points]
        if any(not 0 <= azimuth_deg < 360 for azimuth_deg in azimuths) or azimuths != sorted(set(azimuths)):
            raise ValueError("azimuths must rise from point to point, from 0 to below 360")
        if any(not -90 <= elevation_deg <= 90 for _, elevation_deg in points):
            raise ValueError("elevations must be from -90 to 90")
        return points
