"""The GS-232A and GS-232B command set, as a table, with its codec.

Knows every command, how clients really write it, and every byte of a real unit's answer. Does not know what the box
does with a command: `gs232_session` does. Sources: Yaesu's manuals of the GS-232A (2000) and GS-232B (2004), pages 8 to
20, and captures of real units and of Hamlib, OscarWatch, SDRangel, WispDDE and SatPC32 (see docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

from rotator.protocols.aiming import SURE_NUMBER, degrees, whole
from rotator.protocols.damaged import NOISE, is_stop

LEAST_AZIMUTHS = 2
"""In a timed list. The manual says so, and a program that adds an elevation to an M must not turn to it."""
MAX_AZIMUTHS = 3800
MAX_PAIRS = 1900
MAX_LINE = 16_384
"""Bytes: `Msss` and 3800 azimuths of three digits and a blank."""
AZIMUTH_TOP_360_DEG = 360
AZIMUTH_TOP_450_DEG = 450

INVALID = b"?>\r\n"
SURE = b"are you sure?\r\n"
"""A GS-232B's answer to O and O2; it stores after Y."""
STORED = b"Completed.\r\n"


class Dialect(Enum):
    A = "GS-232A"
    B = "GS-232B"


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str
    screens: tuple[int, ...] = ()
    """The help lists that show it: H, H2, H3."""
    only_b: bool = False


VERBS = (
    Verb("R", "Turn clockwise", (1,)),
    Verb("L", "Turn counter-clockwise", (1,)),
    Verb("A", "Stop azimuth", (1,)),
    Verb("C", "Read azimuth", (1,)),
    Verb("M", "Maaa: go to azimuth; Msss aaa aaa ...: timed list", (1,)),
    Verb("U", "Turn up", (2,)),
    Verb("D", "Turn down", (2,)),
    Verb("E", "Stop elevation", (2,)),
    Verb("C2", "Read azimuth and elevation", (2,)),
    Verb("W", "Waaa eee: go there; Wsss aaa eee aaa eee ...: timed list", (2,)),
    Verb("T", "Run the timed list", (1, 2)),
    Verb("N", "Read point number and number of points", (1, 2)),
    Verb("X1", "Azimuth speed low", (1,)),
    Verb("X2", "Azimuth speed middle 1", (1,)),
    Verb("X3", "Azimuth speed middle 2", (1,)),
    Verb("X4", "Azimuth speed high", (1,)),
    Verb("S", "Stop everything", (1, 2)),
    Verb("O", "Azimuth stands at its zero: calibrate", (1,)),
    Verb("F", "Azimuth stands at its full scale: calibrate", (1,)),
    Verb("O2", "Elevation stands at its zero: calibrate", (2,)),
    Verb("F2", "Elevation stands at its full scale: calibrate", (2,)),
    Verb("B", "Read elevation", (2,)),
    Verb("P45", "Azimuth 0 to 450 degrees", (3,), only_b=True),
    Verb("P36", "Azimuth 0 to 360 degrees", (3,), only_b=True),
    Verb("Z", "Which way the middle of the travel points", (3,), only_b=True),
    Verb("H", "Azimuth commands"),
    Verb("H2", "Elevation commands"),
    Verb("H3", "Modes", only_b=True),
)
"""In the order of the A manual's lists; the B manual has X1 to X4 last."""
_TITLES = {1: "COMMAND LIST 1", 2: "HELP COMMAND 2", 3: "HELP COMMAND 3"}
_RULE = "-" * 10
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


class NoOrder(NotACommand):
    """An M or W without numbers, or with numbers that are no order. It clears the timed list like any other M or W."""


_PASSED_OVER = " ;\0"
"""What may follow a command: GS232-Remote ends each one with `;`, and plugging in a cable can add a NUL."""
_AXIS_STOP = re.compile("[AE][^A-Z0-9]*")
_PADDED = re.compile(r"[MW] *\d{3}(?: *\d{3})*")
_WITH_COMMA = rf"(?:{SURE_NUMBER}|[+-]?\d+,\d*(?:[eE][+-]?\d+)?)"
_ONE = re.compile(_WITH_COMMA)
_PAIRS = (
    re.compile(r"(\d{3})(\d{3})"),
    re.compile(rf"({_WITH_COMMA}),? +({_WITH_COMMA})"),
    # A comma separates the angles only where no blank does; else it is a decimal comma.
    re.compile(rf"({SURE_NUMBER}) *, *({SURE_NUMBER})"),
)
_WITHIN = re.compile(rb"[Ww] *(\d{3}) ?(\d{3})[ ;\0]*\Z")
_LIST = re.compile(r"\d{1,3}(?: +\d{1,3})+")


