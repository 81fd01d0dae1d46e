"""What a person may ask of the box, as methods with named values: for the page, and for programs that speak JSON.

Knows each method's name, its values and the command that they make: the same commands as on the console, whose words
for them are in `console`. Does not know HTTP, nor what a command makes the box do.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from hw.ports import Axis
from rotator.control.admission import WIDEST_DEG
from rotator.exchange.orders import (
    Confirm,
    GiveBack,
    Home,
    Jog,
    LetGo,
    Mode,
    Nudge,
    Park,
    RelaysChecked,
    Release,
    SetMode,
    Stop,
    Take,
)
from rotator.orbits.demo_pass import FAST
from rotator.protocols.aiming import aim
from rotator.protocols.console import (
    LONGEST_JOG_S,
    MOST_NUDGE_DEG,
    PULSE_S,
    ClockIsRight,
    Demo,
    GoOn,
    PersonCommand,
    Pulse,
    Track,
)
from rotator.protocols.panel_words import TURNS

LONGEST_TARGET = 100


class WrongValuesError(ValueError):
    """The values do not fit the method. The text says what to send instead."""


@dataclass(frozen=True, slots=True)
class Number:
    """A value that is a number within bounds."""

    name: str
    least: float
    most: float
    meaning: str
    example: float

    def read(self, value: object) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not self.least <= value <= self.most:
            raise WrongValuesError(f"{self.name} must be a number from {self.least:g} to {self.most:g}")
        return float(value)

    def schema(self) -> dict[str, Any]:
        return {"type": "number", "minimum": self.least, "maximum": self.most, "description": self.meaning}


@dataclass(frozen=True, slots=True)
class Choice:
    """A value that is one of a few words."""

    name: str
    words: tuple[str, ...]
    meaning: str

    @property
    def example(self) -> str:
        return self.words[0]

    def read(self, value: object) -> str:
        if not isinstance(value, str) or value not in self.words:
            raise WrongValuesError(f"{self.name} must be one of {', '.join(self.words)}")
        return value

    def schema(self) -> dict[str, Any]:
        return {"type": "string", "enum": list(self.words), "description": self.meaning}


@dataclass(frozen=True, slots=True)
class Words:
    """A value that is a short text."""

    name: str
    meaning: str
    example: str

    def read(self, value: object) -> str:
        if not isinstance(value, str) or not 0 < len(value.strip()) <= LONGEST_TARGET or not value.isprintable():
            raise WrongValuesError(f"{self.name} must be a text of 1 to {LONGEST_TARGET} characters")
        return value.strip()

    def schema(self) -> dict[str, Any]:
        return {"type": "string", "minLength": 1, "maxLength": LONGEST_TARGET, "description": self.meaning}


Value = Number | Choice | Words


@dataclass(frozen=True, slots=True)
class Method:
    """One method. `make` gets the values in the order of `values`. `free`: it needs no pairing.

    `harmless`: who may read may ask for it, too, for it moves a simulated antenna that nobody uses, and no other.
    """

    name: str
    meaning: str
    make: Callable[..., PersonCommand]
    values: tuple[Value, ...] = ()
    free: bool = False
    harmless: bool = False

    def command(self, sent: Mapping[str, object]) -> PersonCommand:
        """From the values that were sent. Raises WrongValuesError."""
        names = [value.name for value in self.values]
        for name in sent:
            if name not in names:
                has = f"it has {', '.join(names)}" if names else "it has no values"
                raise WrongValuesError(f"{self.name} has no value {name[:40]!a}: {has}")
        for name in names:
            if name not in sent:
                raise WrongValuesError(f"{self.name} needs {name}")
        return self.make(*(value.read(sent[value.name]) for value in self.values))


_AXIS = Choice("axis", tuple(axis.value for axis in Axis), "the axis")
_AZIMUTH = Number(
    "azimuth_deg", *WIDEST_DEG[Axis.AZIMUTH], "clockwise from true north; above 360: a turn of the overlap", 200
)
_ELEVATION = Number("elevation_deg", *WIDEST_DEG[Axis.ELEVATION], "above the horizon", 30)
_ANGLE = Number("angle_deg", *WIDEST_DEG[Axis.AZIMUTH], "where the axis stands, in true degrees", 0)
_TURN = Choice("turn", tuple(TURNS), "clockwise, counter-clockwise, up or down")

METHODS = (
    Method("stop", "Stop everything; nothing moves until `resume`", lambda: Stop(latch=True), free=True),
    Method("resume", "Let it move again, and acknowledge faults", Release),
    Method("go-on", "The same, and track what a stop, a fault or a jog has ended: `goes_on_with` of the picture", GoOn),
    Method("take", "Take the antenna: it stops, and programs do not move it until `give-back`", Take),
    Method("give-back", "Let programs move the antenna again", GiveBack),
    Method(
        "mode",
        "Who moves the antenna: programs (auto), you alone (manual), your buttons alone (jog), nobody (park)",
        lambda mode: SetMode(Mode(mode)),
        (Choice("mode", tuple(mode.value for mode in Mode), "as the switch of a front panel"),),
    ),
    Method("point", "Point there", aim, (_AZIMUTH, _ELEVATION)),
    Method(
        "jog",
        "Turn for this time",
        lambda turn, seconds: Jog(*TURNS[turn], seconds),
        (_TURN, Number("seconds", 0.05, LONGEST_JOG_S, "how long", 0.5)),
    ),
    Method(
        "pulse",
        f"Close this relay for {1000 * PULSE_S:g} ms, while the antenna stands; on the page `take` it first",
        lambda turn: Pulse(*TURNS[turn]),
        (_TURN,),
    ),
    Method(
        "nudge",
        "Shift the target in force by this angle, while it is tracked on; 0 ends it, and so does the end of the pass",
        lambda axis, offset_deg: Nudge(Axis(axis), offset_deg, of_pass=True),
        (_AXIS, Number("offset_deg", -MOST_NUDGE_DEG, MOST_NUDGE_DEG, "from where it is computed", 1)),
    ),
    Method("park", "Go to the park position, and stay there until `resume`", lambda: Park(storm=True)),
    Method(
        "track",
        "Track a satellite, Sun, Moon, a place, a country, a favourite; `plan`: what the file follows; `off`: nothing",
        Track,
        (Words("target", "its name, as `rotator track` takes it", "Moon"),),
    ),
    Method(
        "demo",
        "On a simulated rotor that nobody uses: fly a pass of the ISS over your continent",
        lambda zone, speed: Demo(zone.casefold(), 1 if speed == "life" else FAST),
        (
            Words("zone", "your time zone; one that is not known counts as Europe", "Europe/Prague"),
            Choice("speed", ("fast", "life"), f"{FAST} times as fast as life, or as in life"),
        ),
        harmless=True,
    ),
    Method("clock-is-right", "You have seen that the box's clock is right: `track` needs it", ClockIsRight),
    Method("home", "Find the low end stop of an axis that counts pulses", lambda axis: Home(Axis(axis)), (_AXIS,)),
    Method(
        "confirm",
        "Give the angle of an axis that cannot know it",
        lambda axis, angle_deg: Confirm(Axis(axis), angle_deg),
        (_AXIS, _ANGLE),
    ),
    Method(
        "relays-checked",
        "You have seen that both relays of an axis are open",
        lambda axis: RelaysChecked(Axis(axis)),
        (_AXIS,),
    ),
    Method("let-go", "Motors without torque: an antenna out of balance turns", LetGo),
)
