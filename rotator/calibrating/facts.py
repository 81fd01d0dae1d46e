"""What the configuration says for the guides: about an axis, about north, and about the mount before a calibration at
the sky.

Knows which key is which. Points stand in the file on the rotor's own scale, so that a later offset leaves them true.
Knows no chip, no target and no clock.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Axis
from rotator.assembly.calibration import SCALES_DEG, reach_deg
from rotator.assembly.settings import build_mount, build_offsets
from rotator.calibrating.readings import DEGREES, SHARES, ReadingUnit
from rotator.config.model import Config
from rotator.config.mount import SkyRow
from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.mount import Mount
from rotator.control.sky.offsets import Offsets
from rotator.control.sky.pointing_model import PointingModel

SETTLE_S = 2.0
"""A motor that goes to an angle by itself still moves for 1.5 s: it brakes from 30°/s at 20°/s²."""


@dataclass(frozen=True, slots=True)
class AxisFacts:
    """About an axis that is to be set up; degrees on the rotor's own scale."""

    axis: Axis
    min_deg: float
    max_deg: float
    lowest_reading: float
    highest_reading: float
    least_deg: float = -360.0
    greatest_deg: float = 720.0
    """Where its limits can be."""
    unit: ReadingUnit = SHARES
    settle_s: float = 0.0
    """How long it still moves after its status says that it stands."""
    shift_deg: float = 0.0
    """Added to the rotor's own scale this gives the angle that the box reports."""
    homes: bool = False
    """It counts from its end stop."""
    endless: bool = False
    """It has no ends, and so no limits."""
    first_press: str = ""
    """What the operator must expect of the first press; empty: nothing unusual."""
    reversal: str = ""
    """The repair for an antenna that turns the wrong way; empty: exchange the two relays."""


def axis_facts(config: Config, axis: Axis) -> AxisFacts:
    table, in_degrees = config.axis(axis), config.in_degrees(axis)
    readings = (-math.inf, math.inf) if in_degrees else (table.lowest_reading, table.highest_reading)
    return AxisFacts(
        axis,
        table.min_deg,
        table.max_deg,
        *readings,
        *(reach_deg(config, axis) if in_degrees else SCALES_DEG[axis]),
        unit=DEGREES if in_degrees else SHARES,
        settle_s=0.0 if config.rotor.switched else SETTLE_S,
        shift_deg=build_offsets(config).deg(axis),
        homes=config.end_stop(axis) is not None,
        endless=config.endless(axis),
        first_press=config.kind.first_move(axis),
        reversal=config.kind.reversal(axis),
    )


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
