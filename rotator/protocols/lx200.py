"""Meade's LX200 telescope protocol, ended by `#`: the command table, and the codec of its numbers.

Knows hours, degrees, minutes and seconds as LX200 writes them, and finds commands in a stream of bytes. Does not know
what a command makes the box do: `lx200_session` does. Sources: Meade's telescope protocol of October 2010, and what
Hamlib 4.5 (model 1801) and Stellarium send (see docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

from rotator.protocols.aiming import whole

MAX_COMMAND = 32
ACK = 0x06
"""The question for the kind of mount, a byte alone."""
COLON, HASH = ord(":"), ord("#")
STOP = "Q"
_STOPS, _LINE_ENDS = b"Qq", b"\r\n"
DEGREE = b"\xdf"
"""The degree sign in answers. Stellarium wants this byte; other programs read any."""


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list. `takes`: an example of what follows the letters; empty: nothing does."""

    text: str
    help: str
    takes: str = ""


VERBS = (
    Verb("GR", "Read right ascension (JNow)"),
    Verb("GD", "Read declination (JNow)"),
    Verb("GA", "Read elevation"),
    Verb("GZ", "Read azimuth"),
    Verb("Sr", "Set the target's right ascension", "15:44:00"),
    Verb("Sd", "Set the target's declination", "+19*10:00"),
    Verb("MS", "Go to the target and follow the sky"),
    Verb("Sz", "Set the target's azimuth", "235*00"),
    Verb("Sa", "Set the target's elevation", "+25*00"),
    Verb("MA", "Go to azimuth and elevation"),
    Verb(STOP, "Stop everything"),
    Verb("Qn", "Stop elevation and following; `Qs` too"),
    Verb("Qe", "Stop azimuth and following; `Qw` too"),
    Verb("Mn", "Turn up until stopped"),
    Verb("Ms", "Turn down until stopped"),
    Verb("Mw", "Turn clockwise until stopped"),
    Verb("Me", "Turn counter-clockwise until stopped"),
    Verb("hP", "Go to the park position"),
    Verb("D", "Moving: a bar"),
    Verb("U", "Short numbers, as at first, or long ones"),
    Verb("Gr", "Read the target's right ascension"),
    Verb("Gd", "Read the target's declination"),
    Verb("GS", "Read the sidereal time"),
    Verb("GL", "Read the time (UTC)"),
    Verb("GC", "Read the date"),
    Verb("GG", "Read the hours to UTC"),
    Verb("Gt", "Read the station's latitude"),
    Verb("Gg", "Read its longitude, to the west"),
    Verb("GVP", "Read the product's name"),
    Verb("CM", "Sync: [commissioning](../commissioning.md) does that"),
    Verb("St", "Set the latitude: ignored, `[station]` counts", "+52*22"),
    Verb("Sg", "Set the longitude: ignored", "351*10"),
    Verb("SL", "Set the time: ignored, the Pi's clock counts", "18:00:00"),
    Verb("SC", "Set the date: ignored", "11/22/26"),
    Verb("SG", "Set the hours to UTC: ignored", "+00"),
)
_BY_LENGTH = sorted(VERBS, key=lambda verb: -len(verb.text))
_SEPARATOR = "[*\u00df\u00b0:]"
_SECONDS = r"(?::(\d{2})(?:\.\d*)?|'(\d{2}))?"
_HOURS = re.compile(r" ?(\d{1,2}):(\d{2})(?:\.(\d)\d*|:(\d{2})(?:\.\d*)?)?")
_SIGNED = re.compile(rf" ?([+-]?)(\d{{1,2}}){_SEPARATOR}(\d{{2}}){_SECONDS}")
_AROUND = re.compile(rf" ?(\d{{1,3}}){_SEPARATOR}(\d{{2}}){_SECONDS}")
_SIXTY = 60


@dataclass(frozen=True, slots=True)
class Command:
    verb: str
    value: str = ""


class Kind(Enum):
    """What the bytes of a connection are cut into besides commands."""

    MOUNT = "the question for the kind of mount"
    UNKNOWN = "no command"


