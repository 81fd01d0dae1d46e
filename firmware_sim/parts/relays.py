"""A relay board: a relay for each direction of two motors, for their brakes, and a master in the motors' supply.

Knows which line switches which coil, at which level, and how often a motor relay was closed. Knows neither the delay
nor the welding of a contact: `SimMotor` simulates both.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.parts.brake import SimBrake
from firmware_sim.parts.motor import SimMotor


@dataclass(frozen=True, slots=True)
class RelayPins:
    """The lines of the board, as GPIO numbers: plus is clockwise or up, minus is counter-clockwise or down."""

    azimuth_plus: int
    azimuth_minus: int
    elevation_plus: int
    elevation_minus: int
    master: int | None = None
    """Line of the relay in the supply of both motors; None: the motors always have supply."""
    azimuth_brake: int | None = None
    elevation_brake: int | None = None
    """Line of the relay that feeds the solenoid of this brake; None: the axis has none."""


@dataclass(slots=True)
class _MotorRelays:
    motor: SimMotor
    plus_pin: int
    minus_pin: int
    brake_pin: int | None
    plus: bool = False
    minus: bool = False
    """True: the coil has current."""


class SimRelays:
    """Follows the lines of `gpio` and switches the motors. `lock` is the rotor's: parts change only under it.

    `active_low`: a coil has current while its line is low, as on most boards with opto-isolators.
    """

    def __init__(
        self,
        pins: RelayPins,
        gpio: SimGpio,
        motors: tuple[SimMotor, SimMotor],
        now_s: float,
        lock: AbstractContextManager[Any],
        *,
        active_low: bool = False,
    ) -> None:
        self.starts = 0
        """Number of closures of motor relays."""
        self._gpio = gpio
        self._lock = lock
        self._active_low = active_low
        self._master_pin = pins.master
        azimuth, elevation = motors
        self._motors = (
            _MotorRelays(azimuth, pins.azimuth_plus, pins.azimuth_minus, pins.azimuth_brake),
            _MotorRelays(elevation, pins.elevation_plus, pins.elevation_minus, pins.elevation_brake),
        )
        for relays in self._motors:
            relays.motor.brake = SimBrake() if relays.brake_pin is not None else None
        gpio.on_edges.append(self._lines_changed)
        if pins.master is not None:
            self._lines_changed(now_s, {pins.master: gpio.level(pins.master)})

    def drives(self) -> tuple[int, int]:
        """Direction in which the coils switch azimuth and elevation: -1, 0 or 1."""
        with self._lock:
            azimuth, elevation = (int(relays.plus) - int(relays.minus) for relays in self._motors)
            return azimuth, elevation

    def _lines_changed(self, now_s: float, changes: Mapping[int, bool]) -> None:
        with self._lock:
            for relays in self._motors:
                if changed := changes.keys() & {relays.plus_pin, relays.minus_pin}:
                    relays.plus, relays.minus = self._fed(relays.plus_pin), self._fed(relays.minus_pin)
                    relays.motor.coils(relays.plus, relays.minus, now_s)
                    self.starts += sum(self._fed(pin) for pin in changed)
                if relays.motor.brake and relays.brake_pin is not None and relays.brake_pin in changes:
                    relays.motor.advance(now_s)
                    relays.motor.brake.coil(now_s, fed=self._fed(relays.brake_pin))
            if self._master_pin is not None and self._master_pin in changes:
                for relays in self._motors:
                    relays.motor.advance(now_s)
                    relays.motor.supply = self._fed(self._master_pin)

    def _fed(self, pin: int) -> bool:
        return self._gpio.level(pin) != self._active_low
