"""The control loop: reads the sensors, steps the controller, commands the drive. The only reader of the clock.

Knows the timing, and logs changes of the status. The controller decides. Beside this loop only the guard touches the
rotor: it may open relays at any time. The sensors have a thread of their own, so a bus that hangs delays no order.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace

from hw.ports import Axis, HardwareError
from rotator.control.controller import Controller
from rotator.exchange.orders import Order, Stop
from rotator.exchange.sources import PAGE, Source
from rotator.exchange.status import Status
from rotator.rotors.port import Rotor
from rotator.runtime.bell import Bell
from rotator.runtime.errands import Errands
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.inbox import Inbox
from rotator.runtime.journal import Journal
from rotator.runtime.keeping import CardWatch, Keeping
from rotator.runtime.sensor_thread import SensorThread

log = logging.getLogger(__name__)

LATE_PERIODS = 1.5
"""Periods the loop waits for new readings. Then it acts without them, and notices that the sensors are silent."""
COAST_S = 3.0
"""Longest wait, in seconds, for a motor that coasts or brakes when the loop ends: the next run needs its count."""
SUPPLY, HEARTBEAT, LINKS, PAGE_LOOP = "supply", "heartbeat", "the links", "the page"
DRIVES = {axis: f"{axis.value} drive" for axis in Axis}
MUST_OBEY = (SUPPLY, LINKS, *DRIVES.values())
"""Devices whose failure silences the sign of life: a relay may be closed, or no stop arrives."""


class ControlLoop:
    """`post` and `status` may be used from any thread; all else from one thread only: that of `run`, or of a rehearsal.

    The loop calls `after_good_step` after each step in which the drives and the motors' supply obeyed. It may raise
    HardwareError.
    """

    def __init__(
        self,
        controller: Controller,
        rotor: Rotor,
        clock: Callable[[], float],
        period_s: float,
        *,
        after_good_step: Callable[[], None] = lambda: None,
        events: EventWatch | None = None,
        page_events: EventWatch | None = None,
        keeping: Keeping | None = None,
        card: CardWatch | None = None,
    ) -> None:
        """`events`: the watch over the event loop that serves the links; None: there are no links.

        `page_events`: the same for the page.

        `keeping` gets what must outlive the program; `card` says whether the card takes it.
        """
        self._controller = controller
        self._after_good_step = after_good_step
        self._events, self._page_events = events, page_events
        self._keeping, self._card = keeping or Keeping(), card or CardWatch()
        self._rotor, self._errands = rotor, Errands(rotor)
        self._clock = clock
        self._period_s = period_s
        self._journal = Journal(clock)
        self._wake = Bell()
        self._inbox = Inbox(self._wake.ring)
        self._acted_on = 0
        """How many of the orders that came show in the status."""
        self._sensors = SensorThread(rotor, clock, period_s, self._journal, self._wake.ring)
        self._listeners: list[Callable[[Source, Order], None]] = []
        self._stopping = False
        self._failure: Exception | None = None
        """The bug that ended another thread. Without that thread nothing may move."""
        self._late_s = 0.0
        self._supply_cut = self._links_lost = self._page_lost = False
        self.status: Status = controller.status(clock())
        """The latest status. Each step replaces it whole; a status never changes."""
        self._keeping.look(self.status)

    def post(self, source: Source, order: Order, *, can_wait: bool = False) -> None:
        """Hand over an order. It takes effect at once, not in the next cycle. May be called from any thread.

        An order that `can_wait` takes effect in the next cycle. It replaces an order of the same kind from the same
        source that waits as well, so a flood of orders costs little and the newest wins.
        """
        try:
            # Tell the planners first. Otherwise a planner could order a flight after a stop that it does not know yet.
            for listener in self._listeners:
                listener(source, order)
        finally:
            self._inbox.post(source, order, can_wait=can_wait)

    def overhear(self, listener: Callable[[Source, Order], None]) -> None:
        """Call this listener with every order, before the order acts, in the thread that posts it. It must not wait.

        While an event loop stands still and no order arrives, the control thread calls it with a stop.
        """
        self._listeners.append(listener)

    @property
    def orders_wait(self) -> bool:
        """Whether an order has come that the status does not know yet."""
        return self._inbox.posted != self._acted_on

    def cycle(self) -> None:
        """Read every sensor, then act: the whole loop in one thread, for simulated time."""
        self._sensors.read_all()
        self.act()

    def act(self) -> None:
        """Take the orders that have come, decide, drive and log, with the latest readings.

        Raises HardwareError when the rotor is no longer guarded: nothing may move then.
        """
        self._rotor.check()
        posted, orders = self._inbox.posted, self._inbox.take()
        now_s = self._clock()
        before = self.status
        self._watch_links(now_s)
        commands = self._controller.step(now_s, self._sensors.readings, orders)
        driven = {}
        self._errands.run(self._controller.errands, now_s)
        self._controller.errands.clear()
        for axis, command in commands.items():
            try:
                driven[axis] = self._rotor.obey(axis, command)
                self._journal.note(DRIVES[axis], "")
            except HardwareError as fault:
                # A relay that could not be opened counts as closed.
                driven[axis] = self._rotor.driven(axis)
                self._journal.note(DRIVES[axis], str(fault))
        # A computer that stood still meanwhile has closed or opened them only now.
        self._controller.note_driven(self._clock(), driven)
        self.status = self._controller.status(now_s, self._late_s)
        unkept, failed = self._card.look(now_s), self._errands.notices(now_s)
        if unkept or failed:
            more = (unkept.text, *failed) if unkept else failed
            self.status = replace(self.status, notices=self.status.notices + more, unkept=unkept)
        self._acted_on = posted
        self._keeping.look(self.status)
        self._switch_supply()
        self._log(before)
        self._sign_of_life()

    def run(self) -> None:
        """Act on each round of readings and on each order until `stop`. Relays are off when this returns."""
        try:
            self._sensors.start()
            while not self._stopping:
                asked_s = self._clock()
                self._wake.wait(self._period_s * LATE_PERIODS)
                if self._failure is not None:
                    raise self._failure
                if self._stopping:
                    break
                self._late_s = max(0.0, self._clock() - asked_s - self._period_s)
                self.act()
                if self._sensors.failure is not None:
                    raise self._sensors.failure
        finally:
            try:
                self._rotor.off()
                self._see_the_coast()
            finally:
                self.leave()
                self._sensors.join()

    def fail(self, failure: Exception) -> None:
        """Let `run` end with this failure of another thread. May be called from any thread."""
        self._failure = failure
        self._wake.ring()

    def stop(self) -> None:
        """Let `run` end, from any thread. May be called twice."""
        self._stopping = True
        self._wake.ring()

    def leave(self) -> None:
        """End the sensor thread too, even if `run` hangs. May be called twice, from any thread."""
        self.stop()
        self._sensors.stop()

    def _see_the_coast(self) -> None:
        give_up_s = self._clock() + COAST_S
        while self._rotor.coasts() and self._sensors.failure is None and self._clock() < give_up_s:
            self._wake.wait(self._period_s)

    def _watch_links(self, now_s: float) -> None:
        """While an event loop stands still, its links or its page cannot send a stop. So motion ordered there ends."""
        stalled_s = self._events.stalled_s(now_s) if self._events else 0.0
        if stalled_s:
            self._controller.links_lost()
            if not self._links_lost:
                self._end_plans(LINKS)
        self._links_lost = bool(stalled_s)
        self._journal.note(
            LINKS, "the event loop stands still: motion that they ordered has ended" if stalled_s else ""
        )
        page_stalled_s = self._page_events.stalled_s(now_s) if self._page_events else 0.0
        if page_stalled_s:
            self._controller.page_lost()
            if not self._page_lost and self.status.held_by.startswith(PAGE):
                self._end_plans(PAGE_LOOP)
        self._page_lost = bool(page_stalled_s)
        self._journal.note(
            PAGE_LOOP, "it stands still: motion that was ordered there has ended" if page_stalled_s else ""
        )

    def _end_plans(self, lost: str) -> None:
        """A plan that is being computed for a person or a program there ends too."""
        for listener in self._listeners:
            listener(Source(lost), Stop())

    def _switch_supply(self) -> None:
        """Cut the motors' supply when a fault requires it; restore it after the acknowledgement. Try until it works."""
        if self.status.cut == self._supply_cut:
            return
        try:
            if self.status.cut:
                self._rotor.cut()
            else:
                self._rotor.restore()
            self._supply_cut = self.status.cut
            self._journal.note(SUPPLY, "")
        except HardwareError as fault:
            self._journal.note(SUPPLY, str(fault))

    def _log(self, before: Status) -> None:
        for trouble in self._controller.troubles:
            log.warning("%s", trouble)
        self._controller.troubles.clear()
        self._journal.changed(before, self.status)

    def _sign_of_life(self) -> None:
        """Feed the heartbeat line and the service manager, unless a relay may not have obeyed.

        Without this sign of life they switch the motors off.
        """
        if self._journal.any_fails(MUST_OBEY):
            return
        try:
            self._after_good_step()
            self._journal.note(HEARTBEAT, "")
        except HardwareError as fault:
            self._journal.note(HEARTBEAT, str(fault))
