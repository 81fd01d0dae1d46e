"""What links and people of a drill send, on its way to the box: at once, or when their event loop runs again.

Knows the two event loops, for the links and for the page, and what a person reads off the antenna. Does not know what
an order means: `orders` notes it, and the box obeys or not.
"""

from __future__ import annotations

from dataclasses import replace

from benchmarks.drills.axis_case import AxisCase
from benchmarks.drills.box import Box
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import PAGE, Event
from benchmarks.drills.speech import said
from benchmarks.drills.world import World
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


MOST_ACTS_S = 0.01
"""Orders within this time are taken together, as by the real control thread, which takes a moment to wake."""


class Hearing:
    """Call `tick` in each cycle. `box`: the present run of the program."""

    def __init__(self, box: Box, world: World, orders: Orders, cases: tuple[AxisCase, AxisCase]) -> None:
        self.box = box
        self._world, self._orders, self._cases = world, orders, cases
        self._links, self._page = EventLoop(), EventLoop()
        self._acted_s = -1.0

    def begin_anew(self, box: Box) -> None:
        """The program starts again."""
        self.box = box
        for loop in (self._links, self._page):
            loop.begin_anew()

    def stall(self, now_s: float, seconds: float, *, page: bool) -> None:
        """The event loop of the links, or of the page, stands still from now on."""
        if page:
            self._page.stall(now_s, seconds, self.box.page_events)
        else:
            self._links.stall(now_s, seconds, self.box.events)

    def tick(self, now_s: float) -> None:
        """The event loops tick, or stand still."""
        if self._links.lost(now_s):
            self._orders.links_lost(now_s)
        if self._page.lost(now_s):
            self._orders.page_lost(now_s)
        late = self._links.tick(now_s, self.box.events), self._page.tick(now_s, self.box.page_events)
        for event in (*late[0], *late[1]):
            self.hear(replace(event, at_s=now_s))

    def hear(self, event: Event) -> None:
        """Bytes of a link or a person: they wake the control thread, as any order does."""
        if not (self._page if event.who == PAGE else self._links).takes(event):
            return
        if event.what == "leave":
            self._orders.note(event)
            self.box.leave(event.who)
        elif event.what in ("recognised", "waits"):
            self._orders.note(event)
            self.box.recognise(event.who, event.text(0), waits=event.what == "waits")
        else:
            if event.what == "confirm":
                event = self._confirmed(event)
            if event.what == "relays-checked" and self._world.axes[event.text(0) == "elevation"].welded:
                return  # a person who looks at the relays sees the weld, and does not say that all are open
            if not (data := said(event)):
                return
            self._orders.note(event)
            if event.what == "calibrate":
                self._cases[0 if event.text(0) == "azimuth" else 1].trusted = False  # a person says where it stands
            self.box.hear(event.who, data)
        if event.at_s - self._acted_s >= MOST_ACTS_S:
            self._acted_s = event.at_s
            self.box.loop.act()

    def _confirmed(self, event: Event) -> Event:
        """A person reads the antenna's angle, with the error in degrees that the event gives."""
        place = 0 if event.text(0) == "azimuth" else 1
        angle_deg = self._world.axes[place].shaft_deg + self._cases[place].shift_deg + event.number(1)
        self._cases[place].slack_deg += abs(event.number(1))
        return replace(event, args=(event.text(0), angle_deg))
