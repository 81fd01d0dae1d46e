"""What simulated rotors with gears share: the angles of boom and shaft, a relay board, and the faults of the motors.

Knows motors, relays and their faults by name. Does not know which sensor measures the angle, nor which part feeds a
motor without relays.
"""

from __future__ import annotations

from typing import Protocol

from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import SimMotor
from firmware_sim.parts.relays import RelayPins, SimRelays
from firmware_sim.rotors.rotor import SimRotor

SLOW_PACE = 0.4
"""Fault `motor-slow`: the motor's speed as a share of its normal speed."""


class GearedAxis(Protocol):
    """An axis with a motor that turns the boom through gears with backlash."""

    motor: SimMotor


class GearedRotor(SimRotor):
    """A rotor of two geared axes."""

    azimuth: GearedAxis
    elevation: GearedAxis

    def antenna(self) -> tuple[float, float]:
        with self._lock:
            self._advance()
            return self.azimuth.motor.boom_deg, self.elevation.motor.boom_deg

    def shafts(self) -> tuple[float, float]:
        with self._lock:
            self._advance()
            return self.azimuth.motor.shaft_deg, self.elevation.motor.shaft_deg

    @property
    def shorted_s(self) -> float:
        with self._lock:
            self._advance()
            return self.azimuth.motor.shorted_s + self.elevation.motor.shorted_s

    @property
    def brake_harm(self) -> tuple[float, int]:
        with self._lock:
            self._advance()
            brakes = [axis.motor.brake for axis in (self.azimuth, self.elevation) if axis.motor.brake]
            return sum(brake.fed_s for brake in brakes), sum(brake.jolts for brake in brakes)

    def rests(self) -> tuple[float, float]:
        with self._lock:
            self._advance()
            return self.azimuth.motor.rests_deg, self.elevation.motor.rests_deg

    def _advance(self) -> None:
        now_s = self._clock()
        self.azimuth.motor.advance(now_s)
        self.elevation.motor.advance(now_s)

    def _motor_faults(self) -> dict[str, SimFault]:
        """Either motor can stall or be slow."""
        table: dict[str, SimFault] = {}
        for name, motor in (("azimuth", self.azimuth.motor), ("elevation", self.elevation.motor)):
            table |= {
                f"{name}-motor-stalled": self._fault_of(motor, "stalled", True, False),
                f"{name}-motor-slow": self._fault_of(motor, "pace", SLOW_PACE, 1.0),
            }
        return table


class RelayedRotor(GearedRotor):
    """A geared rotor whose relays switch its motors. A kind makes its motors and then calls `_wire_relays`."""

    _relays: SimRelays

    @property
    def relay_starts(self) -> int:
        """How often a motor relay has closed."""
        return self._relays.starts

    def drives(self) -> tuple[int, int]:
        return self._relays.drives()

    def _wire_relays(self, pins: RelayPins, *, active_low: bool) -> None:
        motors = self.azimuth.motor, self.elevation.motor
        self._relays = SimRelays(pins, self.gpio, motors, self._clock(), self._lock, active_low=active_low)

    def _motor_faults(self) -> dict[str, SimFault]:
        """Also swapped wires, a welded contact, a hand that turns the antenna while its motor has no current, and what
        can be wrong with a brake.

        The two `relay-welded` faults of one axis exclude each other.
        """
        table = super()._motor_faults()
        for name, motor, plus, minus in (
            ("azimuth", self.azimuth.motor, "cw", "ccw"),
            ("elevation", self.elevation.motor, "up", "down"),
        ):
            table |= {
                f"{name}-motor-reversed": self._fault_of(motor, "reversed", True, False),
                f"{name}-hand-turns": self._fault_of(motor, "pushed", 1.0, 0.0),
                f"{name}-relay-welded-{plus}": self._fault_of(motor, "welded", 1, 0),
                f"{name}-relay-welded-{minus}": self._fault_of(motor, "welded", -1, 0),
            }
            if motor.brake:
                table |= {
                    f"{name}-brake-stuck": self._fault_of(motor.brake, "stuck", True, False),
                    f"{name}-wedge-sticks": self._fault_of(motor.brake, "sticks", True, False),
                }
        return table
