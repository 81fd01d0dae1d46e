"""A simulated hobby servo: it turns to the angle of its pulse as fast as it can, and reports nothing.

Knows its pulse, its speed, its stops, its jitter, and three faults: its supply fails, an obstacle holds it, the wind
turns it while it has no torque. Does not know which chip makes the pulses. Not simulated: acceleration, overshoot, and
the dead band of its controller.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SimServoSpec:
    """The true properties of the servo. A driver's settings may differ from them."""

    low_us: float = 500.0
    """The pulse for `low_deg`."""
    high_us: float = 2500.0
    """The pulse for `low_deg` + `range_deg`."""
    low_deg: float = 0.0
    range_deg: float = 180.0
    slew_dps: float = 60.0
    stop_margin_deg: float = 4.0
    """How far beyond its range its mechanical stops are."""
    jitter_deg: float = 0.1
    """Jitter while it holds, rms."""


class SimServo:
    """`pulse_us` gives the present width of its pulse (None: no pulse). Call `advance` before the pulse changes.

    Without a pulse or without supply a servo has no torque.
    """

    def __init__(
        self, spec: SimServoSpec, start_deg: float, clock: Callable[[], float], pulse_us: Callable[[], float | None]
    ) -> None:
        self.spec = spec
        self.powered = True
        """Fault when False: its own 5 V supply fails. It then has no torque even with a pulse."""
        self.stalled = False
        """Fault: an obstacle holds the shaft."""
        self.pushed_dps = 0.0
        """Fault: the speed at which the wind turns it while it has no torque."""
        self.strained_s = 0.0
        """Total time for which it pressed against one of its stops, which burns a servo."""
        self._shaft_deg = start_deg
        self._clock = clock
        self._pulse_us = pulse_us
        self._now_s = clock()
        self._noise = random.Random(9685)

    def angle_deg(self) -> float:
        """Its present angle, with jitter."""
        self.advance()
        jitter_deg = self._noise.gauss(0.0, self.spec.jitter_deg) if self._holds() else 0.0
        return self._shaft_deg + jitter_deg

    def shaft_deg(self) -> float:
        """Its present angle without the jitter."""
        self.advance()
        return self._shaft_deg

    def advance(self) -> None:
        """Move it up to the present moment, with the present pulse."""
        now_s = self._clock()
        past_s, self._now_s = now_s - self._now_s, now_s
        if past_s <= 0 or self.stalled:
            return
        low_deg = self.spec.low_deg - self.spec.stop_margin_deg
        high_deg = self.spec.low_deg + self.spec.range_deg + self.spec.stop_margin_deg
        if not self._holds():
            self._shaft_deg = min(max(self._shaft_deg + self.pushed_dps * past_s, low_deg), high_deg)
            return
        wanted_deg = self._wanted_deg()
        left_deg = min(max(wanted_deg, low_deg), high_deg) - self._shaft_deg
        needed_s = abs(left_deg) / self.spec.slew_dps
        self._shaft_deg += left_deg if needed_s <= past_s else left_deg * past_s / needed_s
        if not low_deg <= wanted_deg <= high_deg:
            self.strained_s += max(0.0, past_s - needed_s)

    def _holds(self) -> bool:
        return self.powered and self._pulse_us() is not None

    def _wanted_deg(self) -> float:
        width_us = self._pulse_us() or 0.0
        share = (width_us - self.spec.low_us) / (self.spec.high_us - self.spec.low_us)
        return self.spec.low_deg + share * self.spec.range_deg
