"""The GS-232A and GS-232B command set, as a table, with its codec.

Knows every command, how clients really write it, and every byte of a real unit's answer. Does not know what the box
does with a command: `gs232_session` does. Sources: the command lists of the GS-232A manual, and captures of real units
and of Hamlib, OscarWatch, SDRangel, WispDDE and SatPC32 (see docs/protocols.md).
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from enum import Enum

MAX_AZIMUTHS = 3800
MAX_PAIRS = 1900
MAX_LINE = 16_384
"""Bytes: `Msss` and 3800 azimuths of three digits and a blank."""
AZIMUTH_TOP_360_DEG = 360
AZIMUTH_TOP_450_DEG = 450
ELEVATION_TOP_DEG = 180

INVALID = b"?>\r\n"


class Dialect(Enum):
    A = "GS-232A"
    B = "GS-232B"


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str
    screen: int
    """The help list that shows it: H, H2 or H3."""
    only_b: bool = False


VERBS = (
    Verb("R", "Turn clockwise", 1),
    Verb("L", "Turn counter-clockwise", 1),
    Verb("A", "Stop azimuth", 1),
    Verb("C", "Read azimuth", 1),
    Verb("M", "Maaa: go to azimuth; Msss aaa aaa ...: timed list", 1),
    Verb("T", "Run the timed list", 1),
    Verb("N", "Read point number and number of points", 1),
    Verb("X1", "Azimuth speed low", 1),
    Verb("X2", "Azimuth speed middle 1", 1),
    Verb("X3", "Azimuth speed middle 2", 1),
    Verb("X4", "Azimuth speed high", 1),
    Verb("S", "Stop everything", 1),
    Verb("O", "Azimuth stands at its zero: calibrate", 1),
    Verb("F", "Azimuth stands at its full scale: calibrate", 1),
    Verb("H", "This list", 1),
    Verb("U", "Turn up", 2),
    Verb("D", "Turn down", 2),
    Verb("E", "Stop elevation", 2),
    Verb("B", "Read elevation", 2),
    Verb("C2", "Read azimuth and elevation", 2),
    Verb("W", "Waaa eee: go there; Wsss aaa eee aaa eee ...: timed list", 2),
    Verb("O2", "Elevation stands at its zero: calibrate", 2),
    Verb("F2", "Elevation stands at its full scale: calibrate", 2),
    Verb("H2", "This list", 2),
    Verb("P36", "Azimuth 0 to 360 degrees", 3, only_b=True),
    Verb("P45", "Azimuth 0 to 450 degrees", 3, only_b=True),
    Verb("Z", "Which way the middle of the travel points", 3, only_b=True),
    Verb("H3", "This list", 3, only_b=True),
)
_BY_TEXT = {verb.text: verb for verb in VERBS}


@dataclass(frozen=True, slots=True)
class Command:
    """One understood line."""

    verb: str
    azimuth_deg: float | None = None
    elevation_deg: float | None = None
    interval_s: int | None = None
    points: tuple[tuple[float, float | None], ...] = ()


class NotACommand(ValueError):  # noqa: N818 - it is an answer, not a failure of the program
    """The line is no command; the unit answers `?>`."""


_NUMBER = r"\d{1,3}(?:[.,]\d{1,6})?"
_GLUED = re.compile(r"(\d{3})(\d{3})")
_BLANK_BETWEEN = re.compile(rf"({_NUMBER}) +({_NUMBER})")
# A comma separates the angles only where no blank does; else it is a decimal comma.
_COMMA_BETWEEN = re.compile(r"(\d{1,3}(?:\.\d{1,6})?) *, *(\d{1,3}(?:\.\d{1,6})?)")
_ONE = re.compile(rf"({_NUMBER})")
_LIST = re.compile(r"\d{1,3}(?: +\d{1,3})+")


def parse(line: bytes, dialect: Dialect) -> Command | None:
    """From one line, without its end, to a command; None for an empty line. Raises NotACommand.

    Noise before a command (a plug, a break) is skipped. Noise within or after a command makes it invalid, so that a
    damaged digit can never make a different order.
    """
    text = line.decode("latin-1").replace("\t", " ")
    text = text.lstrip("".join(map(chr, (*range(0x20), *range(0x7F, 0x100)))) + " ").rstrip(" ").upper()
    if not text:
        # A line that holds only noise is treated as empty: no answer.
        return None
    verb = _BY_TEXT.get(text)
    if verb is not None and text not in ("W", "M"):
        if verb.only_b and dialect is Dialect.A:
            raise NotACommand(text)
        return Command(text)
    match text[0], text[1:].strip(" "):
        case "M", "":
            return Command("M")
        case "M", rest:
            return _parse_m(rest)
        case "W", rest:
            return _parse_w(rest)
    raise NotACommand(text)


def _parse_m(rest: str) -> Command:
    if one := _ONE.fullmatch(rest):
        return Command("M", azimuth_deg=_azimuth(one[1]))
    if not _LIST.fullmatch(rest):
        raise NotACommand(rest)
    interval, *azimuths = rest.split()
    if len(azimuths) > MAX_AZIMUTHS:
        raise NotACommand(rest)
    return Command("M", interval_s=_interval(interval), points=tuple((_azimuth(a), None) for a in azimuths))


def _parse_w(rest: str) -> Command:
    pair = _GLUED.fullmatch(rest) or _BLANK_BETWEEN.fullmatch(rest) or _COMMA_BETWEEN.fullmatch(rest)
    if pair:
        return Command("W", azimuth_deg=_azimuth(pair[1]), elevation_deg=_elevation(pair[2]))
    if not _LIST.fullmatch(rest):
        raise NotACommand(rest)
    interval, *angles = rest.split()
    if len(angles) % 2 or len(angles) > 2 * MAX_PAIRS:
        raise NotACommand(rest)
    pairs = zip(angles[::2], angles[1::2], strict=True)
    points = tuple((_azimuth(azimuth), _elevation(elevation)) for azimuth, elevation in pairs)
    return Command("W", interval_s=_interval(interval), points=points)


def _azimuth(digits: str) -> float:
    return _angle(digits, AZIMUTH_TOP_450_DEG)


def _elevation(digits: str) -> float:
    return _angle(digits, ELEVATION_TOP_DEG)


def _angle(digits: str, top_deg: int) -> float:
    angle_deg = float(digits.replace(",", "."))
    if angle_deg > top_deg:
        raise NotACommand(digits)
    return angle_deg


def _interval(digits: str) -> int:
    if int(digits) < 1:
        raise NotACommand(digits)
    return int(digits)


def encode(command: Command) -> bytes:
    """A command as the manual writes it: whole degrees, three digits, CR."""
    numbers: list[float] = [] if command.interval_s is None else [command.interval_s]
    for azimuth_deg, elevation_deg in command.points or ((command.azimuth_deg, command.elevation_deg),):
        numbers += [angle for angle in (azimuth_deg, elevation_deg) if angle is not None]
    return (command.verb + " ".join(f"{whole(number):03d}" for number in numbers) + "\r").encode()


def whole(angle_deg: float) -> int:
    """Rounded to whole degrees, half up."""
    return math.floor(angle_deg + 0.5)


def azimuth_reply(dialect: Dialect, azimuth_deg: float) -> bytes:
    return _field(dialect, "AZ", azimuth_deg) + b"\r\n"


def elevation_reply(dialect: Dialect, elevation_deg: float) -> bytes:
    return _field(dialect, "EL", elevation_deg) + b"\r\n"


def position_reply(dialect: Dialect, azimuth_deg: float, elevation_deg: float) -> bytes:
    """The answer to C2: `+0235+0025` or `AZ=235  EL=025`, two blanks, CR LF."""
    gap = b"" if dialect is Dialect.A else b"  "
    return _field(dialect, "AZ", azimuth_deg) + gap + _field(dialect, "EL", elevation_deg) + b"\r\n"


def _field(dialect: Dialect, name: str, angle_deg: float) -> bytes:
    # A unit sends three digits and no sign: below zero it sends zero.
    digits = f"{max(0, whole(angle_deg)):03d}"
    return (f"+0{digits}" if dialect is Dialect.A else f"{name}={digits}").encode()


def count_reply(point: int, points: int) -> bytes:
    """The answer to N: the present point's number and how many there are."""
    return f"+{point:04d}+{points:04d}\r\n".encode()


def help_reply(screen: int, dialect: Dialect) -> bytes:
    rows = [f"--- COMMAND LIST {screen} ---"]
    rows += [f"{v.text:<4}{v.help}" for v in VERBS if v.screen == screen and not (v.only_b and dialect is Dialect.A)]
    return "".join(row + "\r\n" for row in rows).encode()
