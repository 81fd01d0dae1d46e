"""The orders of one program's stream: which belong together, and whether they are enough to look for a satellite.

Knows when they came and where they point. Knows no satellites.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence

from rotator.orbits.stream_fit import UNSTEADY_S, Heard, are_enough

KEPT = 60
"""Orders for which a stream must agree with a path that it meets later, because any line crosses some path."""
LONGEST_GAP_S = 20.0
"""Seconds: orders further apart are of two streams. Some programs send only when a whole degree has changed."""
THIN_S = 0.9
"""Seconds: if orders come faster, only one in this time counts."""
FASTEST_DPS = 2.0
"""Degrees a second: no satellite crosses the sky faster. Faster orders begin a new stream."""


class HeardOrders:
    """The latest `KEPT` orders of a stream."""

    def __init__(self) -> None:
        self._orders: deque[Heard] = deque(maxlen=KEPT)
        self._all_kept = True
        """Whether no order was dropped since the stream began."""

    @property
    def all(self) -> Sequence[Heard]:
        return tuple(self._orders)

    @property
    def first_s(self) -> float:
        return self._orders[0].utc_s if self._orders else math.inf

    @property
    def last_s(self) -> float:
        return self._orders[-1].utc_s if self._orders else -math.inf

    @property
    def full(self) -> bool:
        return len(self._orders) == KEPT

    @property
    def enough(self) -> bool:
        """Whether they are enough: from the begin of the stream on, or later as many as are kept."""
        return are_enough(self._orders) if self._all_kept else self.full

    def begin_anew(self, order: Heard) -> bool:
        """Whether this order begins another stream; then the orders so far are forgotten."""
        if not self._orders or not self._is_of_another(order):
            return False
        self._orders.clear()
        self._all_kept = True
        return True

    def too_soon(self, order: Heard) -> bool:
        return order.utc_s - self.last_s < THIN_S

    def add(self, order: Heard) -> None:
        self._all_kept = self._all_kept and not self.full
        self._orders.append(order)

    def _is_of_another(self, order: Heard) -> bool:
        last = self._orders[-1]
        gap_s = order.utc_s - last.utc_s
        if not 0 <= gap_s <= LONGEST_GAP_S:
            return True
        return order.direction.apart_deg(last.direction) > FASTEST_DPS * (gap_s + UNSTEADY_S) + 2.0
