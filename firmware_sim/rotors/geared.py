"""What simulated rotors with gears share: where boom and shaft are, a board of relays, and the faults of their motors.

Knows motors and relays. Does not know how a program learns the angle, nor, without relays, what feeds a motor.
"""

from __future__ import annotations

from typing import Protocol

from firmware_sim.faults import SimFault
from firmware_sim.parts.motor import SimMotor
from firmware_sim.parts.relays import RelayPins, SimRelays
from firmware_sim.rotors.rotor import SimRotor

SLOW_PACE = 0.4
"""Fault `motor-slow`: the share of its speed that the motor reaches."""


class GearedAxis(Protocol):
    """An axis whose motor turns the boom through gears with play."""

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

    def _advance(self) -> None:
        now_s = self._clock()
        self.azimuth.motor.advance(now_s)
        self.elevation.motor.advance(now_s)

    def _motor_faults(self) -> dict[str, SimFault]:
        """Both motors can stall, and can be slow."""
        table: dict[str, SimFault] = {}
        for name, motor in (("azimuth", self.azimuth.motor), ("elevation", self.elevation.motor)):
            table |= {
                f"{name}-motor-stalled": self._fault_of(motor, "stalled", True, False),
                f"{name}-motor-slow": self._fault_of(motor, "pace", SLOW_PACE, 1.0),
            }
        return table


class RelayedRotor(GearedRotor):
    """A geared rotor whose motors are switched by relays. A kind calls `_wire_relays` when its motors are there."""

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
        """Beside the motors' own faults: swapped wires, a contact that stays closed, a hand that turns the antenna."""
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
        return table
