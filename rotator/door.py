"""The box as one connection sees it: status to read, orders to hand in.

Knows one source and where its orders go. Decides nothing: admission does.
"""

from __future__ import annotations

import logging

from rotator.control.admission import refusal
from rotator.control.mount import Mount
from rotator.loop import ControlLoop
from rotator.orders import Order, Refusal, Source
from rotator.status import Status

log = logging.getLogger(__name__)


class Door:
    def __init__(self, loop: ControlLoop, mount: Mount, source: Source) -> None:
        self._loop = loop
        self._mount = mount
        self._source = source

    def status(self) -> Status:
        return self._loop.status

    def order(self, order: Order) -> Refusal | None:
        refused = refusal(order, self._loop.status, self._mount)
        if refused:
            log.warning("%s: refused: %s", self._source, refused.reason)
        else:
            self._loop.post(self._source, order)
        return refused
