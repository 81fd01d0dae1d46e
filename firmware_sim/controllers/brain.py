"""One axis of a simulated controller: it turns its motor until its own sensor shows the target. And its knob.

Knows a motor, a target, and how far the motor coasts. Knows no bytes. Not simulated: ramps, and a second approach.
"""

from __future__ import annotations

from firmware_sim.parts.motor import SimMotor

TICK_S = 0.02
"""The controller looks at its sensor this often."""
DEAD_BAND_DEG = 0.3
"""It does not start its motor for less."""


class SimBrain:
    """`step_deg`: it measures in steps of this."""

    def __init__(self, motor: SimMotor, step_deg: float, now_s: float) -> None:
        self.motor = motor
        self.step_deg = step_deg
        self.target_deg: float | None = None
        self.knob = 0
        """Fault: a person turns it at the controller: -1, 0, 1. That takes its target away."""
        self.jump_deg = 0.0
        """Fault: its sensor shows an angle that is off by this."""
        self.starts = 0
        self._driven = 0
        self._now_s = now_s

    @property
    def angle_deg(self) -> float:
        """What it tells."""
        return round((self.motor.shaft_deg + self.jump_deg) / self.step_deg) * self.step_deg

    def go(self, target_deg: float) -> None:
        if not self.knob:
            self.target_deg = min(max(target_deg, self.motor.stop_low_deg), self.motor.stop_high_deg)

    def stop(self) -> None:
        self.target_deg = None
        self._decide()

    def advance(self, now_s: float) -> None:
        while self._now_s < now_s:
            self._decide()
            # Between two ticks nothing changes; at rest none needs to be looked at.
            idle = self._driven == 0 and self.target_deg is None and not self.knob
            self._now_s = now_s if idle else min(self._now_s + TICK_S, now_s)
            self.motor.advance(self._now_s)

    def _decide(self) -> None:
        wanted = self.knob
        if self.knob:
            self.target_deg = None
        elif self.target_deg is not None:
            wanted = self._towards(self.target_deg)
            if not wanted:
                self.target_deg = None
        if wanted != self._driven:
            self._driven = wanted
            self.starts += wanted != 0
            self.motor.coils(wanted > 0, wanted < 0, self._now_s)

    def _towards(self, target_deg: float) -> int:
        error_deg = target_deg - self.motor.shaft_deg - self.jump_deg
        spec = self.motor.spec
        coasts_deg = self.motor.speed_dps * (spec.lag_s + spec.relay_delay_s + TICK_S / 2)
        if self._driven:
            return self._driven if (error_deg - coasts_deg) * self._driven > 0 else 0
        return 0 if abs(error_deg) <= DEAD_BAND_DEG else 1 if error_deg > 0 else -1
