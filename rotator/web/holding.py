"""The button that a person holds on the page: a motor turns only while fresh signs of the finger arrive.

Each sign names the latest picture that the browser has seen. So the box knows the age of the sign without the browser's
clock, and ignores a sign that was stuck in the network. Knows times and orders. Does not know the socket.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from secrets import randbits

from hw.ports import Axis, Direction
from rotator.exchange.orders import Jog
from rotator.protocols.panel_words import TURNS

LEASE_S = 0.45
"""Seconds after the sending of a picture in which a sign that names it lets a motor turn."""

NUMBER_BITS = 53
"""A number of JavaScript holds as many without rounding."""


class Pictures:
    """The times at which the latest pictures were sent, by number. Numbers are drawn by lot: who has not seen a picture
    cannot name it."""

    def __init__(self) -> None:
        self._sent: deque[tuple[int, float]] = deque()

    def next(self, now_s: float) -> int:
        """The number of a picture that is sent now."""
        number = randbits(NUMBER_BITS)
        # Removed by age: many new browsers, each with a first picture, must not push out pictures that still count.
        while self._sent and now_s - self._sent[0][1] > LEASE_S:
            self._sent.popleft()
        self._sent.append((number, now_s))
        return number

    def sent_s(self, number: int) -> float | None:
        """When this picture was sent. None: too old, or never sent."""
        return next((at_s for each, at_s in self._sent if each == number), None)


class Holding:
    """One browser's button. `order` hands a jog to the box and returns why not."""

    def __init__(self, pictures: Pictures, order: Callable[[Jog], str]) -> None:
        self._pictures = pictures
        self._order = order
        self._held: tuple[Axis, Direction] | None = None
        self._press = 0
        self._until_s = 0.0

    def sign(self, turn: str, press: int, picture: int, now_s: float) -> str:
        """The button is held. `press`: counts the presses. Returns why nothing turns; empty: it turns."""
        sent_s = self._pictures.sent_s(picture)
        until_s = 0.0 if sent_s is None else sent_s + LEASE_S
        if until_s <= now_s:
            return "the connection is too slow to turn the antenna by hand"
        if press < self._press or (press == self._press and now_s >= self._until_s):
            return "the connection was lost for a moment: press again"
        way = TURNS[turn]
        if self._held is not None and self._held != way:
            self._release()
        if refused := self._order(Jog(*way, round(until_s - now_s, 3), held=True)):
            self._press, self._until_s, self._held = press, now_s, None
            return refused
        self._press, self._until_s, self._held = press, until_s, way
        return ""

    def let_go(self) -> None:
        """The button was released, or the browser has gone."""
        if self._held is not None:
            self._release()
        self._until_s = 0.0

    def _release(self) -> None:
        assert self._held is not None, "something is held"
        axis, _ = self._held
        self._held = None
        self._order(Jog(axis, Direction.OFF, held=True))
