"""Orders to a moteus controller and its answers, as values; and how degrees become its revolutions.

Knows units and modes (mjbots, "moteus reference"). Does not know when an order is sent, nor by which library.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

WATCHDOG_S = 0.5
"""Seconds without an order, after which the controller decelerates and stops by itself."""


class Mode(IntEnum):
    """The values of the controller's mode register that this driver uses."""

    STOPPED = 0
    FAULT = 1
    POSITION = 10
    TIMEOUT = 11


class Home(IntEnum):
    """The controller's knowledge of its position: none, the angle within a rotor turn, or the output's position."""

    RELATIVE = 0
    ROTOR = 1
    OUTPUT = 2


@dataclass(frozen=True, slots=True)
class MoteusSpec:
    """One axis: its controller's CAN id and limits, and how degrees become the controller's revolutions."""

    can_id: int
    rev_per_turn: float = 1.0
    """Revolutions of the controller for 360° of the antenna; below 0 it runs the other way."""
    zero_rev: float = 0.0
    """The controller's position at 0° of the rotor's own scale."""
    velocity_limit_dps: float = 30.0
    accel_limit_dps2: float = 20.0
    max_torque_nm: float = math.nan
    """NaN: as configured in the controller."""
    geared: bool = True
    """Whether the only encoder is before a gear: then the controller does not know the gear's turn at power-on."""
    min_deg: float = 0.0
    max_deg: float = 360.0
    """The axis's range. It shows in which turn the antenna stands."""
    endless: bool = False
    """It has no range, and every turn is as good as another."""

    def revolutions(self, angle_deg: float) -> float:
        """The controller's position at that angle."""
        return self.zero_rev + angle_deg / 360 * self.rev_per_turn

    def degrees(self, position_rev: float) -> float:
        """The angle at that position of the controller."""
        return (position_rev - self.zero_rev) / self.rev_per_turn * 360

    def turns_deg(self, angle_deg: float, beyond_deg: float) -> list[float]:
        """Each angle in the range, or up to `beyond_deg` beyond it, at which the antenna points as at `angle_deg`."""
        if self.endless:
            return [angle_deg]
        least = math.ceil((self.min_deg - beyond_deg - angle_deg) / 360)
        most = math.floor((self.max_deg + beyond_deg - angle_deg) / 360)
        return [angle_deg + 360 * turn for turn in range(least, most + 1)]

    def span_rev(self, degrees: float) -> float:
        """A distance, a speed or an acceleration of the antenna in the controller's unit, without its sign."""
        return abs(degrees / 360 * self.rev_per_turn)


@dataclass(frozen=True, slots=True)
class Query:
    """Ask for an answer only. This does not restart the watchdog."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Take the torque away, and clear faults."""


@dataclass(frozen=True, slots=True)
class SetOutput:
    """Call the present position `position_rev`: `exactly`, or the nearest value that agrees with the encoder."""

    position_rev: float
    exactly: bool


@dataclass(frozen=True, slots=True)
class Move:
    """Be at `position_rev` now, moving on at `velocity_rev_s`. Position NaN: only the speed counts, from anywhere."""

    position_rev: float
    velocity_rev_s: float


Order = Query | Stop | SetOutput | Move


@dataclass(frozen=True, slots=True)
class Answer:
    """The registers of one reply."""

    mode: int
    position_rev: float
    velocity_rev_s: float
    volts: float
    temperature_c: float
    fault: int
    home: int
