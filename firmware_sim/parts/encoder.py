"""A quadrature encoder on a shaft: two hall channels, a quarter of a period apart.

Knows at which angles its channels change, and its faults. Knows no GPIO line: it returns edges with their moments.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable

LEVELS = ((False, False), (True, False), (True, True), (False, True))
"""Of both channels, in the order of a shaft that turns clockwise or up."""
BISECTIONS = 30
"""A second halved so often is a nanosecond."""


class SimEncoder:
    """Add `turned` to a motor's `on_turn`. `take` returns the edges. `counts_per_deg` is negative where B leads."""

    def __init__(self, counts_per_deg: float, shaft_deg: float) -> None:
        self.dead = False
        """Fault: its supply is gone, and both channels stay as they are."""
        self.stuck = False
        """Fault: channel B stays as it is."""
        self._per_deg = counts_per_deg
        self._count = self._at(shaft_deg)
        self._levels = list(LEVELS[self._count % 4])
        self._edges: deque[tuple[float, int, bool]] = deque()
        self.counter: Callable[[int, bool], None] | None = None
        """A chip that gets channel and level of each edge, whenever it was; None: `take` returns the edges."""

    @property
    def levels(self) -> tuple[bool, bool]:
        return self._levels[0], self._levels[1]

    def take(self, until_s: float) -> list[tuple[float, int, bool]]:
        """The edges since the last call, up to `until_s`: moment, channel (0: A, 1: B) and level, oldest first."""
        taken = []
        while self._edges and self._edges[0][0] <= until_s:
            taken.append(self._edges.popleft())
        return taken

    def turned(self, from_s: float, seconds: float, shaft_deg: Callable[[float], float]) -> None:
        """A turn of the shaft in one direction; see `firmware_sim.parts.motor.Stretch`."""
        end = self._at(shaft_deg(seconds))
        step = 1 if end > self._count else -1
        early_s = 0.0
        for count in range(self._count + step, end + step, step) if end != self._count else ():
            if self.counter is not None:
                self._passed(from_s, count)
                continue
            late_s = seconds
            first_s = early_s
            for _ in range(BISECTIONS):
                middle_s = (first_s + late_s) / 2
                if (self._at(shaft_deg(middle_s)) - count) * step >= 0:
                    late_s = middle_s
                else:
                    first_s = middle_s
            early_s = late_s
            self._passed(from_s + late_s, count)
        self._count = end

    def ahead(self, shaft_deg: float) -> int:
        """The counts from here to there; 0 with a fault."""
        return 0 if self.dead or self.stuck else self._at(shaft_deg) - self._count

    def _at(self, shaft_deg: float) -> int:
        return math.floor(shaft_deg * self._per_deg)

    def _passed(self, at_s: float, count: int) -> None:
        if self.dead:
            return
        for channel, level in enumerate(LEVELS[count % 4]):
            if level is not self._levels[channel] and not (self.stuck and channel):
                self._levels[channel] = level
                if self.counter is not None:
                    self.counter(channel, level)
                else:
                    self._edges.append((at_s, channel, level))
