"""Whose orders have certainly no effect, because a stop elsewhere has silenced them and they have not paused since.

Knows who sent what and when, by the rule of docs/safety.md: a sender counts again after a pause of 3 s, one that
streams after 10 s. Speaks only of the plainest case, a program that aims again and again: whatever else it sends may
have freed it.
"""

from __future__ import annotations

from benchmarks.drills.script import Event

PAUSE_S = 2.8
"""Orders no further apart than this leave no pause that frees their sender."""
RECENT_S = 9.5
"""A stop silences who has sent so lately."""
STOPS_FOR_ALL = ("gs232a", "gs232b", "rotctld", "rotctld-2")
"""Links with one word that stops both axes; others stop one axis after the other, which silences nobody."""


class Silenced:
    def __init__(self) -> None:
        self._aimed_s: dict[str, float] = {}
        """When each sender aimed last; only senders that have sent nothing else since."""
        self._silenced: set[str] = set()

    def forget(self) -> None:
        """A person lets the box go, or the program begins anew."""
        self._aimed_s.clear()
        self._silenced.clear()

    def stop(self, event: Event) -> None:
        self._free(event.who)
        if event.who in STOPS_FOR_ALL:
            self._silenced |= {who for who, at_s in self._aimed_s.items() if event.at_s - at_s < RECENT_S}

    def other(self, event: Event) -> None:
        """Something else than an aim or a stop."""
        self._free(event.who)

    def aim(self, event: Event) -> bool:
        """Whether this aim has certainly no effect."""
        before_s = self._aimed_s.get(event.who)
        self._aimed_s[event.who] = event.at_s
        if before_s is None or event.at_s - before_s > PAUSE_S:
            self._silenced.discard(event.who)
        return event.who in self._silenced

    def _free(self, who: str) -> None:
        self._aimed_s.pop(who, None)
        self._silenced.discard(who)
