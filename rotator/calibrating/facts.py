"""What the configuration says about north, for the guide and for the compass at start. Knows no chip and no rotor."""

from __future__ import annotations

from dataclasses import dataclass

from rotator.assembly.settings import build_offsets
from rotator.config.model import Config


@dataclass(frozen=True, slots=True)
class NorthFacts:
    """What the configuration says about north."""

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
