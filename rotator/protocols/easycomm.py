"""The EasyComm I, II and III command sets, as a table, with their codec.

Knows every command for a rotor, how clients really write it, and the form of its reply. Does not know what the box does
with it: `easycomm_session` does. Sources: G7UPN's EasyComm standard with its third part, in Hamlib's archive, and what
Hamlib 4.5 and 4.6, WispDDE and PstRotator users send (see docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import IntEnum

from rotator.protocols.aiming import NUMBER, degrees
from rotator.protocols.damaged import NOISE, is_stop

MAX_LINE = 256


class Level(IntEnum):
    """Each level has all commands of the lower levels."""

    I = 1  # noqa: E741 - the standard's own numeral
    II = 2
    III = 3


@dataclass(frozen=True, slots=True)
class Word:
    """One command of a line. An AZ or EL without a value is a question."""

    verb: str
    value: float | None = None


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str
    level: Level = Level.II
    number: str = ""
    """The pattern of the number that must follow; empty: no number may follow."""


_SPEED = r"\d{1,5}"

VERBS = (
    Verb("AZ", "Azimuth: go there; without number: read", Level.I, f"(?:{NUMBER})?"),
    Verb("EL", "Elevation: go there; without number: read", Level.I, f"(?:{NUMBER})?"),
    Verb("SA", "Stop azimuth", Level.I),
    Verb("SE", "Stop elevation", Level.I),
    Verb("ML", "Turn counter-clockwise until stopped"),
    Verb("MR", "Turn clockwise until stopped"),
    Verb("MU", "Turn up until stopped"),
    Verb("MD", "Turn down until stopped"),
    Verb("VE", "Read the version"),
    Verb("PARK", "Go to the park position (Hamlib's own)"),
    Verb("RESET", "Stop everything (Hamlib's own)"),
    Verb("VL", "Turn counter-clockwise, mdeg/s; 0: stop azimuth", Level.III, _SPEED),
    Verb("VR", "Turn clockwise, mdeg/s; 0: stop azimuth", Level.III, _SPEED),
    Verb("VU", "Turn up, mdeg/s; 0: stop elevation", Level.III, _SPEED),
    Verb("VD", "Turn down, mdeg/s; 0: stop elevation", Level.III, _SPEED),
    Verb("GS", "Read the state, a sum: 1 idle, 2 moving, 4 has a target, 8 fault", Level.III),
    Verb("GE", "Read the faults, a sum: 1 sensor, 2 jam, 4 not calibrated, 8 motor or its control", Level.III),
)
_PATTERNS = tuple((verb, re.compile(f"{verb.text}({verb.number})")) for verb in VERBS)
_STOPS = ("SA", "SE")
_ANGLES = ("AZ", "EL")
_RADIO = "UP|DN|UM|DM|UR|DR|UC|DC|AO|LO|OP|IP|AN|ST"
"""The standard's words for the radios and the station, which a rotor passes over."""
_BOTH_STOP = (Word("SA"), Word("SE"))
_ANGLE = re.compile(f"(AZ|EL)(?: *(?P<number>{NUMBER}))?")
"""With blanks between, as the builder of the servos writes it, too."""
_NUMBERED = re.compile("(AZ|EL)[-+0-9.,]")
_AFTER = re.compile(f"$|(?P<blank> )(?! *[0-9.,])|(?P<more>[ \\x00-\\x1f\\x7f-\\xff]|AZ|EL|SA|SE|{_RADIO})")
"""What may follow a whole number. `more`: only one with decimals is whole there, as in `AZ1 20.5` a digit is lost."""
_NAMED = re.compile("[A-Z][!-~]*")
_PLAIN = re.compile(r"[A-Z]{2,}|(?:UP|DN)\d+|(?:UM|DM)[A-Z-]+|(?:UR|DR|UC|DC|OP|IP|AN)\d{1,3}|ST[\d:]+")
_UNENDED = re.compile(r" *(?:AZ|EL) ?-?\d{1,3}\.\d{1,2}(?: *(?:AZ|EL) ?-?\d{1,3}\.\d{1,2})? *")


