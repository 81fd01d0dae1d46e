"""The mount as it really stands: axes that lean or are not square, and scales that begin beside true north and level.

Knows six terms, by the names and signs of the telescope makers' papers, and the sphere. Turns what axes without any
error would read into what these axes read, and back. Both are exact, also near the zenith and over the top. Knows no
range, no turn of the overlap and no motor.

For small terms, far from the zenith, the boom points at the axis angles and this:

    azimuth:    - IA - CA / cos E - NPAE tan E - (AN sin A + AW cos A) tan E
    elevation:  + IE - AN cos A + AW sin A
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rotator.control.sky.angles import HALF_TURN_DEG, ZENITH_DEG, Vector, direction_of, turn_deg, unit

_ON_THE_AXIS = 1e-12
"""A direction this near to the azimuth axis has no azimuth."""


@dataclass(frozen=True, slots=True)
class PointingModel:
    ia_deg: float = 0.0
    """How much the azimuth scale reads too much: the boom points counter-clockwise of it."""
    ie_deg: float = 0.0
    """How far the boom points above the reading of the elevation scale."""
    an_deg: float = 0.0
    """How far the azimuth axis, the mast, leans to the north."""
    aw_deg: float = 0.0
    """How far the azimuth axis leans to the west."""
    ca_deg: float = 0.0
    """How far the boom points to the left of square to the elevation axis, seen from behind."""
    npae_deg: float = 0.0
    """How far the elevation axis hangs down on its left, seen from behind: a raised boom leans to the left."""

    @property
    def perfect(self) -> bool:
        return not (self.ia_deg or self.ie_deg or self.an_deg or self.aw_deg or self.ca_deg or self.npae_deg)

    def axis_angles(self, azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
        """What the axes read when the boom points there. Above 90° it points there over the top.

        A boom that is not square to its axis cannot point along the azimuth axis: there it points as near as it can.
        """
        if self.perfect:
            return azimuth_deg, elevation_deg
        over = elevation_deg > ZENITH_DEG
        east, north, up = self._tilted(unit(azimuth_deg, elevation_deg), upright=True)
        square, level = math.radians(-self.ca_deg), math.radians(-self.npae_deg)
        # The boom's height above the plane square to the azimuth axis comes from the elevation alone.
        height = (up + math.sin(square) * math.sin(level)) / (math.cos(square) * math.cos(level))
        raised = math.asin(min(max(height, -1.0), 1.0))
        if over:
            raised = math.pi - raised
        if math.hypot(east, north) > _ON_THE_AXIS:
            ahead, right = self._in_plane(raised)
            azimuth = math.degrees(math.atan2(east, north) - math.atan2(right, ahead))
        else:
            azimuth = azimuth_deg
        axis_azimuth_deg = azimuth + self.ia_deg
        return azimuth_deg + turn_deg(azimuth_deg, axis_azimuth_deg), math.degrees(raised) - self.ie_deg

    def pointed(self, azimuth_deg: float, elevation_deg: float) -> tuple[float, float]:
        """Where the boom points with the axes at these angles: as axes without any error would read there.

        The azimuth is on the same turn, and the elevation is above 90° where the boom is over the top.
        """
        if self.perfect:
            return azimuth_deg, elevation_deg
        sky_azimuth_deg, sky_elevation_deg = direction_of(self.boom(azimuth_deg, elevation_deg))
        if self.over_the_top(elevation_deg):
            sky_azimuth_deg, sky_elevation_deg = sky_azimuth_deg + HALF_TURN_DEG, HALF_TURN_DEG - sky_elevation_deg
        return azimuth_deg + turn_deg(azimuth_deg, sky_azimuth_deg), sky_elevation_deg

    def boom(self, azimuth_deg: float, elevation_deg: float) -> Vector:
        """Where the boom points with the axes at these angles: to the east, to the north and up."""
        azimuth, raised = math.radians(azimuth_deg - self.ia_deg), math.radians(elevation_deg + self.ie_deg)
        square, level = math.radians(-self.ca_deg), math.radians(-self.npae_deg)
        ahead, right = self._in_plane(raised)
        up = math.cos(square) * math.sin(raised) * math.cos(level) - math.sin(square) * math.sin(level)
        sin, cos = math.sin(azimuth), math.cos(azimuth)
        return self._tilted((ahead * sin + right * cos, ahead * cos - right * sin, up), upright=False)

    def over_the_top(self, axis_elevation_deg: float) -> bool:
        """Whether the boom is on the other side of the azimuth axis at this angle of the elevation axis."""
        return axis_elevation_deg + self.ie_deg > ZENITH_DEG + 1e-9

    def _in_plane(self, raised: float) -> tuple[float, float]:
        """The boom's parts square to the azimuth axis: ahead, and to the right."""
        square, level = math.radians(-self.ca_deg), math.radians(-self.npae_deg)
        right = math.sin(square) * math.cos(level) + math.cos(square) * math.sin(raised) * math.sin(level)
        return math.cos(square) * math.cos(raised), right

    def _tilted(self, there: Vector, *, upright: bool) -> Vector:
        """The vector, turned as the azimuth axis leans; `upright`: turned back, as if the azimuth axis stood upright.

        The axis leans without a twist: it turns about the level line square to where it leans.
        """
        lean_deg = math.hypot(self.an_deg, self.aw_deg)
        if not lean_deg:
            return there
        x, y, z = there
        line_x, line_y = -self.an_deg / lean_deg, -self.aw_deg / lean_deg
        lean = math.radians(-lean_deg if upright else lean_deg)
        sin, cos = math.sin(lean), math.cos(lean)
        along = (line_x * x + line_y * y) * (1.0 - cos)
        return (
            x * cos + line_y * z * sin + line_x * along,
            y * cos - line_x * z * sin + line_y * along,
            z * cos + (line_x * y - line_y * x) * sin,
        )


PERFECT = PointingModel()
