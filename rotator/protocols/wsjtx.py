"""WSJT-X's azel.dat: directions of Moon, Sun and a radio source, rewritten every second while its Astro window is open.

Knows the file's lines, and when they are fresh. Does not know files: one `receive` is the content after a change. Time
is the time in the file, so no clock has to be right. Source: WSJT-X's astro.cpp, present and older versions.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rotator.protocols.aiming import aim, degrees, may_be_sent
from rotator.protocols.session import Box, Talk

LONGEST_PAUSE_S = 10
"""A file whose time has not changed for longer is stale. The next change only shows that it is being written again."""
DAY_S = 86_400

_LINE = re.compile(r"(\d\d)0?:(\d\d)0?:(\d\d)(?:0000)?, *+([^,\n]*?)(?:0000)?, *+([^,\n]*), *(\w+)\r?\n")
"""Present versions pad with blanks (`198.9, 61.9`), older ones with zeros (`198.9,061.9`), and some of those pad the
separators too: `120:340:560000,123.40000,0-5.3,Moon`."""
_MISPLACED_MINUS = re.compile(r"(?<!0)0+(-)")
"""Below the horizon these zeros come before the sign: `0-5.3`."""


@dataclass(frozen=True, slots=True)
class BodyDirection:
    """The direction of a body at one time of day."""

    second_of_day: int
    azimuth_deg: float
    elevation_deg: float


def parse(text: bytes, body: str) -> BodyDirection | None:
    """The first whole line about `body`; None where there is none, as in a file that is half written."""
    for hour, minute, second, azimuth, elevation, name in _LINE.findall(text.decode("latin-1")):
        if name != body:
            continue
        azimuth_deg, elevation_deg = degrees(azimuth), degrees(_MISPLACED_MINUS.sub(r"\1", elevation))
        if azimuth_deg is None or elevation_deg is None or not may_be_sent(azimuth_deg, elevation_deg):
            return None
        return BodyDirection(int(hour) * 3600 + int(minute) * 60 + int(second), azimuth_deg, elevation_deg)
    return None


def encode(body: str, direction: BodyDirection) -> bytes:
    """A line as WSJT-X writes it: blanks before short numbers."""
    minutes, second = divmod(direction.second_of_day, 60)
    hour, minute = divmod(minutes, 60)
    angles = f"{direction.azimuth_deg:5.1f},{direction.elevation_deg:5.1f}"
    return f"{hour:02d}:{minute:02d}:{second:02d},{angles},{body}\n".encode()


class WsjtxSession(Talk):
    """WSJT-X through its file. The first content is no order, because it may be old."""

    def __init__(self, box: Box, body: str) -> None:
        self._box = box
        self._body = body
        self._written_s: int | None = None

    def receive(self, data: bytes) -> list[bytes]:
        direction = parse(data, self._body)
        if direction is None:
            if b"\n" in data:
                self._box.note_refused(data)
            return []
        before_s, self._written_s = self._written_s, direction.second_of_day
        if before_s is None or not 0 < (direction.second_of_day - before_s) % DAY_S <= LONGEST_PAUSE_S:
            return []
        self._box.order(aim(direction.azimuth_deg, direction.elevation_deg))
        return []
