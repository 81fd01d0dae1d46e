"""What ready-made controllers understand: ask for the angle, go there, stop; and what they answer. Bytes only.

One table for the protocols in text, one class for SPID's frames. Knows no port, no clock, and not what is ordered.
Sources: Yaesu's GS-232A and GS-232B manuals, EasyComm's own description and SatNOGS' firmware, Hamlib's rotctld(1),
LA6YKA's and SPID's description of Rot1Prog, Rot2Prog and MD-01, Idiom Press' command reference for the DCU-1.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from hw.ports import Axis, HardwareError

Place = tuple[float, ...]
"""One answer: degrees of azimuth, and of elevation where the controller has both; as the controller counts them."""
KEPT = 64
"""So many bytes that made no answer are kept, for the words of a fault and for an answer that is half there."""


class Codec(Protocol):
    """One controller's language. `junk`: what came since the last answer and was none."""

    junk: bytes

    def ask(self) -> bytes:
        """The question for the angle."""

    def move(self, place: Place) -> bytes:
        """The order to go there; empty: not before the first answer."""

    def stop(self) -> bytes:
        """Stop every axis."""

    def feed(self, data: bytes) -> list[Place]:
        """The answers that end in `data`, which may be any piece of the stream."""

    def begin(self) -> None:
        """A new connection: half an answer of the old one is worth nothing."""


@dataclass(frozen=True, slots=True)
class Words:
    """A protocol in text: question, order, and the shape of the answer, for one axis."""

    ask: str
    move: str
    answer: str


@dataclass(frozen=True, slots=True)
class Language:
    """What is said to a controller of both axes, of the azimuth, and of the elevation; None: it has azimuths only, and
    an elevation is one for it."""

    stop: str
    azimuth: Words
    both: Words | None = None
    elevation: Words | None = None


_NUMBER = r"([+-]?\d+(?:\.\d+)?)"
_GS232 = Language(
    "S\r",
    # A GS-232A writes +0123+0045, a GS-232B AZ=123  EL=045, and their copies either.
    Words("C\r", "M{0:03.0f}\r", r"(?:\+0|AZ=)(-?\d+)\s*[\r\n]"),
    Words("C2\r", "W{0:03.0f} {1:03.0f}\r", r"(?:\+0|AZ=)(-?\d+)\s*(?:\+0|EL=)(-?\d+)\s*[\r\n]"),
    Words("B\r", "W000 {0:03.0f}\r", r"(?:\+0|EL=)(-?\d+)\s*[\r\n]"),
)
_EASYCOMM = Language(
    "SA SE\n",
    Words("AZ\n", "AZ{0:.1f}\n", rf"AZ{_NUMBER}\s"),
    Words("AZ EL\n", "AZ{0:.1f} EL{1:.1f}\n", rf"AZ{_NUMBER}\s+EL{_NUMBER}\s"),
    Words("EL\n", "EL{0:.1f}\n", rf"EL{_NUMBER}\s"),
)
_FIRST, _LINE = r"(?:^|(?<=\n))", r"(-?\d+\.\d+)\n"
# A rotctld has two axes in its answers, also in front of a rotor with one.
_ROTCTLD = Language(
    "S\n",
    Words("p\n", "P {0:.2f} 0.00\n", rf"{_FIRST}{_LINE}-?\d+\.\d+\n"),
    Words("p\n", "P {0:.2f} {1:.2f}\n", rf"{_FIRST}{_LINE}{_LINE}"),
    Words("p\n", "P 0.00 {0:.2f}\n", rf"{_FIRST}-?\d+\.\d+\n{_LINE}"),
)
TEXT: dict[str, Language] = {
    "gs232a": _GS232,
    "gs232b": _GS232,
    "easycomm2": _EASYCOMM,
    "easycomm3": _EASYCOMM,
    "rotctld": _ROTCTLD,
    "dcu1": Language(";", Words("AI1;", "AP1{0:03.0f};AM1;", r";\s?(\d{3})")),
}


