"""The thread of the tracker: looks twice a second, and reads changed files of elements now and then.

Knows time and threads. Does not know what is tracked.
"""

from __future__ import annotations

import logging
import threading
import time

from rotator.tracking.follower import Follower
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.listener import StreamListener
from rotator.tracking.next_flight import Now
from rotator.tracking.planner import ProcessPlanner
from rotator.tracking.system_clock import SystemClock
from rotator.tracking.tracker import Tracker

log = logging.getLogger(__name__)

LOOK_S = 0.5
REFRESH_S = 60.0


def _now() -> Now:
    return Now(time.time(), time.monotonic())


class TrackingThread:
    def __init__(
        self,
        tracker: Tracker,
        follower: Follower,
        listener: StreamListener,
        sky: KnownSky,
        *,
        planner: ProcessPlanner,
        clock: SystemClock,
    ) -> None:
        self.tracker = tracker
        self._follower = follower
        self._listener = listener
        self._sky = sky
        self._planner = planner
        self._clock = clock
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="tracking", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Returns when the thread has ended; a plan that is under way is given up."""
        self._stopping.set()
        self._planner.close()
        if self._thread.is_alive():  # a box that could not start has not begun it
            self._thread.join()

    def _run(self) -> None:
        refreshed_s, faults = time.monotonic(), self._tell(())
        while not self._stopping.wait(LOOK_S):
            self._clock.look(time.monotonic())
            if _now().loop_s - refreshed_s >= REFRESH_S:
                refreshed_s = _now().loop_s
                if self._sky.refresh():
                    self._listener.know()
                faults = self._tell(faults)
            self._listener.step(_now)
            self.tracker.step(_now())
            self._follower.step(_now())

    def _tell(self, before: tuple[str, ...]) -> tuple[str, ...]:
        """Each fault of a file of elements once."""
        for fault in self._sky.faults:
            if fault not in before:
                log.warning("[sky] elements: %s", fault)
        return self._sky.faults
