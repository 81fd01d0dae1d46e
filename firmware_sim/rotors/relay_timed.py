"""A simulated TV rotator: two motors behind relays, end switches in the rotor, and no wire that comes back.

Knows that such a motor is never quite as fast as its label says: it turns a little slower one way than the other, and a
little differently at each start. Knows no driver: it offers lines in the shape of gpiod. The physics is in `parts`.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, replace

from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.parts.relays import RelayPins
from firmware_sim.rotors.geared import RelayedRotor

TV_MOTOR = MotorSpec(
    speed_dps=6.0, lag_s=0.1, relay_delay_s=0.015, backlash_deg=0.5, stop_low_deg=0.0, stop_high_deg=360.0
)
"""One turn a minute, between two end switches."""
PLUS_PACE, MINUS_PACE = 1.01, 0.985
"""The speed of each direction, as a share of the nominal one."""
VARIES = 0.01
"""By how much, at most, one run is quicker or slower than the next."""


@dataclass(frozen=True, slots=True)
class RelayTimedAxisSpec:
    """One axis: the GPIO numbers of its relays, its motor, and where it stands at first."""

    plus_pin: int
    minus_pin: int
    motor: MotorSpec = TV_MOTOR
    start_deg: float = 0.0
    starts_s: float = 0.0
    """How long the motor takes to start after its contact has closed."""
    seed: int = 0
    brake_pin: int | None = None


class TvMotor(SimMotor):
    """A motor whose speed is only roughly known. Its end switches cut the current at the stops."""

    def __init__(self, spec: RelayTimedAxisSpec, now_s: float) -> None:
        super().__init__(spec.motor, spec.start_deg, now_s)
        self._nominal = spec.motor
        self._starts_s = spec.starts_s
        self._chance = random.Random(spec.seed)

    def coils(self, plus: bool, minus: bool, now_s: float) -> None:
        """A start is late by the time that the motor takes for it; each run has a speed of its own."""
        self.advance(now_s)
        delay_s = self._nominal.relay_delay_s
        if plus or minus:
            pace = (PLUS_PACE if plus else MINUS_PACE) * self._chance.uniform(1 - VARIES, 1 + VARIES)
            delay_s += self._starts_s
            self.spec = replace(self._nominal, speed_dps=self._nominal.speed_dps * pace, relay_delay_s=delay_s)
        else:
            # What has not started yet does not start any more.
            while self._moving_contacts and self._moving_contacts[-1][0] > now_s + delay_s:
                self._moving_contacts.pop()
            self.spec = replace(self.spec, relay_delay_s=delay_s)
        super().coils(plus, minus, now_s)


class RelayTimedAxis:
    """A motor. Only the rotor uses it, under the rotor's lock."""

    def __init__(self, spec: RelayTimedAxisSpec, now_s: float) -> None:
        self.spec = spec
        self.motor: SimMotor = TvMotor(spec, now_s)


class SimRelayTimedRotor(RelayedRotor):
    """`clock` gives seconds; `sleep` lets time pass on the bus (None: transfers take no time)."""

    azimuth: RelayTimedAxis
    elevation: RelayTimedAxis

    def __init__(
        self,
        azimuth: RelayTimedAxisSpec,
        elevation: RelayTimedAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        relays_active_low: bool = False,
        master_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self.azimuth = RelayTimedAxis(azimuth, clock())
        self.elevation = RelayTimedAxis(replace(elevation, seed=elevation.seed + 1), clock())
        pins = RelayPins(
            azimuth.plus_pin,
            azimuth.minus_pin,
            elevation.plus_pin,
            elevation.minus_pin,
            master_pin,
            azimuth.brake_pin,
            elevation.brake_pin,
        )
        self._wire_relays(pins, active_low=relays_active_low)
        self.faults: dict[str, SimFault] = self._motor_faults()