class TextCodec:
    """`axes`: those that the controller turns. It is asked for them alone."""

    def __init__(self, language: Language, axes: Sequence[Axis]) -> None:
        match axes:
            case [Axis.AZIMUTH]:
                words: Words | None = language.azimuth
            case [Axis.ELEVATION]:
                words = language.elevation or language.azimuth
            case _:
                words = language.both
        if words is None:
            raise HardwareError("this protocol has an azimuth only: give the elevation a controller of its own")
        self.junk = b""
        self._words = words
        self._stop = language.stop.encode()
        self._answer = re.compile(words.answer.encode())
        self._buffer = b""

    def ask(self) -> bytes:
        return self._words.ask.encode()

    def move(self, place: Place) -> bytes:
        return self._words.move.format(*place).encode()

    def stop(self) -> bytes:
        return self._stop

    def begin(self) -> None:
        self._buffer = self.junk = b""

    def feed(self, data: bytes) -> list[Place]:
        self._buffer += data
        answers: list[Place] = []
        while found := self._answer.search(self._buffer):
            answers.append(tuple(float(part) for part in found.groups()))
            self._buffer, self.junk = self._buffer[found.end() :], b""
        self._buffer = self._buffer[-KEPT:]
        self.junk = self._buffer.strip()
        return answers


START, END, OFFSET_DEG = 0x57, 0x20, 360
STATUS, SET, STOP = 0x1F, 0x2F, 0x0F
FRAME, ANSWER, SHORT_ANSWER = 13, 12, 5


class SpidCodec:
    """SPID's 13 bytes. `short`: a Rot1Prog, with one axis and whole degrees.

    The others take an angle in their own pulses to a degree, and say how many those are in each answer.
    """

    def __init__(self, axes: Sequence[Axis], *, short: bool) -> None:
        if short and len(axes) > 1:
            raise HardwareError("a Rot1Prog turns one axis: give the elevation a controller of its own")
        self.junk = b""
        self._length = SHORT_ANSWER if short else ANSWER
        self._short = short
        self._parts = [0] if short else [list(Axis).index(axis) for axis in axes]
        """Of azimuth and elevation, those that it turns."""
        self._pulses = (1, 1) if short else None
        self._buffer = b""

    def ask(self) -> bytes:
        return _frame(STATUS)

    def move(self, place: Place) -> bytes:
        if self._short:
            return _frame(SET, b"%03d0" % round(place[0] + OFFSET_DEG), 1)
        if self._pulses is None:
            return b""
        both_deg = dict(zip(self._parts, place, strict=True))
        azimuth, elevation = (
            b"%04d" % round((both_deg.get(part, 0.0) + OFFSET_DEG) * pulses) for part, pulses in enumerate(self._pulses)
        )
        return _frame(SET, azimuth, self._pulses[0], elevation, self._pulses[1])

    def stop(self) -> bytes:
        return _frame(STOP)

    def begin(self) -> None:
        self._buffer = self.junk = b""

    def feed(self, data: bytes) -> list[Place]:
        self._buffer += data
        answers: list[Place] = []
        at = 0
        while (at := self._buffer.find(START, at)) >= 0 and len(self._buffer) - at >= self._length:
            place = self._decode(self._buffer[at : at + self._length])
            if place is None:
                at += 1
                continue
            answers.append(place)
            self._buffer, at = self._buffer[at + self._length :], 0
        self._buffer = self._buffer[-KEPT:]
        self.junk = self._buffer
        return answers

    def _decode(self, octets: bytes) -> Place | None:
        """The angles in an answer; None: these bytes are none. A digit is a byte of that value."""
        if octets[-1] != END or any(digit > 9 for digit in octets[1:4]):
            return None
        if self._short:
            return (_degrees(octets[1:4]),)
        pulses = octets[5], octets[10]
        if not all(pulses) or any(digit > 9 for digit in octets[1:5] + octets[6:10]):
            return None
        self._pulses = pulses
        both = _degrees(octets[1:5]), _degrees(octets[6:10])
        return tuple(both[part] for part in self._parts)


def _degrees(digits: bytes) -> float:
    """Hundreds, tens, ones, and tenths where there are four."""
    return sum(digit * 10.0 ** (2 - place) for place, digit in enumerate(digits)) - OFFSET_DEG


def _frame(command: int, azimuth: bytes = bytes(4), ph: int = 0, elevation: bytes = bytes(4), pv: int = 0) -> bytes:
    return bytes([START, *azimuth, ph, *elevation, pv, command, END])


def codec(protocol: str, axes: Sequence[Axis]) -> Codec:
    """The codec of that protocol, for a controller that turns these axes. Raises HardwareError: it cannot turn two."""
    match protocol:
        case "rot2prog" | "md01":
            return SpidCodec(axes, short=False)
        case "rot1prog":
            return SpidCodec(axes, short=True)
        case _:
            return TextCodec(TEXT[protocol], axes)
