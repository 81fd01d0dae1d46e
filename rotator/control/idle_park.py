"""When an idle antenna goes to its park position by itself.

The idle time begins when the last order has been carried out: its motors stand, its list has ended, its pass has set.
After a stop, a fault or a release a person may stand on the mast, so no idle time runs until the next order; and none
runs in a calibration, nor in a mode of a person. Knows moments, and whether the antenna is busy. Knows no order, no
axis and no park position.
"""

from __future__ import annotations

CONTINUES_S = 10.0
"""A motor that starts within this time still carries out the last order: its relay waited, or its target moved on. One
that starts later only corrects what the wind has turned, and that does not prolong the idle time."""


class IdlePark:
    """`after_s`: the idle time after which the antenna parks; 0: it never does."""

    def __init__(self, after_s: float) -> None:
        self._after_s = after_s
        self._busy_s: float | None = None
        """When the last order came, or its motion was last seen; None: the next order is awaited."""
        self._carries_out = False
        """The antenna was busy with that order at the latest call of `due`."""

    def ordered(self, now_s: float) -> None:
        """An order moves the antenna."""
        self._busy_s = now_s

    def ended(self) -> None:
        """The order has ended early: by a stop, a fault, a lost link, or because the antenna parks."""
        self._busy_s, self._carries_out = None, False

    @property
    def counts(self) -> bool:
        """Whether an idle time is set, and an order has come since the last end."""
        return self._after_s > 0 and self._busy_s is not None

    def due(self, now_s: float, *, busy: bool) -> bool:
        """Asked once a cycle: whether to park now. `busy`: an axis turns, or waits and will turn on by itself."""
        if self._busy_s is None or not self.counts:
            return False
        if busy:
            # Also after a late cycle: an antenna that was busy with the order, and still is, has not finished it.
            self._carries_out = self._carries_out or now_s - self._busy_s <= CONTINUES_S
            if self._carries_out:
                self._busy_s = now_s
            return False
        self._carries_out = False
        return now_s - self._busy_s >= self._after_s
