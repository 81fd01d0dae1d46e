"""What the controller gives a rotor: commands, which expire and are renewed every cycle, and errands, given once.

Knows values. The axes decide on commands; `rotator.rotors` carries them out.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.exchange.orders import LetGo, Stop


@dataclass(frozen=True, slots=True)
class Run:
    """Drive in that direction until the moment `until_s` at the latest."""

    direction: Direction
    until_s: float
    pace: float = 1.0
    """The share of full speed, where an output sets it."""


@dataclass(frozen=True, slots=True)
class Feed:
    """Drive nothing, but keep the motors' supply on until `until_s`: then a welded relay can be seen."""

    until_s: float


@dataclass(frozen=True, slots=True)
class Steer:
    """Be at `angle_deg` now, moving on at `rate_dps`, until the moment `until_s` at the latest."""

    angle_deg: float
    rate_dps: float
    until_s: float


@dataclass(frozen=True, slots=True)
class Seek:
    """Go on to the lower end, by the drive's own means, until the moment `until_s` at the latest."""

    until_s: float


@dataclass(frozen=True, slots=True)
class Hold:
    """Decelerate and stay there."""


@dataclass(frozen=True, slots=True)
class Unfed:
    """Drive nothing, and switch off the supply: a relay of this axis may not have opened."""


HOLD, UNFED = Hold(), Unfed()

Command = Run | Feed | Unfed | Steer | Seek | Hold


@dataclass(frozen=True, slots=True)
class Acknowledge:
    """A person or a stop has acknowledged the fault that the rotor reports on this axis."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class Place:
    """The axis stands at this angle: its end stop was found, or a person has confirmed the angle."""

    axis: Axis
    angle_deg: float


@dataclass(frozen=True, slots=True)
class Turns:
    """The axis is seen to turn, and no relay drives it: its brake waits."""

    axis: Axis


Errand = Acknowledge | Place | Turns | LetGo | Stop


@dataclass(frozen=True, slots=True)
class Decision:
    """What one axis is to do from now on."""

    command: Command
    homed_deg: float | None = None
    """The end stop was found in this cycle, at this angle; None: no end stop was found in this cycle."""
    turns: bool = False
    """An axis with a brake is seen to turn without its motor."""
