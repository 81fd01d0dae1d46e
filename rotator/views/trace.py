"""A flown pass, sample by sample: the target's direction, the antenna's direction, the motors.

Knows angles and the errors between them. Does not know who took the samples: a rehearsal, or the running box.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.angles import great_circle_deg

SETTLING_S = 5.0
"""Seconds at the begin of the pass whose pointing errors do not count: the antenna has to catch up first."""


@dataclass(frozen=True, slots=True)
class Sample:
    """One row of the trace. `t` is in seconds, angles are in degrees.

    Target: the satellite's true direction. Antenna: the boom's direction. Drive: -1, 0 or 1.
    """

    t: float
    target_az: float
    target_el: float
    antenna_az: float
    antenna_el: float
    az_drive: int
    el_drive: int

    @property
    def error_deg(self) -> float:
        return great_circle_deg(self.target_az, self.target_el, self.antenna_az, self.antenna_el)


def errors_deg(trace: Sequence[Sample]) -> list[float]:
    """The errors that count, the smallest first: while the target is above the horizon, after `SETTLING_S`."""
    return sorted(sample.error_deg for sample in trace if sample.t >= SETTLING_S and sample.target_el >= 0)


def p95(rising: Sequence[float]) -> float:
    """The value that one in twenty exceeds. `rising`: the smallest first."""
    return rising[min(len(rising) - 1, math.ceil(0.95 * len(rising)) - 1)]


def rms(values: Sequence[float]) -> float:
    return math.sqrt(sum(value * value for value in values) / len(values))
