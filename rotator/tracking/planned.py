"""What a plan of many passes says: each pass in it, and how the antenna flies it or why it does not.

Knows values alone. Moments are in seconds since 1970 (UTC), places are axis angles on the rotor's own scales.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.control.sky.route import Way
from rotator.control.sky.sectors import Place
from rotator.orbits.passes import Pass
from rotator.orbits.sight import Target

SPARE_S = 15.0
"""The antenna stands waiting so long before its part of a pass begins."""


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
    """The antenna leaves for `wait_deg`, and stands there `SPARE_S` before `begin_s`. A pass that is up already when
    the plan is made begins when the antenna is there."""
    begin_s: float
    end_s: float
    wait_deg: Place
    """Where it waits: azimuth names the turn."""
    over_the_top: bool
    """It begins over the top."""
    lost_s: float
    """For so long the antenna is more than 10° off, because the rotor cannot: it unwinds, or waits at a limit."""

    @property
    def begin_on(self) -> Way:
        """For `plan_flight`."""
        return Way(self.wait_deg[0], self.over_the_top)


@dataclass(frozen=True, slots=True)
class PlannedPass:
    """Plain values, so that another process may have computed it."""

    found: Pass
    priority: float
    flight: Flight | None
    """None: the pass is left out."""
    reason: str = ""
    """Why it is left out, or flown in part."""

    @property
    def name(self) -> str:
        return self.found.name
