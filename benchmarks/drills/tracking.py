"""Tracking in the box of a drill: the real tracker and follower, in a thread that runs only in its turn.

Knows that a plan takes a while, in which the world goes on, and that it may fail. So that a drill is the same each
time, the thread and the drill never run at once. Does not know what an order does.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from benchmarks.drills.arcs import SITE, Arcs
from rotator.assembly.tracking import TrackedBox
from rotator.config.model import Config
from rotator.control.sky.flight_plan import Antenna
from rotator.control.sky.mount import Mount
from rotator.exchange.flight_order import Fly, Stream, TakeTurn
from rotator.exchange.orders import Order
from rotator.exchange.sources import Source
from rotator.runtime.loop import ControlLoop
from rotator.tracking.follower import Follower
from rotator.tracking.listener import LED_S
from rotator.tracking.next_flight import NextFlight, Now, Upcoming, Wanted, WantedOften
from rotator.tracking.program import Program, program_flight
from rotator.tracking.thread import LOOK_S
from rotator.tracking.tracker import Tracker

PLAN_S = 1.0
RECOGNISED = Stream(rounding_deg=1.0, ahead_s=(-2.0, 2.0))
Result = TypeVar("Result")


class Ended(BaseException):
    """The program ends, and its tracking thread with it."""


class LatePlanner:
    """Plans at once and answers `takes_s` later. `wait` lets the world go on meanwhile."""

    def __init__(self, wait: Callable[[float], None]) -> None:
        self._arcs = Arcs()
        self._wait = wait
        self.takes_s = PLAN_S
        self.fails = False

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises RuntimeError while `fails`, as the other plans do."""
        return self._late(self._arcs.plan(wanted, antenna, now))

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return self._late(self._arcs.plan_rest(wanted, antenna, now))

    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        return self._late(self._arcs.plan_followed(followed, antenna, now))

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        return self._late(program_flight(program, antenna, now))

    def _late(self, result: Result) -> Result:
        self._wait(self.takes_s)
        if self.fails:
            raise RuntimeError("the plan could not be made (as drilled)")
        return result


class DrilledTracking:
    """Call `turn` after each step of the world, and `end` before the box is thrown away. `begun_s`: the clock's time
    when the drill began."""

    def __init__(
        self, config: Config, loop: ControlLoop, mount: Mount, clock: Callable[[], float], begun_s: float
    ) -> None:
        self._clock = clock
        self.ahead_s = -begun_s
        """Added to the clock it gives the drill's UTC, which begins at 0 with the drill."""
        self.planner = LatePlanner(self._wait)
        self._box = TrackedBox(config, loop, mount)
        self.tracker = Tracker(Arcs(), self.planner, self._box, lambda: True)
        followed = tuple(WantedOften(Wanted(each.name, SITE, None), 1.0, 0.0) for each in config.sky.follow)
        self._follower = Follower(self.tracker, self.planner, self._box, lambda: followed)
        loop.overhear(self._hear)
        self._recognised: deque[tuple[Source, str, bool]] = deque()
        """The source, the words of the arc, and whether the source waits for its rise."""
        self._due_s = clock()
        self._ending = False
        self._failure: BaseException | None = None
        self._mine, self._back = threading.Semaphore(0), threading.Semaphore(0)
        self._thread = threading.Thread(target=self._run, name="tracking", daemon=True)
        self._thread.start()

    def recognise(self, source: Source, words: str, *, waits: bool) -> None:
        """The orders of this source have been recognised: plan the flight; this plan comes late too. `waits`: the
        source waits for the rise, and only gets the turn that the whole pass needs."""
        self._recognised.append((source, words, waits))

    def turn(self) -> None:
        """Let the thread run until it waits again. Raises the thread's exception, if any."""
        if self._clock() < self._due_s or not self._thread.is_alive():
            return
        self._mine.release()
        self._back.acquire()
        if self._failure is not None and not isinstance(self._failure, Ended):
            raise self._failure

    def end(self) -> None:
        """End the thread. A plan that is being computed is given up, and not flown."""
        self._ending, self._due_s = True, self._clock()
        self.turn()
        self._thread.join()

    def _hear(self, source: Source, order: Order) -> None:
        self.tracker.heard(source, order)
        self._follower.heard(source, order)

    # --- in the thread

    def _run(self) -> None:
        self._mine.acquire()
        try:
            while not self._ending:
                self._wait(LOOK_S)
                if self._recognised:
                    source, words, waits = self._recognised.popleft()
                    self._answer(source, words, waits=waits)
                self.tracker.step(self._now())
                self._follower.step(self._now())
        except BaseException as failure:
            self._failure = failure
        self._back.release()

    def _answer(self, source: Source, words: str, *, waits: bool) -> None:
        if (antenna := self._box.antenna()) is None:
            return
        try:
            self._box.order(self._turn(words, antenna) if waits else self._rest(words, antenna), source)
        except RuntimeError:
            return  # as drilled

    def _rest(self, words: str, antenna: Antenna) -> Fly:
        order = self.planner.plan_rest(Wanted(words, SITE, None), antenna, self._now())
        return replace(order, stream=RECOGNISED)

    def _turn(self, words: str, antenna: Antenna) -> TakeTurn:
        now = self._now()
        flight = self.planner.plan(Wanted(words, SITE, None), antenna, now)
        azimuth_deg, elevation_deg = flight.order.azimuth.angles_deg[0], flight.order.elevation.angles_deg[0]
        flipped = antenna.mount.model.over_the_top(elevation_deg)
        return TakeTurn(azimuth_deg, flipped, flight.begin_utc_s - now.apart_s + LED_S)

    def _now(self) -> Now:
        return Now(self._clock() + self.ahead_s, self._clock())

    def _wait(self, seconds: float) -> None:
        """Let the world go on for `seconds`."""
        self._due_s = self._clock() + seconds
        self._back.release()
        self._mine.acquire()
        if self._ending:
            raise Ended
