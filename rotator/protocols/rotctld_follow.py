"""The box as a client of another program's rotctld: this antenna follows the other rotor.

Knows the question `p`, its answers, and which of them become orders. Time is counted in answers, `every_s` apart.

The first answer is no order: it is only the angle at which the other rotor stands. After that every change is an order
for that place. It is no point of a path: a rotor turns in ramps with corners, and a path drawn on beyond a corner leads
past it. A box that has dropped the last order, for a fault that has passed, gets it again within the next seconds.
Other links may move the antenna as soon as the other rotor rests.
"""

from __future__ import annotations

import math
from dataclasses import replace

from rotator.exchange.orders import Aim
from rotator.protocols.aiming import aim, may_be_sent
from rotator.protocols.lines import LineReader
from rotator.protocols.rotctld import BadRequest, Request, encode, number
from rotator.protocols.session import Box, NotUnderstood

MAX_LINE = 128
SHOWN_BYTES = 40
AGAIN_S = 1.2
"""The time between repeats."""
TIMES_AGAIN = 4
_REPORT = b"RPRT "


class RotctldFollower:
    """`every_s`: the time between two questions."""

    def __init__(self, box: Box, every_s: float) -> None:
        self._box = box
        self._lines = LineReader(MAX_LINE)
        self._angles: list[float] = []
        self._ordered: tuple[float, float] | None = None
        self._until_again = math.ceil(AGAIN_S / every_s)
        self._since_order = 0
        self._times_left = 0
        self.trouble = ""

    def ask(self) -> bytes:
        self._lines = LineReader(MAX_LINE)
        self._angles.clear()
        return encode(Request("get_pos"))

    def receive(self, data: bytes) -> bool:
        # Bytes after the answer in this piece belong to no question.
        return any(self._take(line) for line in self._lines.feed(data))

    def _take(self, line: bytes | None) -> bool:
        """Returns whether the answer ends with this line. Raises NotUnderstood."""
        if line is None:
            raise NotUnderstood(f"it says more than {MAX_LINE} bytes in a line")
        text = line.strip()
        if not text or (text == _REPORT + b"0" and not self._angles):
            return False
        if text.startswith(_REPORT) and not self._angles:
            self.trouble = f"answers {text[:SHOWN_BYTES].decode('latin-1')!r} for a position"
            return True
        try:
            self._angles.append(number(text.decode("latin-1")))
        except BadRequest as fault:
            raise NotUnderstood(f"it says {text[:SHOWN_BYTES].decode('latin-1')!r} for a position") from fault
        if len(self._angles) < 2:
            return False
        self._follow(self._angles[0], self._angles[1])
        return True

    def _follow(self, azimuth_deg: float, elevation_deg: float) -> None:
        direction = aim(azimuth_deg, elevation_deg)
        if not may_be_sent(azimuth_deg, elevation_deg):
            self.trouble = "answers with angles that are no direction"
            return
        self.trouble = ""
        order = replace(direction, place=True)
        self._since_order += 1
        points_to = (azimuth_deg, elevation_deg)
        if self._ordered is None:
            self._ordered = points_to
        elif points_to != self._ordered:
            self._ordered, self._since_order, self._times_left = points_to, 0, TIMES_AGAIN
            self._box.order(order)
        elif self._times_left and self._since_order >= self._until_again:
            self._since_order, self._times_left = 0, self._times_left - 1
            if self._dropped(order):
                self._box.order(order)

    def _dropped(self, order: Aim) -> bool:
        """Whether the box still shows this order, and an axis has no target: not so after a stop or another's order."""
        status = self._box.status()
        wanted = status.wanted_azimuth_deg, status.wanted_elevation_deg
        targets = status.azimuth.target_deg, status.elevation.target_deg
        return wanted == (order.azimuth_deg, order.elevation_deg) and None in targets
