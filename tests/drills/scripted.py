"""A script of a drill, event by event: which axes may move by it, without a box or a world.

Knows moments, and the orders in force. Knows no judge.
"""

from __future__ import annotations

from benchmarks.drills.front_panel import STILL_AT_MOST_S
from benchmarks.drills.goals import Ranges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Event

SOON_S = 0.05


class Script:
    """One event after the other, on a rotor of 360° and 180°. It begins when a mode switch would have been read."""

    def __init__(self, *, follows: bool = False) -> None:
        self.orders = Orders((Ranges(0.0, 360.0, False), Ranges(0.0, 180.0, False)), (0.0, 0.0), follows=follows)
        self.now_s = 0.0
        self.wait(STILL_AT_MOST_S)

    def say(self, who: str, what: str, *args: float | str) -> None:
        self.orders.note(Event(self.now_s, who, what, args))
        self.wait(SOON_S)

    def wait(self, seconds: float) -> None:
        self.now_s += seconds
        self.orders.expire(self.now_s)

    @property
    def moves(self) -> tuple[bool, bool]:
        """Whether each axis may move."""
        return self.orders.holds("azimuth"), self.orders.holds("elevation")
