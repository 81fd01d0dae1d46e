"""The F1EFW dialect: the serial line of the Arduino sketch that this box replaces.

The sketch looks for a W anywhere in the bytes, never answers, and stops at zero or negative elevation. Every other byte
is noise to it. Knows the bytes of an order, and which orders this sketch would take. Does not know how the box moves.
"""

from __future__ import annotations

import re

from rotator.exchange.orders import Aim
from rotator.protocols.aiming import outside
from rotator.protocols.session import Box, Talk

ARDUINO_READ_TIMEOUT_S = 1.0
"""An Arduino takes a string as complete after a second of silence, so Termite need not send a line end."""

_AZIMUTH_TOP_DEG = 450
_ORDER = re.compile(rb"[Ww][ \t]{0,8}(?:(\d{3})(\d{3})|(\d{1,3})[ ,;\t]{1,8}(-?\d{1,3}))(?=[^\d])")
_LONGEST_ORDER = 1 + 8 + 3 + 8 + 1 + 3
_NO_ORDER = re.compile(rb"[Ww][ \t]{0,8}[-+.\d].*?[\r\n]")


class F1efwSession(Talk):
    idle_s = ARDUINO_READ_TIMEOUT_S

    def __init__(self, box: Box) -> None:
        self._box = box
        self._tail = b""

    def receive(self, data: bytes) -> list[bytes]:
        text = self._tail + data
        end = 0
        for order in _ORDER.finditer(text):
            end = order.end()
            self._obey(float(order[1] or order[3]), float(order[2] or order[4]))
        if damaged := _NO_ORDER.search(text, end):
            self._box.note_refused(damaged[0].strip())
            end = damaged.end()
        self._tail = text[end:][-_LONGEST_ORDER:]
        return []

    def idle(self) -> list[bytes]:
        return self.receive(b"\n")

    finish = idle

    def _obey(self, azimuth_deg: float, elevation_deg: float) -> None:
        top_deg = max(_AZIMUTH_TOP_DEG, self._box.status().azimuth.max_deg)
        if azimuth_deg > top_deg:
            self._box.note_refused(outside(azimuth_deg, top_deg))
        else:
            self._box.order(Aim(azimuth_deg, elevation_deg, engaged=elevation_deg > 0))
