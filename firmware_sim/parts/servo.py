"""A simulated hobby servo: it turns to the angle that its pulse means, as fast as it can, and tells nobody.

Knows pulses, its speed, its stops and its jitter. Does not know who makes the pulses.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SimServoSpec:
    low_us: float = 500.0
    high_us: float = 2500.0
    """The pulses that mean `low_deg`, and `range_deg` more."""
    low_deg: float = 0.0
    range_deg: float = 180.0
    slew_dps: float = 60.0
    stop_margin_deg: float = 4.0
    """How far beyond its range the stops in its case stand."""
    jitter_deg: float = 0.1
    """rms, while it holds."""


class SimServo:
    """`pulse_us` tells the width at its wire now (None: no pulse). Call `advance` before that changes."""

    def __init__(
        self, spec: SimServoSpec, start_deg: float, clock: Callable[[], float], pulse_us: Callable[[], float | None]
    ) -> None:
        self.spec = spec
        self.powered = True
        """Fault when False: its own 5 V is missing; it is limp, whatever the pulse."""
        self.stalled = False
        """Fault: something holds it."""
        self.pushed_dps = 0.0
        """Fault: the wind turns it while it is limp."""
        self.strained_s = 0.0
        """How long it has pressed against a stop of its own: what burns a servo."""
        self._shaft_deg = start_deg
        self._clock = clock
        self._pulse_us = pulse_us
        self._now_s = clock()
        self._noise = random.Random(9685)

    def angle_deg(self) -> float:
        """Where it stands now."""
        self.advance()
        jitter_deg = self._noise.gauss(0.0, self.spec.jitter_deg) if self._holds() else 0.0
        return self._shaft_deg + jitter_deg

    def advance(self) -> None:
        """Let time pass up to now, with the pulse as it is."""
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
        way_deg = min(max(wanted_deg, low_deg), high_deg) - self._shaft_deg
        way_s = abs(way_deg) / self.spec.slew_dps
        self._shaft_deg += way_deg if way_s <= past_s else way_deg * past_s / way_s
        if not low_deg <= wanted_deg <= high_deg:
            self.strained_s += max(0.0, past_s - way_s)

    def _holds(self) -> bool:
        return self.powered and self._pulse_us() is not None

    def _wanted_deg(self) -> float:
        width_us = self._pulse_us() or 0.0
        share = (width_us - self.spec.low_us) / (self.spec.high_us - self.spec.low_us)
        return self.spec.low_deg + share * self.spec.range_deg
