"""The tables [mount.model] and [sim.mount]: how a mount really stands, and the points at which that was seen.

Knows keys and bounds. Does not know how a model turns directions into axis angles, nor how it is found.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, field_validator

from rotator.config.table import Table

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
