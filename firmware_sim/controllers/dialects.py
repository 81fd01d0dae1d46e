"""What each simulated controller understands, and what it answers, byte by byte as its manual has it.

Knows bytes and degrees. Knows no line and no motor. Shares nothing with the driver: a mistake there is not made here.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

Place = tuple[float | None, float | None]
"""Azimuth and elevation; None: the command does not speak of it."""


class Act(Enum):
    """What a command makes the controller do."""

    TELL = "tell"
    GO = "go"
    STOP = "stop"
    PRESET = "preset"
    """Take a target, and do not go yet."""
    START = "start"
    """Go to the preset target."""
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True)
class Heard:
    """One command. `angles_deg`: of a GO or a PRESET, azimuth first."""

    act: Act
    angles_deg: Place = (None, None)
    reply: bytes = b""
    """What it answers beside its position."""
    tells: str = ""
    """The axes whose position it answers: a, e, or both."""


@dataclass(frozen=True, slots=True)
class Dialect:
    """`take` cuts the first command off a buffer: what was heard (None: no whole command yet), and the rest."""

    take: Callable[[bytes], tuple[Heard | None, bytes]]
    position: Callable[[float, float, str], bytes]
    """From azimuth, elevation, and the axes that were asked for."""
    step_deg: float
    """It measures its angle in steps of this."""


Row = tuple[str, Act, bytes, str]
"""The shape of a command, what it does, what it answers, and the axes whose position it answers."""


def _lines(*rows: Row) -> Callable[[bytes], tuple[Heard | None, bytes]]:
    table = [(re.compile(shape.encode()), act, reply, tells) for shape, act, reply, tells in rows]

    def take(buffer: bytes) -> tuple[Heard | None, bytes]:
        for shape, act, reply, tells in table:
            if found := shape.match(buffer):
                parts = {name: float(part) for name, part in found.groupdict().items()}
                place = parts.get("a"), parts.get("e")
                return Heard(act, place, reply, tells), buffer[found.end() :]
        return None, buffer

    return take


def _gs232(azimuth: str, elevation: str) -> Dialect:
    def position(azimuth_deg: float, elevation_deg: float, tells: str) -> bytes:
        words = azimuth.format(round(azimuth_deg)) if "a" in tells else ""
        words += elevation.format(round(elevation_deg)) if "e" in tells else ""
        return (words.lstrip() + "\r\n").encode()

    rows: tuple[Row, ...] = (
        (r"C2\r", Act.TELL, b"", "ae"),
        (r"C\r", Act.TELL, b"", "a"),
        (r"B\r", Act.TELL, b"", "e"),
        (r"W(?P<a>\d{3}) (?P<e>\d{3})\r", Act.GO, b"", ""),
        (r"M(?P<a>\d{3})\r", Act.GO, b"", ""),
        (r"[SAE]\r", Act.STOP, b"", ""),
        (r"\s", Act.NOTHING, b"", ""),
        (r"[^\r]*\r", Act.NOTHING, b"?>\r\n", ""),
    )
    return Dialect(_lines(*rows), position, 1.0)


_A, _E = r"(?P<a>-?\d+(?:\.\d+)?)", r"(?P<e>-?\d+(?:\.\d+)?)"
_EASYCOMM = Dialect(
    _lines(
        (r"AZ EL\s*\n", Act.TELL, b"", "ae"),
        (r"AZ\s*\n", Act.TELL, b"", "a"),
        (r"EL\s*\n", Act.TELL, b"", "e"),
        (rf"AZ{_A} EL{_E}[^\n]*\n", Act.GO, b"", ""),
        (rf"AZ{_A}\s*\n", Act.GO, b"", ""),
        (rf"EL{_E}\s*\n", Act.GO, b"", ""),
        (r"SA SE\s*\n", Act.STOP, b"", ""),
        (r"[^\n]*\n", Act.NOTHING, b"", ""),
    ),
    lambda azimuth_deg, elevation_deg, tells: (
        " ".join([f"AZ{azimuth_deg:.1f}"] * ("a" in tells) + [f"EL{elevation_deg:.1f}"] * ("e" in tells)) + "\n"
    ).encode(),
    0.1,
)
_ROTCTLD = Dialect(
    _lines(
        (r"p\n", Act.TELL, b"", "ae"),
        (rf"P {_A} {_E}\n", Act.GO, b"RPRT 0\n", ""),
        (r"S\n", Act.STOP, b"RPRT 0\n", ""),
        (r"[^\n]*\n", Act.NOTHING, b"RPRT -11\n", ""),
    ),
    lambda azimuth_deg, elevation_deg, _tells: f"{azimuth_deg:.6f}\n{elevation_deg:.6f}\n".encode(),
    1.0,
)
"""In front of a rotor in whole degrees, as Hamlib's rotctld is in front of a GS-232."""
_DCU1 = Dialect(
    _lines(
        (r"AI1;", Act.TELL, b"", "a"),
        (r"AP1(?P<a>\d{3});", Act.PRESET, b"", ""),
        (r"AM1;", Act.START, b"", ""),
        (r";", Act.STOP, b"", ""),
        (r"[^;]*;", Act.NOTHING, b"", ""),
    ),
    lambda azimuth_deg, _elevation_deg, _tells: f";{round(azimuth_deg) % 360:03d}".encode(),
    1.0,
)

