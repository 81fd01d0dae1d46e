"""The F1EFW dialect: the serial line of the Arduino sketch that this box replaces.

The sketch looks for a W anywhere in the bytes, never answers, and stops at zero or negative elevation. Every other byte
is noise to it. Knows the bytes of an order, and which orders this sketch would take. Does not know how the box moves.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from rotator.exchange.orders import Aim
from rotator.protocols.session import Box

ARDUINO_READ_TIMEOUT_S = 1.0
"""An Arduino takes a string as complete after a second of silence, so Termite need not send a line end."""

_AZIMUTH_TOP_DEG = 450
_ELEVATION_DEG = range(-90, 181)
_ORDER = re.compile(rb"[Ww](\d{1,3})[ ,;\t]{1,8}(-?)(\d{1,3})(?=[^\d])")
_LONGEST_ORDER = 1 + 3 + 8 + 1 + 3


class F1efwSession:
    idle_s = ARDUINO_READ_TIMEOUT_S
    closed = False

    def __init__(self, box: Box, refused: Callable[[str], None] = lambda _reason: None) -> None:
        """`refused` hears of an order out of range, for the log."""
        self._box = box
        self._refused = refused
        self._tail = b""

    def receive(self, data: bytes) -> list[bytes]:
        text = self._tail + data
        end = 0
        for order in _ORDER.finditer(text):
            end = order.end()
            self._obey(float(order[1]), float(order[2] + order[3]))
        self._tail = text[end:][-_LONGEST_ORDER:]
        return []

    def idle(self) -> list[bytes]:
        return self.receive(b"\n")

    def _obey(self, azimuth_deg: float, elevation_deg: float) -> None:
        if azimuth_deg > _AZIMUTH_TOP_DEG:
            self._refused(f"azimuth {azimuth_deg:g} is outside 0 to {_AZIMUTH_TOP_DEG} degrees")
        elif elevation_deg not in _ELEVATION_DEG:
            self._refused(f"elevation {elevation_deg:g} is outside -90 to 180 degrees")
        else:
            self._box.order(Aim(azimuth_deg, elevation_deg, engaged=elevation_deg > 0))
