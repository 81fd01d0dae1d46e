"""The plan of many passes: each pass, and how the antenna flies it, or why it does not.

Knows only values. Times are in seconds since 1970 (UTC), places are axis angles on the rotor's own scales.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.control.sky.route import Way
from rotator.control.sky.sectors import Place
from rotator.orbits.passes import Pass
from rotator.orbits.sight import Target

SPARE_S = 15.0
"""Seconds that the antenna waits in place before its part of a pass begins."""


@dataclass(frozen=True, slots=True)
class Followed:
    """A target whose passes are wanted: one `[[sky.follow]]` of the configuration."""

    target: Target
    priority: float = 1.0
    """A minute of a target with priority 2 is worth two minutes of one with priority 1."""
    min_culmination_deg: float = 0.0
    """Passes that stay lower are left out."""


@dataclass(frozen=True, slots=True)
class Flight:
    """The part of a pass that the antenna flies: all of it, unless another pass takes its beginning or its end."""

    set_off_s: float
    """When the antenna leaves for `wait_deg`. It stands there `SPARE_S` before `begin_s`. A pass that is already up
    when the plan is made begins when the antenna is there."""
    begin_s: float
    end_s: float
    wait_deg: Place
    """The place where it waits: azimuth names the turn."""
    over_the_top: bool
    """Whether the pass begins over the top."""
    lost_s: float
    """How long the antenna is more than 10° off: it unwinds, or waits at a limit."""

    @property
    def begin_on(self) -> Way:
        """The first way, for `plan_flight`."""
        return Way(self.wait_deg[0], self.over_the_top)


@dataclass(frozen=True, slots=True)
class PlannedPass:
    """Holds plain values only, so that another process can compute it."""

    found: Pass
    priority: float
    flight: Flight | None
    """None: the pass is left out."""
    reason: str = ""
    """Why it is left out or flown in part."""

    @property
    def name(self) -> str:
        return self.found.name
