"""The orders: what a link, the panel or a person may ask of the box.

Knows the orders as values. Does not know who sends them, nor what they do. The order of a planned pass is in
`flight_order`, the senders are in `sources`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from hw.ports import Axis, Direction
from rotator.exchange.flight_order import Fly, TakeTurn

BOTH = (Axis.AZIMUTH, Axis.ELEVATION)
S_BEFORE_P_S = 0.3
"""A logger sends a stop before each of its directions, some milliseconds earlier. A direction that follows the stop of
the same connection within this time goes on with its stream. No person is that fast."""


@dataclass(frozen=True, slots=True)
class Aim:
    """Point in this direction. An axis that is None keeps its motion or target.

    Azimuth above 360 names the turn of the overlap; elevation above 90 is an antenna flipped by the program that sends
    it. Not `engaged`: show the target, but stop the motors. `place`: rest there, and one coordinate alone is the axis's
    own angle; without it the orders of a stream are points of a path, which the antenna follows between them.
    """

    azimuth_deg: float | None
    elevation_deg: float | None
    engaged: bool = True
    place: bool = False


@dataclass(frozen=True, slots=True)
class Jog:
    """Turn one axis until stopped, until its limit, or for `seconds`."""

    axis: Axis
    direction: Direction
    seconds: float | None = None
    held: bool = False
    """Whether a person holds a button over a network. The time counts from the order, also while a relay waits,
    because no later order may come. OFF: the button is released, which ends only this sender's own jog."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop these axes now and forget their targets; a stop of both acknowledges faults."""

    axes: tuple[Axis, ...] = BOTH
    latch: bool = False
    """Whether the stop stays until a person releases it: from the console, the panel or the page."""


@dataclass(frozen=True, slots=True)
class Release:
    """A person lets the box move again after a latching stop or a fault."""


@dataclass(frozen=True, slots=True)
class Park:
    """Go to the park position."""

    storm: bool = False
    """Whether a person ordered a storm park: end everything, go there now, and stay until a person releases the box."""


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
    """Run the timed list: turn to its next point now."""


@dataclass(frozen=True, slots=True)
class Calibrate:
    """The axis now stands at the low (or high) end of its range: take the sensor's reading for it."""

    axis: Axis
    high_end: bool


@dataclass(frozen=True, slots=True)
class Speed:
    """GS-232 X1 to X4: the highest speed of a motor with a speed output. Any other has one speed: there it is only
    remembered and shown."""

    level: int


class Mode(Enum):
    """Which source may move the antenna: the position of the mode switch on a front panel or on the page."""

    AUTO = "auto"
    """The links, with the panel's nudges added."""
    MANUAL = "manual"
    """Only the panel's knobs, or the person who set the mode."""
    JOG = "jog"
    """Only the panel's jog switches, or the held buttons of the person who set the mode."""
    PARK = "park"
    """No source: the antenna stays where it is."""


@dataclass(frozen=True, slots=True)
class SetMode:
    """A person turns the mode switch: the antenna stops, and the nudges are forgotten."""

    mode: Mode


@dataclass(frozen=True, slots=True)
class Nudge:
    """Shift each order for this axis by this angle, until the mode changes."""

    axis: Axis
    offset_deg: float
    of_pass: bool = False
    """Only the target in force is shifted, and no later one. It is added to the shift that lasts."""


@dataclass(frozen=True, slots=True)
class Home:
    """Find the low end stop of an axis that counts. A person orders it, and watches."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class Confirm:
    """A person confirms that the axis stands at this angle, in true degrees as the status reports them."""

    axis: Axis
    angle_deg: float


@dataclass(frozen=True, slots=True)
class RelaysChecked:
    """A person has looked at both relays of this axis, and they are open. The box itself could not see that."""

    axis: Axis


@dataclass(frozen=True, slots=True)
class LetGo:
    """Take the torque from the motors. A person orders it, because an antenna out of balance then turns."""


@dataclass(frozen=True, slots=True)
class Remark:
    """A notice of the panel about this axis, for its status. It stops nothing. Without text it ends the notice."""

    axis: Axis
    text: str = ""
    lcd: str = ""
    """13 characters at most."""


@dataclass(frozen=True, slots=True)
class Leave:
    """The sender's connection has ended: its jog without a time and its stream end with it."""


@dataclass(frozen=True, slots=True)
class Unheeded:
    """This order was refused because of the state of an axis. It moves nothing, but its sender has not paused."""

    order: Order


@dataclass(frozen=True, slots=True)
class Take:
    """A person takes the antenna: it stops, and the person holds it until `GiveBack`. Programs' orders have no effect.

    Not `stops`: this person's own motion or tracking goes on.
    """

    stops: bool = True


@dataclass(frozen=True, slots=True)
class GiveBack:
    """A person lets the programs move the antenna again."""


Personal = SetMode | Nudge | Home | Confirm | RelaysChecked | LetGo | Remark | Take | GiveBack
"""Orders that only a person at the panel or on the console may give."""

Pointing = Aim | Fly | LoadTimed | RunTimed | Park
"""Orders that point the antenna somewhere."""

Order = Pointing | Jog | Stop | Release | ClearTimed | Calibrate | Speed | Leave | Unheeded | TakeTurn | Personal
