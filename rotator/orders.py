"""What anybody may ask of the box: the nouns that travel from links to the controller.

Knows the orders and nothing of who sends them or what becomes of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from hw.ports import Axis, Direction

BOTH = (Axis.AZIMUTH, Axis.ELEVATION)


@dataclass(frozen=True, slots=True)
class Aim:
    """Point there. An axis that is None keeps what it was doing.

    Azimuth above 360 names the turn of the overlap; elevation above 90 is an antenna flipped by the program that sends
    it. Not `engaged`: show the target, but stop the motors.
    """

    azimuth_deg: float | None
    elevation_deg: float | None
    engaged: bool = True


@dataclass(frozen=True, slots=True)
class Jog:
    """Turn one axis until stopped, until its limit, or for `seconds`."""

    axis: Axis
    direction: Direction
    seconds: float | None = None


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop these axes now and forget their targets; a stop of both acknowledges faults."""

    axes: tuple[Axis, ...] = BOTH
    latch: bool = False
    """From the console, the panel or the page: nothing moves until a person releases it there."""


@dataclass(frozen=True, slots=True)
class Release:
    """A person lets the box move again after a latching stop or a fault."""


@dataclass(frozen=True, slots=True)
class Park:
    """Go to the park position."""

    storm: bool = False
    """From a person: go there whatever else is going on, and stay until released."""


@dataclass(frozen=True, slots=True)
class LoadTimed:
    """Take a list of points (azimuth, elevation or None) to be visited every `interval_s`; aim at the first now."""

    interval_s: float
    points: tuple[tuple[float, float | None], ...]

    def __post_init__(self) -> None:
        if not self.points or self.interval_s <= 0:
            raise ValueError("a timed list has points, and time between them")


@dataclass(frozen=True, slots=True)
class ClearTimed:
    """Forget the timed list."""


@dataclass(frozen=True, slots=True)
class RunTimed:
    """Run the timed list from its present point."""


@dataclass(frozen=True, slots=True)
class Calibrate:
    """The axis now stands at the low (or high) end of its range: take the sensor's reading for it."""

    axis: Axis
    high_end: bool


@dataclass(frozen=True, slots=True)
class Speed:
    """GS-232 X1 to X4. A relay has one speed: remembered, shown, without effect there."""

    level: int


class Mode(Enum):
    """Who may move the antenna, as a front panel's switch says."""

    AUTO = "auto"
    """The links, with the panel's nudges added."""
    MANUAL = "manual"
    """The panel's knobs alone."""
    JOG = "jog"
    """The panel's jog switches alone."""
    PARK = "park"
    """Nobody: the antenna stays where it is."""


@dataclass(frozen=True, slots=True)
class SetMode:
    """A person at the panel says who may move the antenna from now on; it stops, and the nudges are forgotten."""

    mode: Mode


@dataclass(frozen=True, slots=True)
class Nudge:
    """Everything asked for on this axis is meant so much further on, until the mode changes."""

    axis: Axis
    offset_deg: float


@dataclass(frozen=True, slots=True)
class Home:
    """Find the low end stop of an axis that counts. Only a person asks for it, and watches."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class Confirm:
    """A person says that the axis stands at this angle, in true degrees as the status reports them."""

    axis: Axis
    angle_deg: float


@dataclass(frozen=True, slots=True)
class LetGo:
    """Motors without torque: only a person asks for it, for an antenna that is out of balance turns."""


Personal = SetMode | Nudge | Home | Confirm | LetGo
"""What only somebody at the box may ask for: at its panel, or on its console."""

Order = Aim | Jog | Stop | Release | Park | LoadTimed | ClearTimed | RunTimed | Calibrate | Speed | Personal


@dataclass(frozen=True, slots=True)
class Source:
    """Who sends orders: a link, and which connection on it. A reconnect is a new source."""

    link: str
    connection: int = 0

    def __str__(self) -> str:
        return f"{self.link}#{self.connection}" if self.connection else self.link


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an order is not obeyed, for the log; the protocol has its own words for it."""

    reason: str
    forbidden: bool = False
    """It is not this order: the sender may give none."""
