"""What a person can say to the guide, and how it is typed: the same letters as single keys and as lines.

Knows letters and numbers. Knows nothing of terminals, and nothing of what an answer leads to.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from hw.ports import Axis, Direction

TAP_S = 0.7
"""A key's press: longer than the pause before a held key repeats, so that a held key is one turn."""
PRESS_S = 2.0
"""The longest press there is: the rule for an axis that is not set up."""


@dataclass(frozen=True, slots=True)
class Press:
    """Turn that way for so long; again before it ends, and it goes on."""

    axis: Axis
    direction: Direction
    seconds: float


@dataclass(frozen=True, slots=True)
class Halt:
    """Stop the motor now."""


@dataclass(frozen=True, slots=True)
class Yes:
    pass


@dataclass(frozen=True, slots=True)
class No:
    pass


@dataclass(frozen=True, slots=True)
class Enter:
    """Here, or what was proposed."""


@dataclass(frozen=True, slots=True)
class Number:
    value: float


@dataclass(frozen=True, slots=True)
class Finish:
    """No more points."""


@dataclass(frozen=True, slots=True)
class Quit:
    """Leave; nothing is saved."""


@dataclass(frozen=True, slots=True)
class Unknown:
    text: str


Answer = Press | Halt | Yes | No | Enter | Number | Finish | Quit | Unknown

TURNS = {
    "r": (Axis.AZIMUTH, Direction.PLUS),
    "l": (Axis.AZIMUTH, Direction.MINUS),
    "u": (Axis.ELEVATION, Direction.PLUS),
    "d": (Axis.ELEVATION, Direction.MINUS),
}
WORDS: dict[str, Answer] = {"s": Halt(), "y": Yes(), "n": No(), "": Enter(), "f": Finish(), "q": Quit()}
ARROWS = {"[C": "r", "[D": "l", "[A": "u", "[B": "d"}
NUMBER = re.compile(r"[-+]?\d{1,4}(?:\.\d{0,4})?")


def from_line(line: str) -> Answer:
    """One line of text: a letter or its word (`y`, `yes`), a number, `r 1.5` for a press of so many seconds."""
    word, _, rest = line.strip().lower().partition(" ")
    if NUMBER.fullmatch(word) and not rest:
        return Number(float(word))
    if word[:1] in TURNS and word in ("r", "l", "u", "d", "right", "left", "up", "down"):
        seconds = rest.strip() or f"{PRESS_S}"
        if not NUMBER.fullmatch(seconds):
            return Unknown(line)
        return Press(*TURNS[word[0]], min(max(float(seconds), 0.0), PRESS_S))
    if not rest and word in {*WORDS, "stop", "yes", "no", "finish", "quit"}:
        return WORDS[word[:1]]
    return Unknown(line)


class Keyboard:
    """Single keys, as a terminal sends them: numbers are collected until Enter, arrows are three keys."""

    def __init__(self) -> None:
        self.typed = ""
        """The number begun."""
        self._escape = ""

    def key(self, pressed: str) -> Answer | None:
        if pressed == "\x1b":
            self._escape = pressed
            return None
        if self._escape:
            self._escape += pressed
            if len(self._escape) < 3:
                return None
            letter, self._escape = ARROWS.get(self._escape[1:], ""), ""
            return Press(*TURNS[letter], TAP_S) if letter else None
        if pressed in "0123456789.-+":
            self.typed += pressed
            return None
        typed, self.typed = self.typed, ""
        if pressed in ("\x7f", "\b"):
            self.typed = typed[:-1]
            return None
        if pressed in ("\r", "\n"):
            return from_line(typed)
        if pressed == " ":
            return Halt()
        if pressed.lower() in TURNS:
            return Press(*TURNS[pressed.lower()], PRESS_S if pressed.isupper() else TAP_S)
        return from_line(pressed) if pressed else None