@dataclass(slots=True)
class CommandReader:
    """Finds commands in a stream of bytes, in bounded memory. Bytes before a `:` are skipped."""

    _begun: bytearray | None = None
    _before: int = HASH

    def feed(self, data: bytes) -> list[Command | Kind]:
        found: list[Command | Kind] = []
        for octet in data:
            if self._begun is None:
                if octet == ACK:
                    found.append(Kind.MOUNT)
                elif octet == COLON:
                    self._begun = bytearray()
                elif octet == HASH and self._before in _STOPS:
                    found.append(Command(STOP))
            elif octet == HASH or (octet in _LINE_ENDS and self._begun[:1].upper() == STOP.encode()):
                found.append(parse(bytes(self._begun)))
                self._begun = None
            else:
                if len(self._begun) > MAX_COMMAND:
                    # A `#` got lost. What the end says may still be a stop.
                    del self._begun[:1]
                self._begun.append(octet)
            self._before = octet
        return found


def parse(text: bytes) -> Command | Kind:
    """The command between `:` and `#`. What holds a damaged stop is a stop; other damaged text is no command."""
    words = text.decode("latin-1")
    if len(text) <= MAX_COMMAND and f":{STOP}" not in words:
        for verb in _BY_LENGTH:
            if words == verb.text and not verb.takes:
                return Command(verb.text)
            if verb.takes and words.startswith(verb.text):
                return Command(verb.text, words[len(verb.text) :])
        if words in ("Qs", "Qw"):
            return Command({"Qs": "Qn", "Qw": "Qe"}[words])
    return Command(STOP) if STOP in words.upper() else Kind.UNKNOWN


def hours(text: str) -> float | None:
    """`15:44:00` or `15:44.0` in degrees; None: the text is no right ascension."""
    if not (found := _HOURS.fullmatch(text)):
        return None
    hour, minute = int(found[1]), int(found[2])
    second = int(found[3]) * 6 if found[3] else int(found[4] or 0)
    if hour >= 24 or minute >= _SIXTY or second > _SIXTY:
        return None
    return (hour + minute / 60 + second / 3600) * 15.0


def signed(text: str) -> float | None:
    """`+19*10`, `-05*30:15`: degrees from -90 to 90. None: the text is no such angle."""
    found = _SIGNED.fullmatch(text)
    if not found or (degrees := _sexagesimal(found[2], found[3], found[4] or found[5])) is None or degrees > 90.0:
        return None
    return -degrees if found[1] == "-" else degrees


def around(text: str) -> float | None:
    """`235*00`: degrees from 0 to 360. None: the text is no such angle."""
    found = _AROUND.fullmatch(text)
    if not found or (degrees := _sexagesimal(found[1], found[2], found[3] or found[4])) is None or degrees > 360.0:
        return None
    return degrees


def _sexagesimal(degrees: str, minutes: str, seconds: str | None) -> float | None:
    """Hamlib rounds to 60 minutes where it means a degree more."""
    if int(minutes) > _SIXTY or int(seconds or 0) > _SIXTY:
        return None
    return int(degrees) + int(minutes) / 60 + int(seconds or 0) / 3600


def encode(verb: Verb) -> bytes:
    """An example of a command, as a program writes it."""
    return f":{verb.text}{verb.takes}#".encode()


def hours_reply(right_ascension_deg: float, *, long: bool) -> bytes:
    """`15:44:00#`, short `15:44.0#`."""
    if long:
        hour, minute, second = _cut(right_ascension_deg / 15.0 * 3600, 24)
        return b"%02d:%02d:%02d#" % (hour, minute, second)
    tenths = whole(right_ascension_deg / 15.0 * 600) % (24 * 600)
    return b"%02d:%02d.%d#" % (tenths // 600, tenths % 600 // 10, tenths % 10)


def signed_reply(angle_deg: float, *, long: bool) -> bytes:
    """`+19ß10:00#`, short `+19ß10#`; ß stands for DEGREE."""
    return (b"-" if angle_deg < 0 else b"+") + _degrees_reply(abs(angle_deg), 2, 91, long=long)


def around_reply(angle_deg: float, *, long: bool) -> bytes:
    """`235ß00:00#`, short `235ß00#`; 0 to below 360."""
    return _degrees_reply(angle_deg % 360.0, 3, 360, long=long)


def _degrees_reply(angle_deg: float, digits: int, around: int, *, long: bool) -> bytes:
    degrees, minute, second = _cut(angle_deg * 3600 if long else whole(angle_deg * 60) * 60, around)
    head = b"%0*d%b%02d" % (digits, degrees, DEGREE, minute)
    return head + (b":%02d#" % second if long else b"#")


def _cut(seconds: float, around: int) -> tuple[int, int, int]:
    """Whole hours or degrees, minutes, seconds; from `around` on it begins again."""
    rounded_s = whole(seconds)
    return rounded_s // 3600 % around, rounded_s // 60 % 60, rounded_s % 60
