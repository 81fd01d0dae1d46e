"""The event loops of the box of a drill, one for the links and one for the page: each may stand still for a while.

Knows what was sent to a loop meanwhile, and when the orders of its senders have ended. Does not know orders.
"""

from __future__ import annotations

from benchmarks.drills.script import Event
from rotator.runtime.event_watch import LONGEST_S, EventWatch


class EventLoop:
    """Call `tick` in each cycle, and ask `takes` before an event is handed on."""

    def __init__(self) -> None:
        self._since_s = self._until_s = 0.0
        self._stalled = False
        self._unheard: list[Event] = []

    def stall(self, now_s: float, seconds: float, watch: EventWatch) -> None:
        """It stands still from now on."""
        watch.tick()
        self._stalled, self._since_s, self._until_s = True, now_s, now_s + seconds

    def begin_anew(self) -> None:
        """The program starts again. What was sent to the old one is lost."""
        self._stalled, self._unheard = False, []

    def lost(self, now_s: float) -> bool:
        """Whether it has stood still for so long that the orders of its senders end."""
        return self._stalled and now_s > self._since_s + LONGEST_S

    def takes(self, event: Event) -> bool:
        """Whether it hears the event now. If not, it hears it later."""
        if self._stalled:
            self._unheard.append(event)
        return not self._stalled

    def tick(self, now_s: float, watch: EventWatch) -> list[Event]:
        """It runs, or stands still. When it runs again: the events that it has missed."""
        if self._stalled and now_s < self._until_s:
            return []
        watch.tick()
        self._stalled, unheard, self._unheard = False, self._unheard, []
        return unheard
