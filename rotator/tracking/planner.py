"""Plans in a process of its own: a plan takes seconds, and would hold the interpreter that the control loop needs.

Knows the kinds of plans. Does not know how they are computed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.flight_order import Fly
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.runtime.own_process import OwnProcess
from rotator.tracking.next_flight import (
    NeverRises,
    NextFlight,
    Now,
    Upcoming,
    Wanted,
    WantedOften,
    next_flight,
    next_followed,
    rest_flight,
)
from rotator.tracking.program import CannotFly, Program, program_flight

LONGEST_S = 120.0
"""Longest time for a plan, in seconds. Then it is given up."""
Result = TypeVar("Result")


class ProcessPlanner:
    """The process starts with the first plan, and ends with `close`."""

    def __init__(self) -> None:
        self._process = OwnProcess(LONGEST_S, again=True)

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises NeverRises, NotThere, Unknown; RuntimeError where the process fails."""
        return self._compute(next_flight, wanted, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        """Raises NotThere; RuntimeError where the process fails."""
        return self._compute(rest_flight, wanted, antenna, now)

    def plan_followed(self, followed: tuple[WantedOften, ...], antenna: Antenna, now: Now) -> Upcoming | None:
        """Raises NotThere, Unknown; RuntimeError where the process fails."""
        return self._compute(next_followed, followed, antenna, now)

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        """Raises CannotFly; RuntimeError where the process fails."""
        return self._compute(program_flight, program, antenna, now)

    def close(self) -> None:
        """From any thread. The present plan fails, and each later one too."""
        self._process.close()

    def _compute(self, job: Callable[..., Result], *arguments: Any) -> Result:
        try:
            return self._process.compute(job, *arguments)
        except (NeverRises, NotThere, Unknown, CannotFly):
            raise
        except Exception as failure:
            # A bug in a plan ends this plan too, but not the thread that asked for it.
            raise RuntimeError(f"the plan could not be made ({failure or type(failure).__name__})") from failure
