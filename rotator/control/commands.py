"""What the controller tells a rotor: commands, which expire and are told anew every cycle, and errands, told once.

Knows values. Who makes them and who obeys are elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.orders import LetGo


@dataclass(frozen=True, slots=True)
class Run:
    """Drive that way until that moment at the latest."""

    direction: Direction
    until_s: float


@dataclass(frozen=True, slots=True)
class Steer:
    """Be at that angle now, moving on at that rate, until that moment at the latest."""

    angle_deg: float
    rate_dps: float
    until_s: float


@dataclass(frozen=True, slots=True)
class Hold:
    """Stay where you come to rest."""


HOLD = Hold()

Command = Run | Steer | Hold


@dataclass(frozen=True, slots=True)
class Acknowledge:
    """A person or a stop has taken note of what the rotor says is wrong with the axis."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class Place:
    """The axis stands at that angle, says its end stop or a person: its reading did not know."""

    axis: Axis
    angle_deg: float


Errand = Acknowledge | Place | LetGo
