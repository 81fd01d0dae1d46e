"""What the operator can enter during a calibration: single keys in a terminal, or lines of text.

Knows letters and numbers. Does not know the terminal, nor which question an entry answers. A text that is not one whole
entry is never read in part: `438,5x` is refused, not taken for 438 or 5.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

from hw.ports import Axis, Direction
from rotator.control.axis.goals import UNCALIBRATED_JOG_S

TAP_S = 0.7
"""How long one key press turns. A keyboard repeats a held key sooner than this, so a held key is one turn."""
NUMBER_FORM = "Type one number of degrees, for example 438.5 or -2, and press Enter."
IN_NUMBER = "Finish the number with Enter, or take it back with Backspace."
PRESS_FORM = "Write a press as r, or with its seconds as r 1.5."


@dataclass(frozen=True, slots=True)
class Press:
    """Turn the axis for `seconds`. A new press before the end extends the turn."""

    axis: Axis
    direction: Direction
    seconds: float


@dataclass(frozen=True, slots=True)
class StopNow:
    """Stop the motor now."""


class Word(Enum):
    """An answer of one letter, and the words that a line may have for it."""

    YES = ("y", "yes")
    NO = ("n", "no")
    ENTER = ("",)
    """Read here, or accept the proposed value."""
    FINISH = ("f", "finish")
    """There are no more points."""
    BACK = ("b", "back")
    """Take the last point back."""
    QUIT = ("q", "quit")
    """Leave; nothing is saved."""
    HELP = ("?", "h", "help")
    """Say what the open question accepts."""


@dataclass(frozen=True, slots=True)
class Number:
    value: float


@dataclass(frozen=True, slots=True)
class Unknown:
    """No entry of the list. `form`: the right way to write it; empty: the text resembles nothing in the list."""

    text: str
    form: str = ""


Entry = Press | StopNow | Word | Number | Unknown

TURN_KEYS = {
    "r": (Axis.AZIMUTH, Direction.PLUS),
    "l": (Axis.AZIMUTH, Direction.MINUS),
    "u": (Axis.ELEVATION, Direction.PLUS),
    "d": (Axis.ELEVATION, Direction.MINUS),
}
TURN_WORDS = {"right": "r", "left": "l", "up": "u", "down": "d"} | {key: key for key in TURN_KEYS}
PLAIN_WORDS = {text: word for word in Word for text in word.value}
STOP_WORDS = ("s", "stop")
STOP_KEYS = (" ", "s", "S")
ARROW_KEYS = {"C": "r", "D": "l", "A": "u", "B": "d"}
"""The last character of an arrow key, after Esc and `[` or `O`."""
NUMBER_STARTS = "0123456789.,-+"
NUMBER = re.compile(r"[-+]?[0-9]{1,4}(?:[.,][0-9]{0,4})?")
"""The whole text must match. A decimal comma counts as a decimal point."""


def from_line(line: str) -> Entry:
    """One line: a letter or its word (`y`, `yes`), a number, or `r 1.5` for a press of that many seconds.

    A line that begins with `s` or `stop` always stops, also with more behind it.
    """
    text = line.strip().lower()
    word, _, rest = text.partition(" ")
    if word in STOP_WORDS:
        return StopNow()
    if text in PLAIN_WORDS:
        return PLAIN_WORDS[text]
    if NUMBER.fullmatch(text):
        return Number(_number(text))
    if word in TURN_WORDS:
        seconds = rest.strip()
        if seconds and not NUMBER.fullmatch(seconds):
            return Unknown(line, PRESS_FORM)
        turn_s = _number(seconds) if seconds else UNCALIBRATED_JOG_S
        return Press(*TURN_KEYS[TURN_WORDS[word]], min(max(turn_s, 0.0), UNCALIBRATED_JOG_S))
    looks_like_number = any(character in NUMBER_STARTS for character in text)
    return Unknown(line, NUMBER_FORM if looks_like_number else "")


def _number(text: str) -> float:
    return float(text.replace(",", "."))


class Keyboard:
    """Single keys, as a terminal sends them: an arrow is three characters, a number lasts until Enter.

    Once a number has begun, every character is part of the text until Enter, so that the whole text is judged. Enter
    ends it, whether it is taken or refused. Space and `s` stop the motor at once all the same.
    """

    def __init__(self) -> None:
        self.typed = ""
        """The number typed so far."""
        self._escape = ""

    def key(self, pressed: str) -> Entry | None:
        """Take one character. Returns the entry that it completes, or None."""
        if pressed == "\x1b":
            self._escape = pressed
            return None
        if self._escape:
            return self._arrow(pressed)
        if pressed in ("\x7f", "\b"):
            self.typed = self.typed[:-1]
            return None
        if pressed in ("\r", "\n"):
            text, self.typed = self.typed, ""
            return from_line(text)
        if self.typed or (pressed and pressed in NUMBER_STARTS):
            self.typed += pressed
            return StopNow() if pressed in STOP_KEYS else None
        if pressed in STOP_KEYS:
            return StopNow()
        if pressed.lower() in TURN_KEYS:
            return Press(*TURN_KEYS[pressed.lower()], UNCALIBRATED_JOG_S if pressed.isupper() else TAP_S)
        return from_line(pressed) if pressed else None

    def _arrow(self, pressed: str) -> Entry | None:
        """The second and the third character of an arrow key. Any other key after Esc counts as itself."""
        begun, self._escape = self._escape, ""
        if begun == "\x1b":
            if pressed not in ("[", "O"):
                return self.key(pressed)
            self._escape = begun + pressed
            return None
        if pressed in STOP_KEYS:
            return StopNow()
        if pressed not in ARROW_KEYS:
            return None
        if self.typed:
            return Unknown("an arrow", IN_NUMBER)
        return Press(*TURN_KEYS[ARROW_KEYS[pressed]], TAP_S)