def parse(line: bytes, dialect: Dialect) -> Command | None:
    """From one line, without its end, to a command; None for an empty line. Raises NotACommand.

    Noise before a command (a plug, a break) is skipped, and `;` or NUL after it. Other noise makes it invalid, so that
    a damaged digit can never make a different order. Only a stop may be damaged: the person who sent it saw something
    go wrong.
    """
    text = line.decode("latin-1").replace("\t", " ").lstrip(NOISE).rstrip(" ")
    body = text.rstrip(_PASSED_OVER).upper()
    if not body:
        return None
    if is_stop(line):
        return Command("S")
    if body[0] in "MW":
        # The last digit may be what has become a `;` or a NUL: then only the manual's three digits are sure.
        if len(body) < len(text) and not _PADDED.fullmatch(body):
            raise NoOrder(body)
        return (_parse_m if body[0] == "M" else _parse_w)(body[1:].strip(" "))
    verb = _BY_TEXT.get(body) or (_BY_TEXT[body[0]] if _AXIS_STOP.fullmatch(body) else None)
    if verb is None or (verb.only_b and dialect is Dialect.A):
        raise NotACommand(body)
    return Command(body)


def order_within(line: bytes) -> Command | None:
    """A W with its angles in three digits each at the end of a line, with anything before it; None: there is none."""
    found = _WITHIN.search(line)
    return Command("W", azimuth_deg=float(found[1]), elevation_deg=float(found[2])) if found else None


def _parse_m(rest: str) -> Command:
    if _ONE.fullmatch(rest) and (azimuth_deg := degrees(rest)) is not None:
        return Command("M", azimuth_deg=azimuth_deg)
    if not _LIST.fullmatch(rest):
        raise NoOrder(rest)
    interval, *azimuths = rest.split()
    if not LEAST_AZIMUTHS <= len(azimuths) <= MAX_AZIMUTHS:
        raise NoOrder(rest)
    return Command("M", interval_s=_interval(interval), points=tuple((float(a), None) for a in azimuths))


def _parse_w(rest: str) -> Command:
    for pattern in _PAIRS:
        if pair := pattern.fullmatch(rest):
            azimuth_deg, elevation_deg = degrees(pair[1]), degrees(pair[2])
            if azimuth_deg is None or elevation_deg is None:
                raise NoOrder(rest)
            return Command("W", azimuth_deg=azimuth_deg, elevation_deg=elevation_deg)
    if not _LIST.fullmatch(rest):
        raise NoOrder(rest)
    interval, *angles = rest.split()
    if len(angles) % 2 or len(angles) > 2 * MAX_PAIRS:
        raise NoOrder(rest)
    pairs = zip(angles[::2], angles[1::2], strict=True)
    points = tuple((float(azimuth), float(elevation)) for azimuth, elevation in pairs)
    return Command("W", interval_s=_interval(interval), points=points)


def _interval(digits: str) -> int:
    if int(digits) < 1:
        raise NoOrder(digits)
    return int(digits)


def encode(command: Command) -> bytes:
    """A command as the manual writes it: whole degrees, three digits, CR."""
    numbers: list[float] = [] if command.interval_s is None else [command.interval_s]
    for azimuth_deg, elevation_deg in command.points or ((command.azimuth_deg, command.elevation_deg),):
        numbers += [angle for angle in (azimuth_deg, elevation_deg) if angle is not None]
    return (command.verb + " ".join(f"{whole(number):03d}" for number in numbers) + "\r").encode()


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


def mode_reply(top_deg: int) -> bytes:
    """The answer to P36 and P45 that clones give and programs know; the manual has none."""
    return f"Mode {top_deg} degree\r\n".encode()


def centre_reply(*, north: bool) -> bytes:
    """The answer to Z, likewise."""
    return f"{_centre(north=north)}\r\n".encode()


def help_reply(screen: int, dialect: Dialect, top_deg: int, *, north: bool) -> bytes:
    """A help list, with titles and order as in the manuals, and in the words of this table. H3 shows the modes too."""
    verbs = [verb for verb in VERBS if screen in verb.screens]
    if dialect is Dialect.B:
        verbs.sort(key=lambda verb: verb.text.startswith("X"))
    rows = [f"{_RULE} {_TITLES[screen]} {_RULE}", *(f"{verb.text:<4}{verb.help}" for verb in verbs)]
    if screen == 3:
        rows += [f"{_RULE} MODE {_RULE}", f"mode {top_deg} Degree", _centre(north=north)]
    return "".join(row + "\r\n" for row in rows).encode()


def _centre(*, north: bool) -> str:
    return "N Center" if north else "S Center"
