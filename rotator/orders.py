"""The orders: what a link, the panel or a person may ask of the box.

Knows the orders as values. Does not know who sends them, nor what they do.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from hw.ports import Axis, Direction

BOTH = (Axis.AZIMUTH, Axis.ELEVATION)


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
class Step:
    """At this time a motor on relays starts for this angle on the axis's own scale."""

    leave_s: float
    place_deg: float


PLAN_STEP_S = 0.5
"""The time between two angles of an `AxisPlan`."""


@dataclass(frozen=True, slots=True)
class AxisPlan:
    """How one axis flies a pass: its angles every `PLAN_STEP_S` from `begin_s` on.

    `steps`: those of a motor on relays; empty for one that goes to every angle by itself.
    """

    begin_s: float
    angles_deg: tuple[float, ...]
    steps: tuple[Step, ...]


DEPARTS_DEG = 1.5
"""Degrees beside the rounding: an order further from the satellite's path ends the match of its stream."""
BEARS_OUT_DEG = 0.5
"""Degrees beside the rounding: if the assumed clock error is right, the orders lie this near to the path."""


@dataclass(frozen=True, slots=True)
class Stream:
    """A program's orders, recognised as a satellite's path. `rounding_deg`: 1 for whole degrees."""

    rounding_deg: float
    ahead_s: tuple[float, float]
    """The least and the largest lead of the program's clock over the true time, in seconds."""

    @property
    def departs_deg(self) -> float:
        """Degrees: an order further from the path is not for this satellite."""
        return self.rounding_deg + DEPARTS_DEG

    def narrowed(self, apart_deg: Mapping[float, float]) -> tuple[float, ...]:
        """The clock errors that agree with the latest order. `apart_deg`: its distance from the path, for each."""
        nearest_deg = min(apart_deg.values())
        return tuple(
            ahead_s for ahead_s, deg in apart_deg.items() if deg <= max(nearest_deg, self.rounding_deg) + BEARS_OUT_DEG
        )


@dataclass(frozen=True, slots=True)
class Fly:
    """Fly a pass that is known to its end, as planned. Times are on the control loop's clock."""

    name: str
    path: tuple[tuple[float, float, float], ...]
    """The target's directions: (moment in s, azimuth, elevation), rising, two or more."""
    azimuth: AxisPlan
    elevation: AxisPlan
    sets_s: float | None = None
    """When the target sets, if that is after the end of the path; infinite: it does not set."""
    expected_error_deg: float = 0.0
    """Largest possible distance of the target from its path."""
    beyond_beam: bool = False
    """Whether that distance is more than half of the antenna's beam."""
    table: bool = False
    """Whether the path is a person's table."""
    stream: Stream | None = None
    """The sender's own stream, which this flight replaces while the orders agree. None: no stream."""


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
    """GS-232 X1 to X4. A relay has one speed: remembered, shown, without effect there."""

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

Order = Pointing | Jog | Stop | Release | ClearTimed | Calibrate | Speed | Leave | Personal


PAGE = "page"
"""The page of the box: each of its paired browsers is a connection of this link."""
CONSOLE, PANEL = "console", "panel"
KEYBOARD = "keyboard"
"""The keys of `rotator run`, the space bar among them."""
PERSONS = (CONSOLE, KEYBOARD, PANEL, "calibrate", PAGE)
"""The links of persons at the box, in a source. No link of the configuration has one of these names."""
MQTT = "mqtt"
"""The broker of [mqtt], as the link of a source. It counts as one program, even if many use the broker."""
TRACKER = "track"
"""The tracker, which follows a target for a person, as the link of a source."""


@dataclass(frozen=True, slots=True)
class Source:
    """The sender of an order: a link, and the connection on it. A reconnect is a new source."""

    link: str
    connection: int = 0
    host: str = field(default="", compare=False)
    """The address of the machine at the other end; empty: not known, or no network."""

    @property
    def is_person(self) -> bool:
        """Whether a person gives these orders: at the console, at the panel, on the page, in a calibration."""
        return self.link in PERSONS

    @property
    def holds(self) -> bool:
        """Whether this person's motion holds the antenna until it is given back: on the page a person may look away."""
        return self.link == PAGE

    @property
    def may_be_held_off(self) -> bool:
        """Whether its orders have no effect while a person holds the antenna: programs, and the page of another."""
        return self.link == PAGE or not (self.is_person or self.link == TRACKER)

    def __str__(self) -> str:
        return f"{self.link}#{self.connection}" if self.connection else self.link


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an order is refused, for the log. The protocol answers in its own words."""

    reason: str
    forbidden: bool = False
    """Whether the sender may give no orders at all."""
    out_of_range: bool = False
    """Whether the order has an angle outside a range. A tracking program repeats such an order for a long time."""
