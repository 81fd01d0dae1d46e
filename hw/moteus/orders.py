"""What is said to a moteus controller and what it answers, as values; and how degrees become its revolutions.

Knows units and modes. Knows neither when anything is said nor how it travels.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

WATCHDOG_S = 0.5
"""The controller stops by itself when it has heard nothing for so long."""


class Mode(IntEnum):
    STOPPED = 0
    FAULT = 1
    POSITION = 10
    TIMEOUT = 11


class Home(IntEnum):
    """What the controller knows of its position: nothing, its share of a rotor turn, or all."""

    RELATIVE = 0
    ROTOR = 1
    OUTPUT = 2


@dataclass(frozen=True, slots=True)
class MoteusSpec:
    """One axis: its controller and the way from degrees to the controller's revolutions."""

    can_id: int
    rev_per_turn: float = 1.0
    """Revolutions of the controller for 360° of the antenna; below 0 it runs the other way."""
    zero_rev: float = 0.0
    """What the controller shows where the rotor's scale says 0°."""
    velocity_limit_dps: float = 30.0
    accel_limit_dps2: float = 20.0
    max_torque_nm: float = math.nan
    """NaN: as configured in the controller."""
    geared: bool = True
    """Its only encoder sits before a gear: at power-on it does not know which turn of the rotor it is in."""

    def revolutions(self, angle_deg: float) -> float:
        return self.zero_rev + angle_deg / 360 * self.rev_per_turn

    def degrees(self, position_rev: float) -> float:
        return (position_rev - self.zero_rev) / self.rev_per_turn * 360

    def span_rev(self, degrees: float) -> float:
        """A distance, a speed or an acceleration, without its sign."""
        return abs(degrees / 360 * self.rev_per_turn)


@dataclass(frozen=True, slots=True)
class Look:
    """Say how you are; this does not feed the watchdog."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Let go of the motor, and forget faults."""


@dataclass(frozen=True, slots=True)
class SetOutput:
    """You stand at `position_rev`: exactly, or at the nearest place that agrees with the rotor's encoder."""

    position_rev: float
    exactly: bool


@dataclass(frozen=True, slots=True)
class Move:
    """Be at `position_rev` now, moving on. NaN: from wherever you are, come to that speed and keep it."""

    position_rev: float
    velocity_rev_s: float


Order = Look | Stop | SetOutput | Move


@dataclass(frozen=True, slots=True)
class Answer:
    mode: int
    position_rev: float
    velocity_rev_s: float
    volts: float
    temperature_c: float
    fault: int
    home: int