_FRAME = 13
_ACTS = {0x0F: Act.STOP, 0x1F: Act.TELL, 0x2F: Act.GO}


def _spid(pulses: int, *, short: bool = False, answers: frozenset[Act]) -> Dialect:
    """`pulses` to a degree. `answers`: the commands after which it tells its position."""

    def take(buffer: bytes) -> tuple[Heard | None, bytes]:
        buffer = buffer[max(buffer.find(b"W"), 0) :]
        if len(buffer) < _FRAME:
            return None, buffer
        frame, rest = buffer[:_FRAME], buffer[_FRAME:]
        act = _ACTS.get(frame[11])
        if frame[0] != ord("W") or frame[12] != 0x20 or act is None:
            return Heard(Act.NOTHING), buffer[1:]
        tells = "ae" if act in answers else ""
        if act is not Act.GO:
            return Heard(act, tells=tells), rest
        if not frame[1:5].isdigit() or not (short or frame[6:10].isdigit()):
            return Heard(Act.NOTHING), rest
        if short:
            return Heard(act, (int(frame[1:4]) - 360.0, None), tells=tells), rest
        return Heard(act, (int(frame[1:5]) / pulses - 360.0, int(frame[6:10]) / pulses - 360.0), tells=tells), rest

    def digits(angle_deg: float) -> list[int]:
        return [int(digit) for digit in f"{round((angle_deg + 360.0) * 10):04d}"]

    def position(azimuth_deg: float, elevation_deg: float, _tells: str) -> bytes:
        if short:
            return bytes([0x57, *digits(azimuth_deg)[:3], 0x20])
        return bytes([0x57, *digits(azimuth_deg), pulses, *digits(elevation_deg), pulses, 0x20])

    return Dialect(take, position, 1.0 / pulses)


_ANSWERS = frozenset({Act.TELL, Act.STOP})
DIALECTS = {
    "gs232a": _gs232("+0{:03d}", "+0{:03d}"),
    "gs232b": _gs232("AZ={:03d}", "  EL={:03d}"),
    "easycomm2": _EASYCOMM,
    "easycomm3": _EASYCOMM,
    "rotctld": _ROTCTLD,
    "dcu1": _DCU1,
    "rot1prog": _spid(1, short=True, answers=_ANSWERS),
    "rot2prog": _spid(2, answers=_ANSWERS),
    "md01": _spid(10, answers=_ANSWERS | {Act.GO}),
}
