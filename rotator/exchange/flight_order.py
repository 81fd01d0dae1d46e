"""The order to fly a pass: the target's path, the plan of each axis, and the program's stream that the flight replaces.

Knows these as values, on the control loop's clock. Does not know how a pass is planned, nor how it is flown.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Step:
    """At this time a motor on relays starts for this angle on the axis's own scale."""

    leave_s: float
    place_deg: float


PLAN_STEP_S = 0.5
"""The time between two angles of an `AxisPlan`."""


@dataclass(frozen=True, slots=True)
class AxisPlan:
    """How one axis flies a pass: its angles every `PLAN_STEP_S` from `begin_s` on.

    `steps`: those of a motor on relays; empty for one that goes to every angle by itself.
    """

    begin_s: float
    angles_deg: tuple[float, ...]
    steps: tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class Stream:
    """A program's orders, recognised as a satellite's path. `rounding_deg`: 1 for whole degrees."""

    rounding_deg: float
    ahead_s: tuple[float, float]
    """The least and the largest lead of the program's clock over the true time, in seconds."""


@dataclass(frozen=True, slots=True)
class TakeTurn:
    """Follow the sender's stream on this turn, which the pass needs for whose rise it waits at the horizon.

    Ignored where the latest order is another sender's, or is not near this place.
    """

    azimuth_deg: float
    """On the axis's own scale."""
    flipped: bool
    """Over the top."""
    until_s: float
    """The stream stays on it until then, on the control loop's clock."""


@dataclass(frozen=True, slots=True)
class Fly:
    """Fly a pass that is known to its end, as planned. Times are on the control loop's clock."""

    name: str
    path: tuple[tuple[float, float, float], ...]
    """The target's directions: (moment in s, azimuth, elevation), rising, two or more."""
    azimuth: AxisPlan
    elevation: AxisPlan
    rises_s: float | None = None
    """When the target rises or has risen, if that is before the beginning of the path."""
    sets_s: float | None = None
    """When the target sets, if that is after the end of the path; infinite: it does not set."""
    expected_error_deg: float = 0.0
    """Largest possible distance of the target from its path."""
    beyond_beam: bool = False
    """Whether that distance is more than half of the antenna's beam."""
    table: bool = False
    """Whether the path is a person's table."""
    stream: Stream | None = None
    """The sender's own stream, which this flight replaces while the orders agree. None: no stream."""
