"""Whether a person on the page holds the antenna, so that orders of programs have no effect.

Knows what takes it and what gives it back, by the rules of docs/safety.md. Where that depends on what the box made of
an order, it may be held: then a program's order may count, and the older ones too.
"""

from __future__ import annotations

from benchmarks.drills.script import LINKS, PAGE, Event

ORDERS = ("aim", "aim-azimuth", "aim-elevation", "jog", "park", "list", "run-list", "calibrate")
"""What has no effect from a program while a person holds the antenna."""
MOVES = (*ORDERS, "hold", "track", "storm", "home")


class HeldOff:
    def __init__(self) -> None:
        self.surely = self.perhaps = False

    def forget(self) -> None:
        """The program begins anew, or the switch of the panel turns."""
        self.perhaps = self.perhaps or self.surely
        self.surely = False

    def note(self, event: Event, *, free: bool) -> None:
        """`free`: nothing else holds the antenna back, and no switch of a panel turns."""
        match event.who, event.what:
            case str(who), "take" if who == PAGE and free:
                self.surely = self.perhaps = True
            case str(who), "give-back" if who == PAGE:
                self.surely = self.perhaps = False
            case str(who), str(what) if who == PAGE and what in (*MOVES, "take", "mode"):
                self.perhaps, self.surely = True, self.surely and what != "mode"
            case str(who), str(what) if who not in (*LINKS, PAGE) and what in MOVES:
                self.surely = False  # a person at the box is held off by none

    def holds_off(self, event: Event) -> bool:
        """This order of a program has certainly no effect."""
        return self.surely and event.who in LINKS and event.what in ORDERS

    def may_hold_off(self, event: Event) -> bool:
        return self.perhaps and event.who in LINKS and event.what in ORDERS
