"""The console's commands, one on a line, for the operator at the box: some orders are allowed only here.

Knows the table of commands and how each is written. Does not know what a command makes the box do.
"""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from enum import Enum

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
from rotator.protocols.aiming import aim, degrees
from rotator.protocols.panel_words import OPERANDS, TURNS, Hand, parse_hand

LONGEST_JOG_S = 5.0
PULSE_S = 0.2
MOST_NUDGE_DEG = 20.0
"""Further away it is another target: then point there."""


class Ask(Enum):
    """A question, not an order."""

    STATUS = "status"
    STATUS_JSON = "status json"
    HELP = "help"


@dataclass(frozen=True, slots=True)
class Track:
    """Track the target of these words. `off`: track no target. No words: ask what the box tracks."""

    words: str


@dataclass(frozen=True, slots=True)
class TableLine:
    """One more line of a timed table; None: a new table begins."""

    text: str | None


@dataclass(frozen=True, slots=True)
class TrackTable:
    """Track the table of the lines that were sent."""

    name: str


@dataclass(frozen=True, slots=True)
class GoOn:
    """Let it move again, and track what was tracked before the stop."""


@dataclass(frozen=True, slots=True)
class ClockIsRight:
    """A person says that this computer's clock is right."""


@dataclass(frozen=True, slots=True)
class Pair:
    """What to do with the browsers that may move the antenna: "" begins to pair one; `list`, `token`, `revoke`."""

    action: str = ""
    subject: str = ""
    """The name of a new token, or the number of the pairing to revoke."""


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
ConsoleCommand = PersonCommand | Ask | Hand | TableLine | TrackTable | Pair


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    operands: str
    help: str

    @property
    def usage(self) -> str:
        return f"{self.text} {self.operands}".rstrip()


VERBS = (
    Verb("status", "[json]", "Angles and targets, who moves the antenna, faults, and what is missing"),
    Verb("stop", "", "Stop everything; nothing moves until `resume`. The rest of the line does not count"),
    Verb("resume", "", "Let it move again, and acknowledge faults"),
    Verb("go-on", "", "Let it move again, and track what a stop, a fault or a jog has ended"),
    Verb("home", "azimuth|elevation", "Find the low end stop of an axis that counts pulses: watch the antenna"),
    Verb("confirm", "azimuth|elevation DEGREES", "Give the angle of an axis that cannot know it"),
    Verb("relays-checked", "azimuth|elevation", "You have seen that both relays of an axis are open"),
    Verb("let-go", "", "Motors without torque: an antenna out of balance turns; nothing moves until `resume`"),
    Verb("park", "", "Go to the park position, even while a program tracks, and stay there until `resume`"),
    Verb("jog", "cw|ccw|up|down SECONDS", f"Turn for this time, {LONGEST_JOG_S:g} s at most"),
    Verb("pulse", "cw|ccw|up|down", f"Close this relay for {1000 * PULSE_S:g} ms, while the antenna stands"),
    Verb("point", "AZIMUTH [ELEVATION]", "Point there; without ELEVATION that axis keeps what it has"),
    Verb("nudge", "azimuth|elevation DEGREES", "Shift the target in force by so much, until the pass ends; 0 ends it"),
    Verb("track", "[NAME|LOCATOR|AZIMUTH ELEVATION|plan|off]", "Track a satellite, Sun, Moon … from pass to pass"),
    Verb("table", "[LINE]", "One more line of a timed table, the first is t,az,el; alone: forget the lines"),
    Verb("track-table", "NAME", "Track the table of these lines: t in seconds from now, or in UTC"),
    Verb(
        "demo",
        "[TIME-ZONE] [life]",
        "Simulated rotor: the ISS over your continent, 10 times as fast or as in life",
    ),
    Verb("take", "", "Take the antenna: it stops, and programs do not move it until `give-back`"),
    Verb("give-back", "", "Let programs move it again, after you or a person on the page have held it"),
    Verb("mode", "auto|manual|jog|park", "Who moves it: programs, you alone, your jogs alone, nobody"),
    Verb("clock-is-right", "", "You have seen that this computer's clock is right: `track` needs it"),
    Verb("panel", OPERANDS, "Move a switch or a knob of the simulated front panel"),
    Verb("pair", "[list|revoke NUMBER|token NAME]", "A code that lets a browser on the page move the antenna"),
    Verb("help", "", "This list"),
)
_BY_TEXT = {verb.text: verb for verb in VERBS}
COMMANDS = ("where", "monitor", "doctor", "calibrate", "config", "rehearse", "sky", "run")
"""Commands of the program that a person takes for words of the console."""
TURN_WORDS = {turn: word for word, turn in TURNS.items()}
_STOPS, _SLIP = ("s", "st", "sto"), 0.7
"""`stop` cut off; and how much alike a word with one letter wrong, too many, or in the wrong place is: `stpo` 0.75."""
_WHOLE = re.compile(r"[0-9]{1,6}")
_SECONDS = re.compile(r"[0-9]{1,3}(?:[.,][0-9]{1,3})?")


