"""Degrees between a rotor's own scale and the sky: how an antenna is mounted askew, and which north its scale means.

Knows two numbers and where they are added. Knows no file, no sensor and no rotor. A calibration is kept on the rotor's
own scale; the box works, reports and is ordered in shifted degrees.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis

Points = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Offsets:
    """What is added to an angle on the rotor's own scale to have the angle that the box reports."""

    azimuth_deg: float = 0.0
    elevation_deg: float = 0.0

    def deg(self, axis: Axis) -> float:
        return self.azimuth_deg if axis is Axis.AZIMUTH else self.elevation_deg

    def reported(self, axis: Axis, points: Points) -> Points:
        """A calibration on the rotor's own scale, as the box works with it."""
        return tuple((raw, angle_deg + self.deg(axis)) for raw, angle_deg in points)

    def own_scale(self, axis: Axis, points: Points) -> Points:
        """A calibration as the box works with it, as it is kept: without the shift."""
        return tuple((raw, angle_deg - self.deg(axis)) for raw, angle_deg in points)


def offsets(
    azimuth_offset_deg: float = 0.0, elevation_offset_deg: float = 0.0, declination_deg: float | None = None
) -> Offsets:
    """`declination_deg`, positive to the east, where the azimuth scale was lined up with a compass; None: it was not.

    True north lies west of where the compass points by an easterly declination, so true bearings are that much larger.
    """
    return Offsets(azimuth_offset_deg + (declination_deg or 0.0), elevation_offset_deg)
