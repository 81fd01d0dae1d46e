"""The judge of forbidden sectors: the boom is never inside one, coming from outside, by a motor of the box.

Knows the sectors as the configuration has them, on the rotor's own scale. Never asks the box. The wind, a hand and a
welded contact may carry it in; so may a sensor that is wrong by more than the sector's margin.
"""

from __future__ import annotations

from dataclasses import dataclass

from benchmarks.drills.accusations import FORBIDDEN, Violation
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.world import AxisTruth
from rotator.config.model import Config


@dataclass(slots=True)
class _Sector:
    name: str
    low_deg: tuple[float, float]
    high_deg: tuple[float, float]
    margin_deg: float
    excused: bool = True
    """The boom was inside at the start, or something other than the box has carried it in."""

    def holds(self, axes: list[AxisTruth], cases: tuple[AxisCase, AxisCase]) -> bool:
        for truth, case, low_deg, high_deg in zip(axes, cases, self.low_deg, self.high_deg, strict=True):
            unsure_deg = max(0.0, case.slack_deg - self.margin_deg)
            if not low_deg + unsure_deg < truth.boom_deg < high_deg - unsure_deg:
                return False
        return True


class Sectors:
    """Call `look` after every cycle."""

    def __init__(self, config: Config, cases: tuple[AxisCase, AxisCase]) -> None:
        self._cases = cases
        self._sectors = [
            _Sector(
                table.name,
                (table.azimuth_deg[0], table.elevation_deg[0]),
                (table.azimuth_deg[1], table.elevation_deg[1]),
                table.margin_deg,
            )
            for table in config.mount.forbidden
        ]
        self.found: list[Violation] = []

    def __bool__(self) -> bool:
        return bool(self._sectors)

    def look(self, now_s: float, axes: list[AxisTruth]) -> None:
        if not self._sectors:
            return
        carried = any(truth.pushed or truth.welded for truth in axes) or not all(case.trusted for case in self._cases)
        for sector in self._sectors:
            if not sector.holds(axes, self._cases):
                sector.excused = carried
            elif carried:
                sector.excused = True
            elif not sector.excused:
                sector.excused = True
                where = " ".join(f"{truth.boom_deg:.1f}°" for truth in axes)
                self.found.append(Violation(now_s, FORBIDDEN, "both axes", f"{sector.name}: at {where}"))
