"""The EasyComm I, II and III command sets, as a table, with their codec.

Knows every command for a rotor, how clients really write it, and the form of its reply. Does not know what the box does
with it: `easycomm_session` does. Sources: G7UPN's EasyComm standard with its third part, in Hamlib's archive, and what
Hamlib 4.5 and 4.6, WispDDE and PstRotator users send (see docs/protocols.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import IntEnum

MAX_LINE = 256


class Level(IntEnum):
    """Each level has all commands of the lower levels."""

    I = 1  # noqa: E741 - the standard's own numeral
    II = 2
    III = 3


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str
    level: Level = Level.II
    number: str = ""
    """The pattern of the number that must follow; empty: no number may follow."""


_DEGREES = r"[+-]?(?:\d{1,3}(?:[.,]\d{0,6})?|[.,]\d{1,6})"
"""Visual Basic writes `.5`; some desktops write `0,5`. Without a number the word is a question."""
_SPEED = r"\d{1,5}"

VERBS = (
    Verb("AZ", "Azimuth: go there; without a number: read it", Level.I, f"(?:{_DEGREES})?"),
    Verb("EL", "Elevation: go there; without a number: read it", Level.I, f"(?:{_DEGREES})?"),
    Verb("SA", "Stop azimuth", Level.I),
    Verb("SE", "Stop elevation", Level.I),
    Verb("ML", "Turn counter-clockwise until stopped"),
    Verb("MR", "Turn clockwise until stopped"),
    Verb("MU", "Turn up until stopped"),
    Verb("MD", "Turn down until stopped"),
    Verb("VE", "Read the version"),
    Verb("PARK", "Go to the park position (Hamlib's own command)"),
    Verb("RESET", "Stop everything and acknowledge faults (Hamlib's own command)"),
    Verb("VL", "Turn counter-clockwise at so many mdeg/s; 0: stop azimuth", Level.III, _SPEED),
    Verb("VR", "Turn clockwise at so many mdeg/s; 0: stop azimuth", Level.III, _SPEED),
    Verb("VU", "Turn up at so many mdeg/s; 0: stop elevation", Level.III, _SPEED),
    Verb("VD", "Turn down at so many mdeg/s; 0: stop elevation", Level.III, _SPEED),
    Verb("GS", "Read the state, a sum: 1 idle, 2 moving, 4 has a target, 8 fault", Level.III),
    Verb("GE", "Read the faults, a sum: 1 sensor, 2 jam, 4 not calibrated, 8 motor or its control", Level.III),
)
_PATTERNS = tuple((verb, re.compile(f"{verb.text}({verb.number})")) for verb in VERBS)
_STOPS = ("SA", "SE")
_NAMED = re.compile(r"[A-Z][!-~]*")
_UNENDED = re.compile(r" *(?:AZ|EL)-?\d{1,3}\.\d(?: +(?:AZ|EL)-?\d{1,3}\.\d)? *")


@dataclass(frozen=True, slots=True)
class Word:
    """One command of a line. An AZ or EL without a value is a question."""

    verb: str
    value: float | None = None


def parse(line: bytes, level: Level) -> tuple[Word, ...]:
    """The commands in one line, without its end.

    Other words that begin with a letter (frequencies, modes) are for radios and are skipped. In a line with a damaged
    word (`AZ1x0`, `AZ1 20.5`) only the stops count. Noise before the first word is skipped.
    """
    text = line.upper().decode("latin-1").replace("\t", " ").replace(";", " ")
    text = text.lstrip("".join(map(chr, (*range(0x21), *range(0x7F, 0x100)))))
    parts = [part for part in text.split(" ") if part]
    words = [word for part in parts if (word := _word(part, level))]
    if any(_is_damaged(part) for part in parts):
        return tuple(word for word in words if word.verb in _STOPS)
    return tuple(words)


def _word(text: str, level: Level) -> Word | None:
    for verb, pattern in _PATTERNS:
        if verb.level <= level and (match := pattern.fullmatch(text)):
            return Word(verb.text, float(match[1].replace(",", ".")) if match[1] else None)
    return None


def _is_damaged(text: str) -> bool:
    if text.startswith(("AZ", "EL")):
        return _word(text, Level.I) is None
    return not _NAMED.fullmatch(text)


def is_whole(begun: bytes) -> bool:
    """Whether bytes without a line end are a whole order: angles with exactly one decimal.

    A phone's Bluetooth terminal and some trackers send no line end. `AZ23` may still become `AZ235.0`.
    """
    return bool(_UNENDED.fullmatch(begun.upper().decode("latin-1")))


def encode(*words: Word) -> bytes:
    """A line as Hamlib writes it: one decimal, LF; speeds in four digits."""
    return (" ".join(map(_written, words)) + "\n").encode()


def _written(word: Word) -> str:
    match word:
        case Word("AZ" | "EL" as verb, float() as angle_deg):
            return verb + degrees(angle_deg)
        case Word(verb, float() as speed_mdps):
            return f"{verb}{speed_mdps:04.0f}"
        case _:
            return word.verb


def degrees(angle_deg: float) -> str:
    """One decimal, which PstRotator needs; never `-0.0`."""
    return f"{round(angle_deg, 1) + 0.0:.1f}"


def position_reply(azimuth_deg: float | None, elevation_deg: float | None) -> bytes:
    """Both in one line (Hamlib up to 4.5), or only the axis in question (since 4.6). LF: Gpredict does not read CR."""
    named = [("AZ", azimuth_deg), ("EL", elevation_deg)]
    return (" ".join(name + degrees(angle) for name, angle in named if angle is not None) + "\n").encode()


def pstrotator_reply(azimuth_deg: float, elevation_deg: float) -> bytes:
    return f"+{degrees(azimuth_deg)} {degrees(elevation_deg)}\n".encode()


def reply(verb: str, value: int | str) -> bytes:
    """The command's name and its value."""
    return f"{verb}{value}\n".encode()


def alarm(reason: str) -> bytes:
    """The controller's message for a problem: sent in place of an answer."""
    return f"AL{reason}\n".encode()
