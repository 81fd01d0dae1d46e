"""What the configuration says for the guides: about north, and what a calibration at the sky begins with.

Knows which key is which. Points stand in the file on the rotor's own scale, so that a later offset leaves them true.
Knows no chip, no target and no clock.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.assembly.settings import build_mount, build_offsets
from rotator.config.model import Config
from rotator.config.mount import SkyRow
from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.mount import Mount
from rotator.control.sky.offsets import Offsets
from rotator.control.sky.pointing_model import PointingModel


@dataclass(frozen=True, slots=True)
class NorthFacts:
    """About north, for the guide and for the compass at start."""

    offset_deg: float
    """The present `azimuth.offset_deg`."""
    shift_deg: float
    """Added to the rotor's own scale this gives the angle that the box reports: the offset and `[mount] north`."""
    declination_deg: float | None
    """Added to the compass's heading; 0 where the scale is magnetic. None: the file does not say."""
    compass_offset_deg: float = 0.0
    has_file: bool = True
    """There is a file for the compass's corrections."""


def north_facts(config: Config, *, has_file: bool) -> NorthFacts:
    return NorthFacts(
        config.azimuth.offset_deg,
        build_offsets(config).azimuth_deg,
        # With a magnetic scale the mount adds the declination itself.
        0.0 if config.mount.north == "magnetic" else config.mount.declination_deg,
        config.compass.offset_deg,
        has_file=has_file,
    )


@dataclass(frozen=True, slots=True)
class SkyFacts:
    """At the sky: the model in force, its points, the offsets."""

    target: str
    """The name of what the boom is to point at."""
    mount: Mount
    """With the model in force."""
    beam_deg: float
    points: tuple[SkyPoint, ...]
    """The measured points of earlier times."""
    shift: Offsets

    @property
    def model(self) -> PointingModel:
        return self.mount.model

    def own_scale(self, points: tuple[SkyPoint, ...]) -> tuple[SkyRow, ...]:
        """The points as the file keeps them."""
        shift = self.shift
        return tuple(
            (
                point.axis_azimuth_deg - shift.azimuth_deg,
                point.axis_elevation_deg - shift.elevation_deg,
                point.azimuth_deg,
                point.elevation_deg,
            )
            for point in points
        )


def sky_facts(config: Config, target: str) -> SkyFacts:
    shift = build_offsets(config)
    points = tuple(
        SkyPoint(axis_deg + shift.azimuth_deg, raised_deg + shift.elevation_deg, azimuth_deg, elevation_deg)
        for axis_deg, raised_deg, azimuth_deg, elevation_deg in config.mount.model.points
    )
    return SkyFacts(target, build_mount(config), config.station.beam_deg, points, shift)
