"""The steps of two motors that may not run together: elevation does not wait until a long turn of azimuth is over.

Knows the steps as they were planned for each motor alone, both speeds, and how far a place is from the target. Does not
know why azimuth turns. That the second motor waits is no matter of the plan: the relays see to it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise

from rotator.control.sky.route import Speeds
from rotator.control.sky.ways import error_cost_s
from rotator.exchange.flight_order import PLAN_STEP_S, Step

SPARE_S = 0.5
"""From the end of one motor's run to the beginning of the other's."""
EVERY_DEG = 1.0

Off = Callable[[float, float, float], float]
"""The error in degrees at this moment, with azimuth and elevation at these angles."""


def before_azimuth(
    azimuth: Sequence[Step], elevation: Sequence[Step], speeds: Speeds, off_deg: Off
) -> tuple[Step, ...]:
    """Elevation's steps. In place of those in the first half of a turn of azimuth it makes one step before it, to where
    the antenna does best for the whole turn."""
    steps = list(elevation)
    for before, turn in pairwise(azimuth):
        turns_s = abs(turn.place_deg - before.place_deg) / speeds.azimuth_dps
        from_s, middle_s = turn.leave_s - SPARE_S, turn.leave_s + turns_s / 2
        within = [number for number, step in enumerate(steps) if number and from_s <= step.leave_s < middle_s]
        if not within:
            continue
        first, last = within[0], within[-1]
        stands, *places_deg = steps[first - 1], *(step.place_deg for step in steps[first : last + 1])

        def cost(
            place_deg: float, before: Step = before, turn: Step = turn, count: int = int(turns_s / PLAN_STEP_S) + 1
        ) -> float:
            by_deg = (turn.place_deg - before.place_deg) / count
            return sum(
                error_cost_s(off_deg(turn.leave_s + at * PLAN_STEP_S, before.place_deg + at * by_deg, place_deg))
                for at in range(count + 1)
            )

        place_deg = min(_between_deg([stands.place_deg, *places_deg]), key=cost)
        takes_s = abs(place_deg - stands.place_deg) / speeds.elevation_dps + SPARE_S
        leave_s = min(steps[last].leave_s, max(stands.leave_s, turn.leave_s - takes_s))
        steps[first : last + 1] = [Step(leave_s, place_deg)]
    return tuple(steps)


def _between_deg(places_deg: Sequence[float]) -> list[float]:
    """From the lowest to the highest of these places; the last of them first, so that it wins where all are equal."""
    low_deg, high_deg = min(places_deg), max(places_deg)
    return [places_deg[-1], *(low_deg + EVERY_DEG * number for number in range(int((high_deg - low_deg) / EVERY_DEG)))]
