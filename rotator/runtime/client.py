"""The box as one connection sees it: it reads the status and gives orders.

Knows the connection's name and its rights: whether it may give orders, and how many a second. Whether an order makes
sense is decided in `rotator.control.admission`.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from rotator.control.admission import refusal
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import Leave, Order, Stop, Unheeded
from rotator.exchange.sources import Refusal, Source
from rotator.exchange.status import Status
from rotator.runtime.log_limit import LogLimit
from rotator.runtime.loop import ControlLoop

log = logging.getLogger(__name__)

MOST_PER_S = 100
SHOWN_BYTES = 60
"""Of bytes that are no order, in the log."""


@dataclass(frozen=True, slots=True)
class Rights:
    """What the connections of a link may do."""

    read_only: bool = False
    """Queries only: no orders, not even a stop."""
    most_per_s: int = MOST_PER_S
    """Orders a second from one connection that take effect at once. More orders wait for the next cycle, and then only
    the newest of each kind counts."""


class Client:
    """One connection's view of the box. `clock` gives seconds.

    `complaints` limits the log lines, `ranges` those on orders out of range: a program that tracks sends one a second,
    each with other angles. The connections of a link share both: a program may connect anew for each order.
    """

    def __init__(
        self,
        loop: ControlLoop,
        mount: Mount,
        source: Source,
        *,
        rights: Rights = Rights(),
        complaints: LogLimit | None = None,
        ranges: LogLimit | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._loop = loop
        self._mount = mount
        self._source = source
        self._rights = rights
        self._complaints = complaints or LogLimit(clock)
        self._ranges = ranges or LogLimit(clock, most=1)
        self._clock = clock
        self._allowance = float(rights.most_per_s)
        self._counted_s = clock()
        self._has_ordered = False

    def status(self) -> Status:
        """The latest status. Never waits."""
        status = self._loop.status
        return replace(status, orders_wait=True) if self._loop.orders_wait else status

    def order(self, order: Order) -> Refusal | None:
        """Hand an order to the control loop, or return why it is refused; the log has the reason then. Never waits."""
        refused = self._forbidden(order) or refusal(order, self._loop.status, self._mount)
        if refused:
            self.note_refused(refused)
            if refused.faulty:
                self._loop.post(self._source, Unheeded(order), can_wait=True)
        else:
            self._has_ordered = True
            self._loop.post(self._source, order, can_wait=self._is_too_much(order))
        return refused

    def comes_from(self, host: str) -> None:
        """The address of the connection's machine, for the screens."""
        self._source = replace(self._source, host=host)

    def left(self) -> None:
        """The connection has ended. Its motion that has no end of its own, such as a held jog, ends too."""
        if self._has_ordered:
            self._loop.post(self._source, Leave())

    def note_refused(self, refused: Refusal | bytes) -> None:
        """Log why an order is refused, or the bytes that the protocol does not understand."""
        if isinstance(refused, bytes):
            refused = Refusal(f"{refused[:SHOWN_BYTES].decode('latin-1')!a} is no order")
        self._complain(f"refused: {refused.reason}", self._ranges if refused.out_of_range else self._complaints)

    def _forbidden(self, order: Order) -> Refusal | None:
        if not self._rights.read_only:
            return None
        return Refusal("this link is read_only: it may ask, but not move or stop the antenna", forbidden=True)

    def _is_too_much(self, order: Order) -> bool:
        """Whether the order must wait for the next cycle, because too many came before it. A stop never waits."""
        if isinstance(order, Stop):
            return False
        now_s, most = self._clock(), self._rights.most_per_s
        self._allowance = min(most, self._allowance + (now_s - self._counted_s) * most)
        self._counted_s = now_s
        if self._allowance >= 1:
            self._allowance -= 1
            return False
        text = f"more than {most} orders a second: of those beyond, only the newest of each kind counts"
        self._complain(text, self._complaints)
        return True

    def _complain(self, text: str, limit: LogLimit) -> None:
        if line := limit.admit(text):
            log.warning("%s: %s", self._source, line)
