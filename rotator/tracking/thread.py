"""The thread of the tracker: looks twice a second, and reads files of elements at its start and when they change.

Knows time and threads. Does not know the target.
"""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable

from rotator.runtime.own_thread import OwnThread
from rotator.store.favourites import KeptFavourites
from rotator.store.priorities import Priorities
from rotator.tracking.follower import Follower
from rotator.tracking.known_sky import FileReader, KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import Now
from rotator.tracking.planner import ProcessPlanner
from rotator.tracking.system_clock import SystemClock
from rotator.tracking.tracker import Tracker

log = logging.getLogger(__name__)

LOOK_S = 0.5
REFRESH_S = 60.0
AGAIN_S = 2.0
"""Seconds of pause after a bug of the program."""


class TrackingThread(OwnThread):
    def __init__(
        self,
        tracker: Tracker,
        follower: Follower,
        listener: StreamListener,
        sky: KnownSky,
        *,
        planner: ProcessPlanner,
        reader: FileReader,
        clock: SystemClock,
        priorities: Priorities,
        favourites: KeptFavourites,
        steady_s: Callable[[], float] = time.monotonic,
    ) -> None:
        """`steady_s`: the clock of the control loop."""
        super().__init__("tracking")
        self.tracker = tracker
        self.sky = sky
        self.priorities = priorities
        self.favourites = favourites
        self.follower = follower
        self._listener = listener
        self._planner = planner
        self._reader = reader
        self._clock = clock
        self._steady_s = steady_s
        self._new_files = False
        self._refreshed_s = -math.inf
        self._told: tuple[str, ...] = ()
        """The faults of files of elements that are already in the log."""
        self._failure = ""
        """The latest bug of the program, as text."""

    def stop(self) -> None:
        """Returns when the thread has ended. A plan or a file in work is given up."""
        self._stopping.set()
        self._planner.close()
        self._reader.close()
        super().stop()

    def clock_is_known(self) -> bool:
        """From any thread: whether this computer's clock is right, as the system or a person says."""
        return self._clock.is_set or self.tracker.clock_told

    def _now(self) -> Now:
        # A simulated rotor may live at any time: then the clock counts as right.
        return Now(time.time(), self._steady_s(), self._clock.error_s if self.clock_is_known() else 0.0)

    def read_again(self) -> None:
        """From any thread: files of elements are new."""
        self._new_files = True

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                self._turn()
            except Exception as failure:
                self._failed(failure)

    def _turn(self) -> None:
        if self._new_files or self.tracker.wants_new_files or self._steady_s() - self._refreshed_s >= REFRESH_S:
            self._new_files = False
            self._refreshed_s = self._steady_s()
            if self.sky.refresh():
                self._listener.know()
            self.tracker.read_new_files()
            self._tell()
        self._stopping.wait(LOOK_S)
        self._clock.look(self._steady_s())
        self._listener.step(self._now)
        self.tracker.step(self._now())
        self.follower.step(self._now())

    def _failed(self, failure: Exception) -> None:
        """A bug of the program ends the tracking. The thread goes on, because a dead thread would answer nothing."""
        if repr(failure) != self._failure:
            log.error("tracking: the program has a mistake; please report it", exc_info=failure)
        self._failure = repr(failure)
        self.tracker.fail(f"the program has a mistake ({self._failure}): see the log")
        self._stopping.wait(AGAIN_S)

    def _tell(self) -> None:
        """Log each fault of a file of elements once."""
        for fault in self.sky.faults:
            if fault not in self._told:
                log.warning("[sky] elements: %s", fault)
        self._told = self.sky.faults
