"""Programs' orders that certainly have no effect: a person on the page holds the antenna, or a stop silenced them.

Knows which orders take the antenna and which give it back, and for how long a stop silences a sender, by the rules of
docs/safety.md: a sender counts again after a pause of 3 s, one of a stream after 10 s. Where the box may have ignored
such an order, the antenna counts as perhaps held: then a program's order may have effect, and the older orders too. Of
silenced senders only the plainest case is known, a program that sends aims alone.
"""

from __future__ import annotations

from benchmarks.drills.script import LINKS, PAGE, Event

PAUSE_S = 2.8
"""A pause up to this does not end the silence of a sender."""
RECENT_S = 9.5
"""A stop silences the senders of the orders within this time before it."""
STOPS_FOR_ALL = ("gs232a", "gs232b", "rotctld", "rotctld-2")
"""Links with one word that stops both axes. Others stop one axis after the other, which silences no sender."""


class Silenced:
    def __init__(self) -> None:
        self._aimed_s: dict[str, float] = {}
        """When each sender aimed last; without senders that have sent another order since."""
        self._silenced: set[str] = set()

    def forget(self) -> None:
        """A person releases the antenna, or the program has started again."""
        self._aimed_s.clear()
        self._silenced.clear()

    def stop(self, event: Event) -> None:
        self._free(event.who)
        if event.who in STOPS_FOR_ALL:
            self._silenced |= {who for who, at_s in self._aimed_s.items() if event.at_s - at_s < RECENT_S}

    def other(self, event: Event) -> None:
        """The sender sends an order that is no aim and no stop."""
        self._free(event.who)

    def aim(self, event: Event) -> bool:
        """Note this aim. Returns whether it certainly has no effect."""
        before_s = self._aimed_s.get(event.who)
        self._aimed_s[event.who] = event.at_s
        if before_s is None or event.at_s - before_s > PAUSE_S:
            self._silenced.discard(event.who)
        return event.who in self._silenced

    def _free(self, who: str) -> None:
        self._aimed_s.pop(who, None)
        self._silenced.discard(who)


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
