"""Whether a person on the page holds the antenna, so that orders of programs have no effect.

Knows which orders take the antenna and which give it back, by the rules of docs/safety.md. Where the box may have
ignored such an order, the antenna counts as perhaps held: then a program's order may have effect, and the older orders
too.
"""

from __future__ import annotations

from benchmarks.drills.script import LINKS, PAGE, Event

ORDERS = ("aim", "aim-azimuth", "aim-elevation", "jog", "park", "list", "run-list", "calibrate")
"""Orders of a program that have no effect while a person holds the antenna."""
MOVES = (*ORDERS, "hold", "track", "storm", "home")


class HeldOff:
    def __init__(self) -> None:
        self.surely = self.perhaps = False

    def forget(self) -> None:
        """The program has started again, or the panel's mode switch turns."""
        self.perhaps = self.perhaps or self.surely
        self.surely = False

    def note(self, event: Event, *, free: bool) -> None:
        """Note one order. `free`: nothing else holds the antenna back, and no mode switch of a panel turns."""
        match event.who, event.what:
            case str(who), "take" if who == PAGE and free:
                self.surely = self.perhaps = True
            case str(who), "give-back" if who == PAGE:
                self.surely = self.perhaps = False
            case str(who), str(what) if who == PAGE and what in (*MOVES, "take", "mode"):
                self.perhaps, self.surely = True, self.surely and what != "mode"
            case str(who), str(what) if who not in (*LINKS, PAGE) and what in MOVES:
                self.surely = False  # a hold on the page does not hold off a person at the box

    def holds_off(self, event: Event) -> bool:
        """Whether this is an order of a program that certainly has no effect."""
        return self.surely and event.who in LINKS and event.what in ORDERS

    def may_hold_off(self, event: Event) -> bool:
        return self.perhaps and event.who in LINKS and event.what in ORDERS
