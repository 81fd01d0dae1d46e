"""`rotor.type = "relay-timed"`: motors on relays from which nothing comes back, as of old TV rotators.

Knows its table [timed], the lines of [relays], and the answers of this kind to the questions in `kind.py`. Knows no
driver.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.kinds.kind import EndStop, Usual
from rotator.config.kinds.relay_pot import RelayPot
from rotator.config.sensors import Angle
from rotator.config.table import PerAxis, Table


class TimedAxisTable(Table):
    home_deg: float = Field(0.0, ge=-360, le=720)
    """What the scale says at the low end stop."""
    end_deg: float | None = Field(None, ge=-360, le=720)
    """What the scale says at the high end stop; left out: max_deg of the axis."""
    to_high_s: float | None = Field(None, gt=1, le=3600)
    """The time from the low end stop to the high one, by a stopwatch; left out: as speed_dps of the axis says."""
    to_low_s: float | None = Field(None, gt=1, le=3600)
    """The time from the high end stop to the low one."""
    start_s: float = Field(0.0, ge=0, le=2)
    """How long the motor takes to start turning: a run of one second goes shorter by that."""

    def top_deg(self, axis: AxisTable) -> float:
        """The high end stop."""
        return axis.max_deg if self.end_deg is None else self.end_deg

    def faults(self) -> Iterator[str]:
        for key, time_s in (("to_high_s", self.to_high_s), ("to_low_s", self.to_low_s)):
            if time_s is not None and time_s <= self.start_s:
                yield f"{key} ({time_s:g}) must be longer than start_s ({self.start_s:g})"


class Timed(PerAxis, Table):
    speed_error: float = Field(0.02, gt=0, le=0.3)
    """How wrong the times may be, as a share: a motor is slower in the cold, and with wind against it."""
    start_error_deg: float = Field(0.1, ge=0, le=5)
    """What each start of a motor adds to the possible error of the angle."""
    anew_after_deg: float = Field(720.0, ge=0, le=100_000)
    """After so much travel the axis goes to its end stop before the next target that comes after a minute without one.
    A start counts as start_error_deg / speed_error degrees. 0: only `rotator home` sends it there."""
    azimuth: TimedAxisTable = TimedAxisTable.model_construct()
    """The azimuth axis's stops and times."""
    elevation: TimedAxisTable = TimedAxisTable.model_construct()
    """The elevation axis's stops and times."""


@dataclass(frozen=True, slots=True)
class RelayTimed(RelayPot):
    timed: Timed

    own = Angle(AngleSource.MODELLED, sensor="model", by="reckoned by time")
    usual: ClassVar[Usual] = {
        "azimuth": {"max_deg": 360.0, "coast_s": 0.1},
        "elevation": {"speed_dps": 6.0, "coast_s": 0.1},
        "sim.azimuth": {"lag_s": 0.1},
        "sim.elevation": {"speed_dps": 6.0, "lag_s": 0.1},
    }

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterator[str]:
        for axis, limits in axes.items():
            timed = self.timed.of(axis)
            if not timed.home_deg <= limits.min_deg < limits.max_deg <= timed.top_deg(limits):
                yield (
                    f"{axis.value}: min_deg {limits.min_deg:g} to max_deg {limits.max_deg:g} is beyond its end stops, "
                    f"timed.{axis.value}.home_deg {timed.home_deg:g} to end_deg {timed.top_deg(limits):g}"
                )

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        timed = self.timed.of(axis)
        return timed.home_deg, timed.end_deg

    def end_stop(self, axis: Axis, max_deg: float) -> EndStop | None:
        return EndStop(0.0, 0.0, self.timed.of(axis).home_deg, mostly_closed=False, rest_deg=(-math.inf, math.inf))

    def cams(self, axes: Iterable[Axis]) -> dict[Axis, dict[str, object]]:
        return {axis: {"home_deg": self.timed.of(axis).home_deg} for axis in axes}

    def speeds_dps(self, axis: Axis, table: AxisTable) -> tuple[float, float] | None:
        timed = self.timed.of(axis)
        way_deg = timed.top_deg(table) - timed.home_deg
        plus_dps, minus_dps = (
            table.speed_dps if time_s is None else way_deg / (time_s - timed.start_s)
            for time_s in (timed.to_high_s, timed.to_low_s)
        )
        return plus_dps, minus_dps
