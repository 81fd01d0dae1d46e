r"""The bytes of the links as text, one line for each piece, from which a program gets the exact bytes back.

    # rotator 1.0, 2026-11-21
    # link gs232b {"protocol": "gs232b", "pty": "run/gs232"}
    # at 235.00 25.00, under gs232b#1
    # rotctld#2 comes from 192.168.1.20
    # `at`: azimuth and elevation, degrees on the rotor's own scale
    # h:m:s here  link#connection  > received, < sent  bytes
    18:03:22.114 gs232b#1 > W235 025\r
    18:03:22.301 gs232b#1 < AZ=235  EL=025\r\n
    18:03:22.377 md01#1 > \hex 57 00 00 00 00 00 00 00 00 00 00 1F 20

`>` marks bytes that the box received, `<` bytes that it sent. The escapes are \\, \r, \n, \t, and \x with two hex
digits. Bytes of a binary protocol are `\hex` and pairs of digits. A blank at the end is \x20, because editors remove
blanks there. Other lines that begin with # are remarks.

Knows how to write and read this form. Does not know links, files or clocks.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from enum import Enum

from rotator.exchange.foreign import json_of
from rotator.exchange.sources import Source


class Way(Enum):
    IN = ">"
    OUT = "<"


@dataclass(frozen=True, slots=True)
class Piece:
    """Bytes that the box received or sent in one piece."""

    day_s: float
    """Seconds since midnight, local time."""
    source: Source
    way: Way
    data: bytes


@dataclass(frozen=True, slots=True)
class LinkNote:
    """A link, with the keys of its table in the configuration."""

    name: str
    keys: Mapping[str, object]


@dataclass(frozen=True, slots=True)
class At:
    """Where the antenna pointed, in degrees on the rotor's own scale."""

    azimuth_deg: float
    elevation_deg: float
    under: str = ""
    """The source whose orders the antenna obeyed; empty: no source."""


@dataclass(frozen=True, slots=True)
class Peer:
    """The machine at the other end of a network connection."""

    source: Source
    host: str
    """The machine's address."""


@dataclass(frozen=True, slots=True)
class Remark:
    text: str


HEADS = (
    "# `at`: azimuth and elevation, degrees on the rotor's own scale",
    "# h:m:s here  link#connection  > received, < sent  bytes",
)
"""The meaning of the columns, for a person who watches."""

Entry = Piece | LinkNote | At | Peer | Remark


class NotATranscript(ValueError):  # noqa: N818 - a fault of the text, not of the program
    """A line, or its bytes, cannot be read. The text shows the line."""


_ESCAPES = {0x5C: "\\\\", 0x0D: "\\r", 0x0A: "\\n", 0x09: "\\t"}
_PARTS = re.compile(r"\\(\\|r|n|t|x[0-9a-fA-F]{2})|([ -\[\]-~])")
_MEANT = {"\\": "\\", "r": "\r", "n": "\n", "t": "\t"}
_HEX = "\\hex "
_PIECE = re.compile(r"(\d\d):(\d\d):(\d\d\.\d{3}) ([^<>]+?)(?:#(\d+))? ([<>]) (.+)")
_LINK = re.compile(r"# link (.+?) (\{.*\})")
_ANGLE = r"(-?\d{1,3}(?:\.\d+)?)"
_AT = re.compile(rf"# at {_ANGLE} {_ANGLE}(?:, under (.+))?")
_PEER = re.compile(r"# (.+?)(?:#(\d+))? comes from (\S+)")


def parse(line: str) -> Entry:
    """One line, without its end. Raises NotATranscript."""
    if link := _LINK.fullmatch(line):
        return LinkNote(link[1], _keys(link[2]))
    if at := _AT.fullmatch(line):
        return At(float(at[1]), float(at[2]), at[3] or "")
    if peer := _PEER.fullmatch(line):
        return Peer(Source(peer[1], int(peer[2] or 0)), peer[3])
    if line.startswith("#") or not line:
        return Remark(line.removeprefix("#").strip())
    if piece := _PIECE.fullmatch(line):
        hours, minutes, seconds, name, number, way, text = piece.groups()
        day_s = 3600 * int(hours) + 60 * int(minutes) + float(seconds)
        return Piece(day_s, Source(name, int(number or 0)), Way(way), unescape(text))
    raise NotATranscript(f"{line!r} is no line of a transcript")


def encode_piece(moment: datetime, source: Source, way: Way, data: bytes, *, text: bool = True) -> str:
    """The line for one piece. `text`: write characters; else pairs of hexadecimal digits, for a binary protocol."""
    written = escape(data) if text else _HEX + data.hex(" ").upper()
    return f"{moment:%H:%M:%S}.{moment.microsecond // 1000:03d} {source} {way.value} {written}"


def encode_link(note: LinkNote) -> str:
    return f"# link {note.name} {json.dumps(note.keys)}"


def encode_peer(peer: Peer) -> str:
    return f"# {peer.source} comes from {peer.host}"


def encode_at(at: At) -> str:
    under = f", under {at.under}" if at.under else ""
    return f"# at {at.azimuth_deg:z.2f} {at.elevation_deg:z.2f}{under}"


def escape(data: bytes) -> str:
    """The bytes as printable characters on one line. `unescape` turns them back into the same bytes."""
    text = "".join(_ESCAPES.get(byte) or (chr(byte) if 0x20 <= byte < 0x7F else f"\\x{byte:02x}") for byte in data)
    return text[:-1] + "\\x20" if text.endswith(" ") else text


def unescape(text: str) -> bytes:
    """The bytes of a text that `escape` or `\\hex` has written. Raises NotATranscript."""
    if text.startswith(_HEX):
        try:
            return bytes.fromhex(text.removeprefix(_HEX))
        except ValueError as fault:
            raise NotATranscript(f"{text!r}: pairs of hexadecimal digits follow \\hex") from fault
    data, at = bytearray(), 0
    while at < len(text):
        part = _PARTS.match(text, at)
        if part is None:
            raise NotATranscript(f"{text!r}: character {at + 1} is no escape and not printable")
        escaped, plain = part.groups()
        data += (plain or _MEANT.get(escaped) or chr(int(escaped[1:], 16))).encode("latin-1")
        at = part.end()
    return bytes(data)


def _keys(text: str) -> dict[str, object]:
    try:
        keys = json_of(text)
    except ValueError as fault:
        raise NotATranscript(f"{text!r}: the keys of a link are a JSON object") from fault
    assert isinstance(keys, dict), "the braces make it one"
    return keys
