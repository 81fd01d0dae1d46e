"""When a turn near the zenith begins, to half a second: the target passes there in seconds.

Knows the target's path in small steps, the ways before and after the turn, the motors' speeds, and the turn's moment to
`STEP_S`. Does not know which turns are made, nor how a motor makes them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rotator.control.sky.mount import Mount
from rotator.control.sky.route import STEP_S, Direction, Flown, Speeds
from rotator.control.sky.turning import LIFTS_FROM_DEG, Place, lift_late_deg, lifted_between_deg, turned_deg
from rotator.control.sky.ways import Leg, error_cost_s
from rotator.exchange.flight_order import PLAN_STEP_S

LOOK = round(STEP_S / PLAN_STEP_S)
"""Moments of the path from one look to the next."""


@dataclass(frozen=True, slots=True)
class Change:
    """The antenna leaves one place for another; its azimuth turns for so long. Seconds from the path's beginning."""

    leaves_s: float
    turns_s: float
    from_deg: Place
    there_deg: Place


def change_of(
    mount: Mount, directions: Sequence[Direction], legs: tuple[Leg, Leg], speeds: Speeds, *, stepped: bool
) -> Change:
    """The change from one leg to the next. `directions`: `PLAN_STEP_S` apart. `stepped`: its motor is on relays."""
    before, leg = legs
    looks = len(leg.flown.errors_deg)
    from_deg, there_deg = before.flown.place(leg.look), leg.flown.place(min(leg.arrival, looks - 1))
    turns_s = abs(there_deg[0] - from_deg[0]) / speeds.azimuth_dps
    # A turn that the end of the path cuts short has no time to spare: it begins at its look.
    spare_s = max(0.0, (leg.arrival - leg.look) * STEP_S - turns_s)
    change = Change(leg.look * STEP_S + (spare_s / 2 if stepped else 0.0), turns_s, from_deg, there_deg)
    middle = min(round((change.leaves_s + turns_s / 2) / PLAN_STEP_S), len(directions) - 1)
    if not turns_s or directions[middle][1] < LIFTS_FROM_DEG:
        return change
    turn = _Turn(mount, directions, legs, speeds)
    earliest, latest = max(before.arrival, leg.look - 1) * LOOK, min(leg.look + 1, leg.arrival - 1) * LOOK
    moments = sorted(range(earliest, latest + 1), key=lambda moment: abs(moment * PLAN_STEP_S - change.leaves_s))
    return min((turn.change(moment) for moment in moments), key=turn.cost)


class _Turn:
    def __init__(self, mount: Mount, directions: Sequence[Direction], legs: tuple[Leg, Leg], speeds: Speeds) -> None:
        self._mount, self._directions, self._speeds = mount, directions, speeds
        self._here, self._there = (Flown(mount, directions, leg.flown.way) for leg in legs)

    def change(self, moment: int) -> Change:
        """The turn that begins at this moment."""
        from_deg, at = self._here.place(moment), moment
        while at < len(self._directions) - 1 and self._turns_s(from_deg, at) > (at - moment) * PLAN_STEP_S:
            at += 1
        return Change(moment * PLAN_STEP_S, self._turns_s(from_deg, at), from_deg, self._there.place(at))

    def cost(self, change: Change) -> float:
        """The errors while it turns: lost seconds first."""
        azimuth_deg, elevation_deg = change.from_deg
        goal_deg, ends_deg = change.there_deg
        between_deg, cost = (elevation_deg, ends_deg), 0.0
        first = round(change.leaves_s / PLAN_STEP_S)
        for target in self._directions[first : first + round(change.turns_s / PLAN_STEP_S) + 1]:
            lifted = lifted_between_deg(azimuth_deg, target, between_deg)
            aim_deg = ends_deg if lifted is None else self._mount.elevation.nearest(lifted)
            elevation_deg = turned_deg(elevation_deg, aim_deg, self._speeds.elevation_dps * PLAN_STEP_S)
            off_deg = self._mount.off_deg((azimuth_deg, elevation_deg), target)
            cost += error_cost_s(off_deg if lifted is None else off_deg + lift_late_deg(self._speeds))
            azimuth_deg = turned_deg(azimuth_deg, goal_deg, self._speeds.azimuth_dps * PLAN_STEP_S)
        return cost

    def _turns_s(self, from_deg: Place, moment: int) -> float:
        return abs(self._there.place(moment)[0] - from_deg[0]) / self._speeds.azimuth_dps
