"""The senders whose orders certainly have no effect: another sender's stop has silenced them, without a pause since.

Knows the senders and moments of orders. The rule of docs/safety.md: a sender counts again after a pause of 3 s, a
sender of a stream after 10 s. Handles only the plainest case, a program that sends aims only: any other order may have
ended its silence.
"""

from __future__ import annotations

from benchmarks.drills.script import Event

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
