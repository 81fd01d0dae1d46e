"""The box as a client of another program's rotctld: where that one points, this antenna goes.

Knows the question `p`, its answers, and which of them become orders. Time is counted in answers, `every_s` apart.

What the other end says first is only where it stands, for a server that nobody commands is to move nothing; from then
on changes are orders. They go out as a tracking program's do: twice a second at most, and the last one is said again a
few times, so that the box does not take a target that stands for a stream that was cut off. Then there is silence.
"""

from __future__ import annotations

import math

from rotator.protocols.aiming import aim
from rotator.protocols.lines import LineReader
from rotator.protocols.rotctld import BadRequest, Request, encode, number
from rotator.protocols.session import Box, NotUnderstood

MAX_LINE = 128
SHOWN_BYTES = 40
CHANGE_S = 0.5
"""A rotor that is asked while it turns says something new each time: that often is enough."""
AGAIN_S = 1.2
"""Longer than the second in which a tracking program would have said something new."""
TIMES_AGAIN = 4
_REPORT = b"RPRT "


class RotctldFollower:
    """`every_s`: how far apart the questions are."""

    def __init__(self, box: Box, every_s: float) -> None:
        self._box = box
        self._lines = LineReader(MAX_LINE)
        self._heard: list[float] = []
        self._ordered: tuple[float, float] | None = None
        self._until_change = math.ceil(CHANGE_S / every_s)
        self._until_again = math.ceil(AGAIN_S / every_s)
        self._since_order = self._until_change
        self._times_left = 0
        self.trouble = ""

    def ask(self) -> bytes:
        self._lines = LineReader(MAX_LINE)
        self._heard.clear()
        return encode(Request("get_pos"))

    def receive(self, data: bytes) -> bool:
        # Whatever follows the answer in this piece answers nothing that was asked.
        return any(self._take(line) for line in self._lines.feed(data))

    def _take(self, line: bytes | None) -> bool:
        """Whether the answer ends with this line. Raises NotUnderstood."""
        if line is None:
            raise NotUnderstood(f"it says more than {MAX_LINE} bytes in a line")
        text = line.strip()
        if not text or (text == _REPORT + b"0" and not self._heard):
            return False
        if text.startswith(_REPORT) and not self._heard:
            self.trouble = f"answers {text[:SHOWN_BYTES].decode('latin-1')!r} for a position"
            return True
        try:
            self._heard.append(number(text.decode("latin-1")))
        except BadRequest as fault:
            raise NotUnderstood(f"it says {text[:SHOWN_BYTES].decode('latin-1')!r} for a position") from fault
        if len(self._heard) < 2:
            return False
        self._follow(self._heard[0], self._heard[1])
        return True

    def _follow(self, azimuth_deg: float, elevation_deg: float) -> None:
        order = aim(azimuth_deg, elevation_deg)
        if order is None:
            self.trouble = "answers with angles that are no direction"
            return
        self.trouble = ""
        self._since_order += 1
        points_to = (azimuth_deg, elevation_deg)
        if self._ordered is None:
            self._ordered = points_to
        elif points_to != self._ordered and self._since_order >= self._until_change:
            self._ordered, self._since_order, self._times_left = points_to, 0, TIMES_AGAIN
            self._box.order(order)
        elif points_to == self._ordered and self._times_left and self._since_order >= self._until_again:
            self._since_order, self._times_left = 0, self._times_left - 1
            self._box.order(order)
