"""Plans in a process of its own: a plan is seconds of computing, and the control loop shares one interpreter with it.

Knows how to start that process and how to use its answer. Knows nothing of what is computed.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import suppress
from typing import Any, TypeVar

from rotator.control.sky.flight_plan import Antenna
from rotator.orders import Fly
from rotator.tracking.next_flight import NextFlight, Now, Wanted, next_flight, rest_flight
from rotator.tracking.next_followed import Upcoming, WantedOften, next_followed

POLITE = 10
"""Its niceness: what turns the motors comes first."""
LONGEST_S = 120.0
"""A plan that takes longer is given up."""
Result = TypeVar("Result")


class ProcessPlanner:
    """The process starts with the first plan, and ends with `close`."""

    def __init__(self) -> None:
        self._pool: ProcessPoolExecutor | None = None
        self._closed = False

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises NeverRises, NotThere, Unknown; RuntimeError where the process fails."""
        return self._compute(next_flight, wanted, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        """Raises NotThere; RuntimeError where the process fails."""
        return self._compute(rest_flight, wanted, antenna, now)

    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        """Raises NotThere, Unknown; RuntimeError where the process fails."""
        return self._compute(next_followed, followed, antenna, now)

    def close(self) -> None:
        """From any thread. A plan that is under way fails, and none is made any more."""
        self._closed = True
        self._end()

    def _compute(self, job: Callable[..., Result], *given: Any) -> Result:
        if self._closed:
            raise RuntimeError("the box ends")
        if self._pool is None:
            # Spawned: a copy of this process would hold its relay lines and sockets.
            spawn = multiprocessing.get_context("spawn")
            self._pool = ProcessPoolExecutor(1, mp_context=spawn, initializer=_begin)
        try:
            return self._pool.submit(job, *given).result(LONGEST_S)
        except (BrokenExecutor, TimeoutError) as failure:
            self._end()
            raise RuntimeError(f"the plan could not be made ({failure or type(failure).__name__})") from None

    def _end(self) -> None:
        pool, self._pool = self._pool, None
        if pool is not None:
            pool.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()  # it may be in the middle of a plan


def _begin() -> None:
    """In the new process. The box ends it; Ctrl-C at the terminal is for the box."""
    with suppress(OSError):  # a service may be kept from it
        os.nice(POLITE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
