"""What a calibration can end with. Values only: `saving` knows how they are written into the file."""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis
from rotator.config.mount import SkyRow
from rotator.control.sky.pointing_model import PointingModel


@dataclass(frozen=True, slots=True)
class AxisCalibrated:
    """An axis that is set up. Limits are degrees on the rotor's own scale; the direction has been checked."""

    axis: Axis
    points: tuple[tuple[float, float], ...] | None
    """(reading, degrees) in rising degrees. None: the axis reads degrees and needs no table."""
    min_deg: float
    max_deg: float


@dataclass(frozen=True, slots=True)
class NorthFound:
    """`offset_deg` is the new `azimuth.offset_deg`."""

    offset_deg: float
    uncertainty_deg: float


@dataclass(frozen=True, slots=True)
class MountFound:
    """How the mount really stands, and the points that say so, on the rotor's own scale."""

    model: PointingModel
    points: tuple[SkyRow, ...]


@dataclass(frozen=True, slots=True)
class AngleConfirmed:
    """The controller has accepted the azimuth's angle. There is nothing to save."""

    angle_deg: float


Saved = AxisCalibrated | NorthFound | MountFound
Result = Saved | AngleConfirmed
