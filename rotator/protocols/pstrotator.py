"""PstRotator's UDP control, as programs send it to PstRotator: `<PST><AZIMUTH>235</AZIMUTH></PST>`, `<PST>AZ?</PST>`.

Knows the tags, their codec and what they make the box do. Does not know sockets: one `receive` is one whole datagram.
Sources: PstRotator's manual, Rev. 7.5, as quoted by others; what Hamlib 4.6 and other programs send (see
docs/reference/wire.md).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from operator import gt

from rotator.exchange.orders import Order, Park, Stop
from rotator.orbits.earth import Site, direction
from rotator.protocols.aiming import aim, degrees, whole
from rotator.protocols.damaged import is_stop
from rotator.protocols.session import Box, Talk

ANSWERS_ABOVE = 1
"""Answers go to the sender's address, to the port this much above the box's own."""


@dataclass(frozen=True, slots=True)
class Tag:
    """One row of the list. A question ends in `?`."""

    text: str
    help: str


TAGS = (
    Tag("AZIMUTH", "Azimuth: go there"),
    Tag("ELEVATION", "Elevation: go there"),
    Tag("STOP", "1: stop everything"),
    Tag("PARK", "1: go to the park position"),
    Tag("HOME", "1: the same"),
    Tag("TRACK", "Azimuth and elevation: go there; 0 or 1: ignored"),
    Tag("LLH", "Latitude, longitude, metres: point there; needs `[station]`"),
    Tag("AZ?", "Read azimuth"),
    Tag("EL?", "Read elevation"),
    Tag("TGA?", "Read the target's azimuth, or azimuth"),
    Tag("TGE?", "Read the target's elevation, or elevation"),
    Tag("MODE?", "Read whether it tracks by itself: no"),
)

_OPEN, _CLOSE = "<PST>", "</PST>"
_BETWEEN = re.compile(_CLOSE + r"\s*" + _OPEN)
_ITEM = re.compile(r"\s*(?:<([A-Z][A-Z0-9]*)>([^<>]*)</\1>|([A-Z][A-Z0-9]*\?))\s*")
_NO_STOP = b"<STOP>0</STOP>"
_FARTHEST = (90.0, 180.0, 1e6)
"""Degrees, degrees and metres of a place."""
_SLIP = re.compile(r"(\d\.\d{6})\.2")
"""Hamlib's model 3 writes `%f.2` where it means `%.2f`."""


@dataclass(frozen=True, slots=True)
class Item:
    """A tag with its value, or a question."""

    tag: str
    value: str | None = None


def parse(datagram: bytes) -> tuple[Item, ...]:
    """The items of a datagram, in order. In a damaged datagram only the stops count."""
    text = datagram.decode("latin-1").upper().strip(" \t\r\n\0")
    items = None
    if text.startswith(_OPEN) and text.endswith(_CLOSE) and len(text) >= len(_OPEN + _CLOSE):
        items = _items(_BETWEEN.sub(" ", text[len(_OPEN) : -len(_CLOSE)]))
    if items is None:
        return (Item("STOP"),) if is_stop(datagram.upper().replace(_NO_STOP, b"")) else ()
    return items


def _items(text: str) -> tuple[Item, ...] | None:
    items, index = [], 0
    while index < len(text):
        found = _ITEM.match(text, index)
        if not found:
            return None
        items.append(Item(found[3]) if found[3] else Item(found[1], found[2].strip()))
        index = found.end()
    return tuple(items)


def encode(*items: Item) -> bytes:
    """One datagram, as programs write it."""
    written = (item.tag if item.value is None else f"<{item.tag}>{item.value}</{item.tag}>" for item in items)
    return f"{_OPEN}{''.join(written)}{_CLOSE}".encode()


