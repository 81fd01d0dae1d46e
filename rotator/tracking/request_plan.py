"""The plan of a person's request: a table as it stands, or the target with its newest elements.

Knows where the target's elements come from when their file is gone. Does not know the state of the tracking.
"""

from __future__ import annotations

import logging

from rotator.control.sky.flight_plan import Antenna
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.tracking.next_flight import NextFlight, Now, Wanted
from rotator.tracking.ports import Finder, Planner
from rotator.tracking.tracked import Request

log = logging.getLogger(__name__)


def plan_of(
    request: Request, finder: Finder, planner: Planner, antenna: Antenna | None, now: Now
) -> tuple[NextFlight, Wanted | None]:
    """The next flight, and its target; None: a table has none. `antenna` None: its angles are not known.

    Raises as `Planner.plan` and `Planner.plan_program`.
    """
    if antenna is None:
        raise NotThere("the antenna's angles are not known")
    if request.program:
        return planner.plan_program(request.program, antenna, now), None
    wanted = _wanted(request, finder)
    return planner.plan(wanted, antenna, now), wanted


def _wanted(request: Request, finder: Finder) -> Wanted:
    """While the file of the elements is gone: the target of the flight before. Raises Unknown, NotThere."""
    try:
        if isinstance(wanted := finder.find(request.words), Wanted):
            return wanted
        raise Unknown(f'"{request.words}" is no moving target any more')  # without its file: a direction
    except Unknown as reason:
        before = request.flown.wanted if request.flown else None
        if before is None:
            raise
        log.warning("%s; it is tracked on with the elements read before", reason)
        return before
