"""The console's commands, one on a line, for the operator at the box: some orders are allowed only here.

Knows the table of commands and how each is written. Does not know what a command makes the box do.
"""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from enum import Enum

from hw.ports import Axis
from rotator.control.admission import SENT_DEG
from rotator.orders import Confirm, Home, Jog, LetGo, Order, Park, RelaysChecked, Release, Stop
from rotator.protocols.aiming import aim, degrees
from rotator.protocols.panel_words import OPERANDS, TURNS, Hand, parse_hand

LONGEST_JOG_S = 5.0


class Ask(Enum):
    """A question, not an order."""

    STATUS = "status"
    STATUS_JSON = "status json"
    HELP = "help"


@dataclass(frozen=True, slots=True)
class Track:
    """Track what these words name. `off`: nothing any more. No words: tell what goes on."""

    words: str


@dataclass(frozen=True, slots=True)
class ClockIsRight:
    """A person says that this computer's clock is right."""


ConsoleCommand = Order | Ask | Hand | Track | ClockIsRight


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
    Verb("home", "azimuth|elevation", "Find the low end stop of an axis that counts pulses: watch the antenna"),
    Verb("confirm", "azimuth|elevation DEGREES", "Give the angle of an axis that cannot know it"),
    Verb("relays-checked", "azimuth|elevation", "You have seen that both relays of an axis are open"),
    Verb("let-go", "", "Motors without torque: an antenna out of balance turns; nothing moves until `resume`"),
    Verb("park", "", "Go to the park position, even while a program tracks, and stay there until `resume`"),
    Verb("jog", "cw|ccw|up|down SECONDS", f"Turn for this time, {LONGEST_JOG_S:g} s at most"),
    Verb("point", "AZIMUTH ELEVATION", "Point there"),
    Verb("track", "[NAME|LOCATOR|AZIMUTH ELEVATION|plan|off]", "Track a satellite, Sun, Moon … from pass to pass"),
    Verb("clock-is-right", "", "You have seen that this computer's clock is right: `track` needs it"),
    Verb("panel", OPERANDS, "Move a switch or a knob of the simulated front panel"),
    Verb("help", "", "This list"),
)
_BY_TEXT = {verb.text: verb for verb in VERBS}
COMMANDS = ("where", "monitor", "doctor", "calibrate", "config", "rehearse", "sky", "run")
"""Commands of the program that a person takes for words of the console."""
TURN_WORDS = {turn: word for word, turn in TURNS.items()}
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
        case ["point", azimuth, elevation]:
            return aim(_degrees(Axis.AZIMUTH, azimuth), _degrees(Axis.ELEVATION, elevation))
        case ["track", *what]:
            return Track(" ".join(what))
        case ["clock-is-right"]:
            return ClockIsRight()
        case ["panel", *rest]:
            return parse_hand(rest)
        case [verb, *_] if verb in _BY_TEXT:
            raise ValueError(f"write it like this: {_BY_TEXT[verb].usage}")
        case _:
            raise ValueError(_unknown(words[0] if words else ""))


def _degrees(axis: Axis, text: str) -> float:
    low_deg, high_deg = SENT_DEG[axis]
    angle_deg = degrees(text)
    if angle_deg is None or not low_deg <= angle_deg <= high_deg:
        raise ValueError(f"{_quoted(text)} is no {axis.value}: degrees from {low_deg:g} to {high_deg:g}")
    return angle_deg


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
