"""Plans in simulated time, of which they take none. The running box has a process for them.

Knows which plans there are. Knows nothing of how they are computed.
"""

from __future__ import annotations

from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.flight_order import Fly
from rotator.tracking.next_flight import NextFlight, Now, Wanted, next_flight, rest_flight
from rotator.tracking.program import Program, program_flight


class PlansAtOnce:
    """`rotator.tracking.ports.Planner`."""

    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        return next_flight(wanted, antenna, now)

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        return program_flight(program, antenna, now)

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        return rest_flight(wanted, antenna, now)
