"""The orders that wait for the control thread.

Knows who sent each order and whether it can wait for the next cycle. Does not know what an order does. Any thread may
post an order; the control thread takes them out.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

from rotator.exchange.orders import Jog, Order
from rotator.exchange.sources import Source


@dataclass(frozen=True, slots=True)
class _Posted:
    source: Source
    order: Order
    can_wait: bool

    def replaces(self, other: _Posted) -> bool:
        """Whether this later order makes the other one superfluous: same source, same kind, both may wait."""
        waits = self.can_wait and other.can_wait
        return waits and self.source == other.source and _kind(self.order) == _kind(other.order)


class Inbox:
    """`wake`: called when an order must not wait for the next cycle."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._posted: list[_Posted] = []
        self._lock = threading.Lock()
        self.posted = 0
        """How many orders have come since the start."""

    def post(self, source: Source, order: Order, *, can_wait: bool) -> None:
        """An order that `can_wait` replaces the waiting ones of its kind from the same source: the newest wins."""
        new = _Posted(source, order, can_wait)
        with self._lock:
            if can_wait:
                self._posted = [each for each in self._posted if not new.replaces(each)]
            self._posted.append(new)
            self.posted += 1
        if not can_wait:
            self._wake()

    def take(self) -> list[tuple[Source, Order]]:
        """All orders, oldest first; the inbox is empty then."""
        if not self._posted:
            return []
        with self._lock:
            posted, self._posted = self._posted, []
        return [(each.source, each.order) for each in posted]


def _kind(order: Order) -> object:
    return (Jog, order.axis) if isinstance(order, Jog) else type(order)
