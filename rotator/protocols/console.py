"""The console's commands, one on a line, for the operator at the box: some orders are allowed only here.

Knows how each command is written: those that the page has as well are in `methods`. Does not know what a command makes
the box do.
"""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from enum import Enum
from typing import Any

from rotator.exchange.orders import Stop
from rotator.orbits.demo_pass import FAST
from rotator.protocols.aiming import aim, degrees
from rotator.protocols.methods import (
    BY_NAME,
    METHODS,
    Choice,
    Demo,
    Method,
    Number,
    PersonCommand,
    Track,
    Value,
    WrongValuesError,
)
from rotator.protocols.panel_words import OPERANDS, TURNS, Hand, parse_hand


class Ask(Enum):
    """A question, not an order."""

    STATUS = "status"
    STATUS_JSON = "status json"
    HELP = "help"


@dataclass(frozen=True, slots=True)
class TableLine:
    """One more line of a timed table; None: a new table begins."""

    text: str | None


@dataclass(frozen=True, slots=True)
class TrackTable:
    """Track the table of the lines that were sent."""

    name: str


@dataclass(frozen=True, slots=True)
class Pair:
    """What to do with the browsers that may move the antenna: "" begins to pair one; `list`, `token`, `revoke`."""

    action: str = ""
    subject: str = ""
    """The name of a new token, or the number of the pairing to revoke."""


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


_ON_A_LINE = {
    "stop": ("", ". The rest of the line does not count"),
    "point": ("AZIMUTH [ELEVATION]", "; without ELEVATION that axis keeps what it has"),
    "track": ("[NAME|LOCATOR|AZIMUTH ELEVATION|plan|off]", ""),
    "demo": ("[TIME-ZONE] [life]", f", {FAST} times as fast or as in life"),
}
"""What may be left out here, or has several words, and what is to be said of that."""


def _operand(value: Value) -> str:
    if isinstance(value, Choice):
        return "|".join(value.words)
    return "DEGREES" if value.name.endswith("_deg") else value.name.upper()


def _verb(method: Method) -> Verb:
    operands, more = _ON_A_LINE.get(method.name, (" ".join(map(_operand, method.values)), ""))
    return Verb(method.name, operands, method.meaning + more)


VERBS = (
    Verb("status", "[json]", "Angles and targets, who moves the antenna, faults, and what is missing"),
    *map(_verb, METHODS),
    Verb("table", "[LINE]", "One more line of a timed table, the first is t,az,el; alone: forget the lines"),
    Verb("track-table", "NAME", "Track the table of these lines: t in seconds from now, or in UTC"),
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


def parse(line: bytes) -> ConsoleCommand:
    """From one line, without its end, to a command; capitals do not matter. Raises ValueError for the operator."""
    words = [word for word in line.lower().replace(b"\t", b" ").decode("utf-8", "replace").split(" ") if word]
    match words:
        case ["status"] | ["status", "json"] | ["help"]:
            return Ask(" ".join(words))
        case ["stop", *_]:
            # A stop counts even if more text follows it.
            return Stop(latch=True)
        case ["point", azimuth]:
            return aim(_said(BY_NAME["point"].values[0], azimuth), None)
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
        case [verb, *said] if verb in BY_NAME and len(said) == len(BY_NAME[verb].values):
            return BY_NAME[verb].make(*map(_said, BY_NAME[verb].values, said))
        case [verb, *_] if verb in _BY_TEXT:
            raise ValueError(f"write it like this: {_BY_TEXT[verb].usage}")
        case _:
            word = words[0] if words else ""
            slip = word in _STOPS or difflib.get_close_matches(word, ["stop"], cutoff=_SLIP)
            if word not in COMMANDS and (slip or b"stop" in line.lower()):
                return Stop(latch=True)
            raise ValueError(_unknown(word))


def _said(value: Value, text: str) -> Any:
    try:
        return value.read(degrees(text) if isinstance(value, Number) else text)
    except WrongValuesError as wrong:
        raise ValueError(f"{wrong}, not {_quoted(text)}".replace("_deg", "")) from None


def _unknown(word: str) -> str:
    if word in COMMANDS:
        return f"{word} is no word of the console but a command: rotator {word}"
    meant = difflib.get_close_matches(word, _BY_TEXT, n=1)
    hint = f"; did you mean {meant[0]}?" if meant else "."
    return f"there is no command {_quoted(word)}{hint} There are: {', '.join(_BY_TEXT)}"


def _quoted(text: str) -> str:
    return f"{text[:20]!a}"