class PstRotatorSession(Talk):
    """PstRotator for one sender. Orders get no answer, and neither does an order that is refused.

    `remark` takes a line for the log when the sender asks for something that the box does not have. `site`: the
    antenna's own place; None: unknown.
    """

    def __init__(self, box: Box, remark: Callable[[str], None] = lambda _text: None, site: Site | None = None) -> None:
        self._box = box
        self._site = site
        self._remark = remark

    def receive(self, data: bytes) -> list[bytes]:
        items = parse(data)
        if not items:
            self._box.note_refused(data)
        asked: dict[str, None] = {}
        before: list[Order] = []
        angles: dict[str, str] = {}
        for item in items:
            match item:
                case Item("AZIMUTH" | "ELEVATION" as axis, str() as value):
                    angles[axis] = value
                case Item("TRACK", str() as value) if len(value.split()) == 2:
                    angles["AZIMUTH"], angles["ELEVATION"] = value.split()
                case Item("LLH", str() as value) if self._site:
                    angles |= _angles_to(self._site, value)
                case Item("LLH"):
                    self._remark(
                        "LLH does nothing here: the file has no [station], so the antenna's own place is unknown"
                    )
                case Item("TRACK", "0"):
                    pass
                case Item(tag, value) if tag.startswith("STOP"):
                    if value != "0":
                        # A stop cancels the orders before it in the datagram; those after it count.
                        before = [Stop()]
                        angles.clear()
                case Item("PARK" | "HOME", value):
                    if value == "1":
                        before = [*(order for order in before if isinstance(order, Stop)), Park()]
                        angles.clear()
                case Item(question, None) if _is_listed(question):
                    # One answer to a repeated question: a small datagram must not cause a thousand answers.
                    asked[question] = None
                case Item(tag, value):
                    shown = "" if value is None else f" {value[:16]!a}"
                    self._remark(f"{tag[:24]}{shown} does nothing here")
        for order in before:
            self._box.order(order)
        self._point(angles, data)
        return [answer for question in asked for answer in self._answer(question)]

    def _point(self, angles: dict[str, str], data: bytes) -> None:
        """One order for both axes, or for the one that is named. With a damaged number there is no order."""
        angles_deg = {axis: degrees(_SLIP.sub(r"\1", text)) for axis, text in angles.items()}
        if None in angles_deg.values():
            self._box.note_refused(data)
        elif angles_deg:
            self._box.order(aim(angles_deg.get("AZIMUTH"), angles_deg.get("ELEVATION")))

    def _answer(self, question: str) -> Iterator[bytes]:
        """No answer while the position is not known."""
        status = self._box.status()
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        match question:
            case "AZ?" if azimuth_deg is not None:
                yield f"AZ:{whole(azimuth_deg * 10) % 3600 / 10:05.1f}\r".encode()
            case "EL?" if elevation_deg is not None:
                yield f"EL:{whole(elevation_deg * 10) / 10:04.1f}\r".encode()
            case "TGA?" if azimuth_deg is not None:
                wanted_deg = status.wanted_azimuth_deg
                yield f"TGA:{whole(azimuth_deg if wanted_deg is None else wanted_deg) % 360:03d}\r".encode()
            case "TGE?" if elevation_deg is not None:
                wanted_deg = status.wanted_elevation_deg
                yield f"TGE:{whole(elevation_deg if wanted_deg is None else wanted_deg):02d}\r".encode()
            case "MODE?":
                yield b"MODE:0\r"


def _angles_to(station: Site, text: str) -> dict[str, str]:
    """The direction of a place as the values of two tags; a damaged place as a damaged number."""
    numbers = [number for part in text.split(",") if (number := degrees(part)) is not None]
    if len(numbers) != 3 or text.count(",") != 2 or any(map(gt, map(abs, numbers), _FARTHEST)):
        return {"AZIMUTH": ""}
    seen = direction(station, Site(*numbers))
    return {"AZIMUTH": f"{seen[0]:.3f}", "ELEVATION": f"{seen[1]:.3f}"} if seen else {}


def _is_listed(question: str) -> bool:
    return any(tag.text == question for tag in TAGS)
