"""Requests to one controller that go before every other order, until its answers show that they are carried out.

Knows their sequence, the moment after which they are dropped, and the answer that shows each as done. Knows no bus,
thread or clock, nor why a request was made.
"""

from __future__ import annotations

import math
from collections import deque

from hw.moteus.orders import Answer, Home, Mode, Order, SetOutput, Stop

ERRAND_S = 2.0
"""Seconds: an operator's request that cannot be delivered to the controller in this time is dropped."""

Request = Stop | SetOutput


class Errands:
    """Each request is sent again and again: `first` names it, and `answered` takes the answer to any order."""

    def __init__(self) -> None:
        self._waiting: deque[Request] = deque()
        self._until_s = math.inf

    def __bool__(self) -> bool:
        return bool(self._waiting)

    @property
    def first(self) -> Request:
        """The request to send now. Only while there is one."""
        return self._waiting[0]

    def put(self, *requests: Request, until_s: float = math.inf) -> None:
        """Send these, in place of all earlier ones, and drop what is not done at `until_s`."""
        self._waiting = deque(requests)
        self._until_s = until_s

    def expire(self, now_s: float) -> None:
        if now_s > self._until_s:
            self._waiting.clear()

    def answered(self, order: Order, answer: Answer, *, placed: bool) -> Request | None:
        """The request that this answer to `order` shows as carried out; None: it is sent again.

        `placed`: the controller has taken the position that it was given last.
        """
        match self.first:
            case Stop():  # the answer may be older than the order, so the mode shows whether the order is done
                done = order == Stop() and answer.mode == Mode.STOPPED
            case SetOutput():
                done = isinstance(order, SetOutput) and answer.home == Home.OUTPUT and placed
        return self._waiting.popleft() if done else None
