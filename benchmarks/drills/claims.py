"""Angles that are not so: the box shows one, or one with its ±, the axis rests elsewhere, and nothing befell it.

Knows what the box shows of an axis, and for how long. Like `silence` it listens to the box. Which trouble excuses an
axis is in `scene`. An angle that is modelled without a ± is not judged: nothing comes back, and it says so.
"""

from __future__ import annotations

from benchmarks.drills.accusations import LOOK_S, NOT_SO, Violation
from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.world import STANDS_DPS, AxisTruth
from hw.ports import AngleSource, Axis
from rotator.exchange.status import AxisStatus, Status

NOT_SO_S = 3.0


class Claims:
    """Call `look` after every cycle."""

    def __init__(self, cases: tuple[AxisCase, AxisCase]) -> None:
        self._cases = cases
        self._rested_s = dict.fromkeys(Axis, 0.0)
        self._looked_s = 0.0
        self.found: list[Violation] = []

    def look(self, now_s: float, axes: list[AxisTruth], status: Status) -> None:
        past_s, self._looked_s = now_s - self._looked_s, now_s
        for axis, truth, case in zip(Axis, axes, self._cases, strict=True):
            shown = status.axis(axis)
            rests = abs(truth.speed_dps) < STANDS_DPS and not truth.power and not case.befallen
            off_deg = _off_deg(shown, truth.shaft_deg + case.shift_deg)
            allowed_deg = case.slack_deg + (shown.error_deg if shown.error_deg is not None else case.tolerance_deg)
            wrong = rests and off_deg is not None and off_deg > allowed_deg
            self._rested_s[axis] = self._rested_s[axis] + past_s if wrong else 0.0
            if self._rested_s[axis] > NOT_SO_S + LOOK_S and not self.found:
                measured = f"{shown.angle_deg:.1f}°{shown.error_text}, {off_deg:.1f}° from where it rests"
                self.found.append(Violation(now_s, NOT_SO, axis.value, measured))


def _off_deg(shown: AxisStatus, truth_deg: float) -> float | None:
    """How far the axis is from the angle that is shown as known; None: none is."""
    modelled = shown.source is AngleSource.MODELLED and shown.error_deg is None
    doubted = shown.missing or shown.fault or shown.homing or not shown.seen or modelled
    return None if doubted or shown.angle_deg is None else abs(shown.angle_deg - truth_deg)
