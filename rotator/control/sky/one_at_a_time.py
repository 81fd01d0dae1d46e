"""The steps of two motors that may not run together: elevation does not wait until a long turn of azimuth is over.

Knows the steps as they were planned for each motor alone, and both speeds. Does not know the path: a step keeps its
place, only its moment changes. That the second motor waits is no matter of the plan: the relays see to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from rotator.control.sky.route import Speeds
from rotator.exchange.flight_order import Step

SPARE_S = 0.5
"""From the end of one motor's run to the beginning of the other's."""


def before_azimuth(azimuth: Sequence[Step], elevation: Sequence[Step], speeds: Speeds) -> tuple[Step, ...]:
    """Elevation's steps. What it is to do in the first half of a turn of azimuth is done in one step before it."""
    steps = list(elevation)
    for before, turn in pairwise(azimuth):
        middle_s = turn.leave_s + abs(turn.place_deg - before.place_deg) / speeds.azimuth_dps / 2
        within = [number for number, step in enumerate(steps) if number and turn.leave_s <= step.leave_s < middle_s]
        if not within:
            continue
        first, last = within[0], within[-1]
        stands, goal = steps[first - 1], steps[last]
        takes_s = abs(goal.place_deg - stands.place_deg) / speeds.elevation_dps + SPARE_S
        leave_s = min(goal.leave_s, max(stands.leave_s, turn.leave_s - takes_s))
        steps[first : last + 1] = [Step(leave_s, goal.place_deg)]
    return tuple(steps)
