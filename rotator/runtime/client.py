"""The box as one connection sees it: status to read, orders to hand in.

Knows one source, whether it may give orders, how many it may hurry, and where they go. Decides nothing else: admission
does.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass

from rotator.control.admission import refusal
from rotator.control.sky.mount import Mount
from rotator.orders import Order, Refusal, Source, Stop
from rotator.runtime.log_limit import LogLimit
from rotator.runtime.loop import ControlLoop
from rotator.status import Status

log = logging.getLogger(__name__)

MOST_PER_S = 100


@dataclass(frozen=True, slots=True)
class Rights:
    """What a link may do."""

    read_only: bool = False
    most_per_s: int = MOST_PER_S
    """Orders a second from one connection that take effect at once."""


class Client:
    """`complaints` is shared by the connections of a link, so that one that comes anew each time is no news."""

    def __init__(
        self,
        loop: ControlLoop,
        mount: Mount,
        source: Source,
        *,
        rights: Rights = Rights(),
        complaints: LogLimit | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._loop = loop
        self._mount = mount
        self._source = source
        self._rights = rights
        self._complaints = complaints or LogLimit(clock)
        self._clock = clock
        self._left = float(rights.most_per_s)
        self._counted_s = clock()

    def status(self) -> Status:
        return self._loop.status

    def order(self, order: Order) -> Refusal | None:
        refused = self._forbidden(order) or refusal(order, self._loop.status, self._mount)
        if refused:
            self._complain(f"refused: {refused.reason}")
        else:
            self._loop.post(self._source, order, can_wait=self._is_too_much(order))
        return refused

    def _forbidden(self, order: Order) -> Refusal | None:
        if not self._rights.read_only:
            return None
        return Refusal(f"the link is read_only, and takes no orders ({type(order).__name__})", forbidden=True)

    def _is_too_much(self, order: Order) -> bool:
        """A stop never is."""
        if isinstance(order, Stop):
            return False
        now_s, most = self._clock(), self._rights.most_per_s
        self._left = min(most, self._left + (now_s - self._counted_s) * most)
        self._counted_s = now_s
        if self._left >= 1:
            self._left -= 1
            return False
        self._complain(f"more than {most} orders a second: of those beyond, only the newest of each kind counts")
        return True

    def _complain(self, text: str) -> None:
        told = self._complaints.admit(text)
        if told:
            log.warning("%s: %s", self._source, told)
