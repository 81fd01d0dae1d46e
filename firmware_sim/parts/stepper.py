"""A simulated stepper with its gear, between two stops: it follows the field of its coils, or falls out of step.

Knows the field as an angle that the chip turns, that a rotor finds its field again each four full steps, and that a
self-locking gear stands without current. Does not know what makes the field. Not simulated: torque over speed, and
resonance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

TURN_OF_FIELD = 4 * 256
"""Four full steps, in microsteps."""


@dataclass(frozen=True, slots=True)
class StepperMotorSpec:
    """`gear`: turns of the motor for one of the antenna; negative: the motor is mounted the other way round."""

    start_deg: float = 0.0
    gear: float = 54.0
    steps_per_turn: int = 200
    low_deg: float = -1.0
    high_deg: float = 361.0
    """Where its stops are."""
    encoder: int = 0
    """Counts for a turn of the motor; 0: it has none."""
    self_locking: bool = True


class SimStepper:
    """`turn` says where its field is now, and whether its coils have current."""

    def __init__(self, spec: StepperMotorSpec) -> None:
        self.spec = spec
        self.held = False
        """Fault: something holds the antenna."""
        self._per_deg = spec.gear * spec.steps_per_turn * 256 / 360.0
        self._at = spec.start_deg * self._per_deg
        """Of the motor's shaft, in microsteps."""
        self._ahead = 0.0
        """From the field to the shaft, in whole turns of the field."""
        self._fed = False
        self.pressed = False
        """The field has gone on where the shaft could not."""

    @property
    def angle_deg(self) -> float:
        return self._at / self._per_deg

    @property
    def counts(self) -> int:
        """Of its encoder."""
        return math.floor(self._at * self.spec.encoder / (self.spec.steps_per_turn * 256))

    def put(self, angle_deg: float) -> None:
        """A hand has turned it there."""
        self._at, self._fed = angle_deg * self._per_deg, False

    def turn(self, field: float, *, fed: bool) -> None:
        if not fed:
            self._fed = self.pressed = False
            return
        if not self._fed:
            self._fed = True
            self._lock_on(field)
        wanted = field + self._ahead
        ends = sorted((self.spec.low_deg * self._per_deg, self.spec.high_deg * self._per_deg))
        able = self._at if self.held else min(max(wanted, ends[0]), ends[1])
        self.pressed = able != wanted
        self._at = able
        if abs(wanted - able) > TURN_OF_FIELD / 2:
            self._lock_on(field)

    def _lock_on(self, field: float) -> None:
        self._ahead = TURN_OF_FIELD * round((self._at - field) / TURN_OF_FIELD)