def parse(line: bytes) -> ConsoleCommand:
    """From one line, without its end, to a command; capitals do not matter. Raises ValueError for the operator."""
    words = [word for word in line.lower().replace(b"\t", b" ").decode("latin-1").split(" ") if word]
    match words:
        case ["status"] | ["status", "json"] | ["help"]:
            return Ask(" ".join(words))
        case ["stop", *_]:
            # A stop counts even if more text follows it.
            return Stop(latch=True)
        case ["resume"]:
            return Release()
        case ["go-on"]:
            return GoOn()
        case ["home", "azimuth" | "elevation" as axis]:
            return Home(Axis(axis))
        case ["confirm", "azimuth" | "elevation" as axis, angle]:
            return Confirm(Axis(axis), _degrees(Axis(axis), angle))
        case ["relays-checked", "azimuth" | "elevation" as axis]:
            return RelaysChecked(Axis(axis))
        case ["let-go"]:
            return LetGo()
        case ["park"]:
            return Park(storm=True)
        case ["jog", turn, seconds] if turn in TURNS:
            return Jog(*TURNS[turn], _seconds(seconds))
        case ["pulse", turn] if turn in TURNS:
            return Pulse(*TURNS[turn])
        case ["point", azimuth, *elevation] if len(elevation) <= 1:
            elevation_deg = _degrees(Axis.ELEVATION, elevation[0]) if elevation else None
            return aim(_degrees(Axis.AZIMUTH, azimuth), elevation_deg)
        case ["nudge", "azimuth" | "elevation" as axis, angle]:
            return Nudge(Axis(axis), _nudge_deg(angle), of_pass=True)
        case ["track", *what]:
            return Track(" ".join(what))
        case ["table"]:
            return TableLine(None)
        case ["table", *cells]:
            return TableLine(" ".join(cells))
        case ["track-table", name]:
            return TrackTable(name)
        case ["demo", *zone, "life"] if len(zone) <= 1:
            return Demo("".join(zone), 1)
        case ["demo", *zone] if len(zone) <= 1:
            return Demo("".join(zone), FAST)
        case ["clock-is-right"]:
            return ClockIsRight()
        case ["take"]:
            return Take()
        case ["give-back"]:
            return GiveBack()
        case ["mode", "auto" | "manual" | "jog" | "park" as mode]:
            return SetMode(Mode(mode))
        case ["pair"]:
            return Pair()
        case ["pair", "list"]:
            return Pair("list")
        case ["pair", "revoke", number] if _WHOLE.fullmatch(number):
            return Pair("revoke", number)
        case ["pair", "token", *name] if name:
            return Pair("token", " ".join(name))
        case ["panel", *rest]:
            return parse_hand(rest)
        case [verb, *_] if verb in _BY_TEXT:
            raise ValueError(f"write it like this: {_BY_TEXT[verb].usage}")
        case _:
            word = words[0] if words else ""
            slip = word in _STOPS or difflib.get_close_matches(word, ["stop"], cutoff=_SLIP)
            if word not in COMMANDS and (slip or b"stop" in line.lower()):
                return Stop(latch=True)
            raise ValueError(_unknown(word))


def _degrees(axis: Axis, text: str) -> float:
    low_deg, high_deg = WIDEST_DEG[axis]
    angle_deg = degrees(text)
    if angle_deg is None or not low_deg <= angle_deg <= high_deg:
        raise ValueError(f"{_quoted(text)} is no {axis.value}: degrees from {low_deg:g} to {high_deg:g}")
    return angle_deg


def _nudge_deg(text: str) -> float:
    offset_deg = degrees(text)
    if offset_deg is None or abs(offset_deg) > MOST_NUDGE_DEG:
        raise ValueError(f"{_quoted(text)} is no nudge: degrees from {-MOST_NUDGE_DEG:g} to {MOST_NUDGE_DEG:g}")
    return offset_deg


def _seconds(text: str) -> float:
    seconds = float(text.replace(",", ".")) if _SECONDS.fullmatch(text) else 0.0
    if not 0 < seconds <= LONGEST_JOG_S:
        raise ValueError(f"{_quoted(text)} is no time to jog: seconds, {LONGEST_JOG_S:g} at most")
    return seconds


def _unknown(word: str) -> str:
    if word in COMMANDS:
        return f"{word} is no word of the console but a command: rotator {word}"
    meant = difflib.get_close_matches(word, _BY_TEXT, n=1)
    hint = f"; did you mean {meant[0]}?" if meant else "."
    return f"there is no command {_quoted(word)}{hint} There are: {', '.join(_BY_TEXT)}"


def _quoted(text: str) -> str:
    return f"{text[:20]!a}"
