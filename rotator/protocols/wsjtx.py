"""WSJT-X's azel.dat: where Moon, Sun and a source in the sky are, written anew every second while its Astro window is
open.

Knows the file's lines, and when what they say is fresh. Does not know files: one `receive` is the file as it is after
a change. Time is the file's own: nobody's clock has to be right. Source: WSJT-X's astro.cpp, now and of old.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rotator.protocols.aiming import aim, degrees
from rotator.protocols.session import Box

LONGEST_PAUSE_S = 10
"""A file that has not moved on for longer is stale; the next change only tells that somebody writes it again."""
DAY_S = 86_400

_LINE = re.compile(r"(\d\d)0?:(\d\d)0?:(\d\d)(?:0000)?, *([^,\n]*?)(?:0000)?, *([^,\n]*), *(\w+)\r?\n")
"""Old versions pad the separators too: `120:340:560000,123.40000,0-5.3,Moon`."""
_MISPLACED_MINUS = re.compile(r"0+(-)")
"""Below the horizon the zeros come before the sign: `0-5.3`."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a body is, and when."""

    second_of_day: int
    azimuth_deg: float
    elevation_deg: float


def parse(text: bytes, body: str) -> Place | None:
    """The first whole line about `body`; None where there is none, as in a file that is being written."""
    for hour, minute, second, azimuth, elevation, name in _LINE.findall(text.decode("latin-1")):
        if name != body:
            continue
        azimuth_deg, elevation_deg = degrees(azimuth), degrees(_MISPLACED_MINUS.sub(r"\1", elevation))
        if azimuth_deg is None or elevation_deg is None or aim(azimuth_deg, elevation_deg) is None:
            return None
        return Place(int(hour) * 3600 + int(minute) * 60 + int(second), azimuth_deg, elevation_deg)
    return None


def encode(body: str, place: Place) -> bytes:
    """A line as WSJT-X writes it."""
    minutes, second = divmod(place.second_of_day, 60)
    hour, minute = divmod(minutes, 60)
    azimuth, elevation = f"{place.azimuth_deg:.1f}".rjust(5, "0"), f"{place.elevation_deg:.1f}".rjust(5, "0")
    return f"{hour:02d}:{minute:02d}:{second:02d},{azimuth},{elevation},{body}\n".encode()


class WsjtxSession:
    """WSJT-X by way of its file. What the file says first is no order: nobody knows how long it has lain there."""

    idle_s = None
    closed = False

    def __init__(self, box: Box, body: str) -> None:
        self._box = box
        self._body = body
        self._written_s: int | None = None

    def receive(self, data: bytes) -> list[bytes]:
        place = parse(data, self._body)
        if place is None:
            return []
        before_s, self._written_s = self._written_s, place.second_of_day
        if before_s is None or not 0 < (place.second_of_day - before_s) % DAY_S <= LONGEST_PAUSE_S:
            return []
        order = aim(place.azimuth_deg, place.elevation_deg)
        if order is not None:
            self._box.order(order)
        return []

    def idle(self) -> list[bytes]:
        return []
