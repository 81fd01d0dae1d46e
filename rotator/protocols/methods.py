"""What a person may ask of the box, as methods with named values: for page, console, and programs that speak JSON.

Knows each method's name, its values and the command that they make. `console` reads the same values from words. Does
not know HTTP, nor what a command makes the box do.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from hw.ports import Axis, Direction
from rotator.control.admission import WIDEST_DEG
from rotator.exchange.orders import (
    Confirm,
    GiveBack,
    Home,
    Jog,
    LetGo,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    SetMode,
    Stop,
    Take,
)
from rotator.orbits.demo_pass import FAST
from rotator.protocols.aiming import aim
from rotator.protocols.panel_words import TURNS

LONGEST_TARGET = 100
LONGEST_JOG_S = 5.0
PULSE_S = 0.2
MOST_NUDGE_DEG = 20.0
"""Further away it is another target: then point there."""


@dataclass(frozen=True, slots=True)
class Track:
    """Track the target of these words. `off`: track no target. No words: ask what the box tracks."""

    words: str


@dataclass(frozen=True, slots=True)
class GoOn:
    """Let it move again, and track what was tracked before the stop."""


@dataclass(frozen=True, slots=True)
class ClockIsRight:
    """A person says that this computer's clock is right."""


@dataclass(frozen=True, slots=True)
class Pulse:
    """Close one relay for a moment: a person sees which way it turns, and that no other relay closes."""

    axis: Axis
    direction: Direction


@dataclass(frozen=True, slots=True)
class Demo:
    """Fly the demo pass over the continent of this time zone, this many times as fast as life."""

    zone: str
    times: int


PersonCommand = Order | Track | GoOn | ClockIsRight | Pulse | Demo
"""What a person may ask for on the page as well."""


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


def _confirm(axis: str, angle_deg: float) -> Confirm:
    range_deg = WIDEST_DEG[Axis(axis)]
    return Confirm(Axis(axis), replace(_ANGLE, least=range_deg[0], most=range_deg[1]).read(angle_deg))


METHODS = (
    Method("stop", "Stop everything; nothing moves until `resume`", lambda: Stop(latch=True), free=True),
    Method("resume", "Let it move again, and acknowledge faults", Release),
    Method("go-on", "Let it move again, and track what a stop, a fault or a jog has ended", GoOn),
    Method("take", "Take the antenna: it stops, and programs do not move it until `give-back`", Take),
    Method("give-back", "Let programs move it again, after you or a person on the page have held it", GiveBack),
    Method(
        "mode",
        "Who moves it: programs (auto), you alone (manual), your jogs alone (jog), nobody (park)",
        lambda mode: SetMode(Mode(mode)),
        (Choice("mode", tuple(mode.value for mode in Mode), "as the switch of a front panel"),),
    ),
    Method("point", "Point there", aim, (_AZIMUTH, _ELEVATION)),
    Method(
        "jog",
        f"Turn for this time, {LONGEST_JOG_S:g} s at most",
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
        "Shift the target in force by so much, until the pass ends; 0 ends it",
        lambda axis, offset_deg: Nudge(Axis(axis), offset_deg, of_pass=True),
        (_AXIS, Number("offset_deg", -MOST_NUDGE_DEG, MOST_NUDGE_DEG, "from where it is computed", 1)),
    ),
    Method(
        "park",
        "Go to the park position, even while a program tracks, and stay there until `resume`",
        lambda: Park(storm=True),
    ),
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
    Method("clock-is-right", "You have seen that this computer's clock is right: `track` needs it", ClockIsRight),
    Method(
        "home",
        "Find the low end stop of an axis that counts pulses: watch the antenna",
        lambda axis: Home(Axis(axis)),
        (_AXIS,),
    ),
    Method("confirm", "Give the angle of an axis that cannot know it", _confirm, (_AXIS, _ANGLE)),
    Method(
        "relays-checked",
        "You have seen that both relays of an axis are open",
        lambda axis: RelaysChecked(Axis(axis)),
        (_AXIS,),
    ),
    Method(
        "let-go",
        "Motors without torque: an antenna out of balance turns; nothing moves until `resume`",
        LetGo,
    ),
)
BY_NAME = {method.name: method for method in METHODS}