def parse(line: bytes, level: Level) -> tuple[Word, ...]:
    """The commands in one line, without its end.

    A pair of `AZ` and `EL` with their numbers counts anywhere in the line, in either order, with any text before,
    between and behind them. When one of the two is damaged (`AZ1x0`, `AZ1 20.5`, `EL` alone beside an azimuth), only
    the stops of the line count, and one of them stops both axes. A single angle counts only between blanks and in a
    line without anything strange: the strange part may be what is left of the other angle. So does any other command.
    Words that begin with other letters are not for a rotor: frequencies, modes, the satellite HAZEL5.
    """
    text = line.upper().decode("latin-1").replace("\t", " ").replace(";", " ")
    text = text.lstrip(NOISE)
    angles, rest, damaged = _angles(text)
    others = [(match.start(), match[0]) for match in re.finditer("[^ ]+", rest)]
    between_blanks = {match.start(): match[0] for match in re.finditer("[^ ]+", text)}
    words = {
        at: word
        for at, part in others
        if (word := _word(part, level)) and (word.verb in _STOPS or between_blanks.get(at) == part)
    }
    strange = [part for at, part in others if at not in words and not _NAMED.fullmatch(part)]
    stops = {at: word for at, word in words.items() if word.verb in _STOPS}
    values = {word.verb for word in angles.values() if word.value is not None}
    unclear = any(
        at in between_blanks and at not in stops and _is_damaged_stop(part, beside=bool(stops)) for at, part in others
    )
    halted = _BOTH_STOP if stops or unclear else ()
    if damaged:
        return halted
    if len(values) == len(_ANGLES):
        return _in_order(angles | (stops if strange else words))
    foreign = [part for at, part in others if at not in words and not _PLAIN.fullmatch(part)]
    asked = {word.verb for word in angles.values() if word.value is None}
    joined = [part for part in between_blanks.values() if _NUMBERED.search(part) and not _ANGLE.fullmatch(part)]
    if strange or joined or (values and (foreign or asked)) or (unclear and not values):
        return halted
    return _in_order(angles | words)


def _angles(text: str) -> tuple[dict[int, Word], str, bool]:
    """Each AZ and EL by its place, the text with blanks in their place, and whether one of them is damaged."""
    angles: dict[int, Word] = {}
    rest, damaged = text, False
    for match in _ANGLE.finditer(text):
        number, (begin, end) = match["number"], match.span()
        after = _AFTER.match(text, end)
        if re.fullmatch("[A-Z]", text[:begin][-1:]):
            continue  # DELTA, HAZEL5
        whole = after is not None and (after["more"] is None or bool(number and re.search("[.,][0-9]|E", number)))
        joined_question = number is None and text[:begin][-1:].strip() != ""
        angle_deg = degrees(number) if number else None
        damaged = damaged or not whole or joined_question or (number is not None and angle_deg is None)
        angles[begin] = Word(match[1], angle_deg)
        rest = rest[:begin] + " " * (end - begin) + rest[end:]
    return angles, rest, damaged


def _is_damaged_stop(part: str, *, beside: bool) -> bool:
    """`beside`: there is a stop of one axis in the line; then a word with one letter right is that of the other."""
    half = beside and bool(re.fullmatch("S[A-Z]|[A-Z][AE]", part)) and not _word(part, Level.III)
    return half or re.match("S[AE](?![A-Z])", part) is not None or is_stop(part.encode("latin-1"))


def _in_order(words: dict[int, Word]) -> tuple[Word, ...]:
    return tuple(word for _, word in sorted(words.items(), key=lambda item: item[0]))


def _word(text: str, level: Level) -> Word | None:
    for verb, pattern in _PATTERNS:
        if verb.level <= level and (match := pattern.fullmatch(text)):
            return Word(verb.text, degrees(match[1]) if match[1] else None)
    return None


def is_order(line: bytes) -> bool:
    """Whether a line without a command was meant as one: it holds a number and a word that is for a rotor."""
    return bool(re.search(rb"[0-9]", line) and re.search(rb"(?<![A-Z])(?:AZ|EL|M[LRUD]|V[LRUD])", line.upper()))


def is_whole(begun: bytes) -> bool:
    """Whether bytes without a line end are a whole order: angles with one decimal or two.

    A phone's Bluetooth terminal and some trackers send no line end. `AZ23` may still become `AZ235.0`.
    """
    return bool(_UNENDED.fullmatch(begun.upper().decode("latin-1")))


def tenths(angle_deg: float) -> str:
    """One decimal, which PstRotator needs; never `-0.0`."""
    return f"{round(angle_deg, 1) + 0.0:.1f}"


def position_reply(azimuth_deg: float | None, elevation_deg: float | None) -> bytes:
    """Both in one line (Hamlib up to 4.5), or only the axis in question (since 4.6). LF: Gpredict does not read CR."""
    named = [("AZ", azimuth_deg), ("EL", elevation_deg)]
    return (" ".join(name + tenths(angle) for name, angle in named if angle is not None) + "\n").encode()


def pstrotator_reply(azimuth_deg: float, elevation_deg: float) -> bytes:
    return f"+{tenths(azimuth_deg)} {tenths(elevation_deg)}\n".encode()


def reply(verb: str, value: int | str) -> bytes:
    """The command's name and its value."""
    return f"{verb}{value}\n".encode()


def alarm(reason: str) -> bytes:
    """The controller's message for a problem: sent in place of an answer."""
    return f"AL{reason}\n".encode()
