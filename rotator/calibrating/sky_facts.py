"""What a calibration at the sky begins with, from the configuration: the model in force, its points, the offsets.

Knows which key is which. Points stand in the file on the rotor's own scale, so that a later offset leaves them true.
Knows no target and no clock.
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
class SkyFacts:
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
