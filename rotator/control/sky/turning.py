"""Computes a turn of the antenna to another way while the target moves on: when it arrives, and its error until then.

Knows the target's path, the mount and the motors' speeds. Does not know which turn is the best.
"""

from __future__ import annotations

from collections.abc import Sequence

from rotator.control.sky.angles import ZENITH_DEG, lifted_deg
from rotator.control.sky.mount import Mount
from rotator.control.sky.route import STEP_S, Direction, Flown, Speeds, is_seen

Place = tuple[float, float]
"""Azimuth and elevation on the axes' own scales."""
LIFTS_FROM_DEG = 75.0
"""While azimuth turns back under a target above this, elevation goes nearer to the zenith, and so nearer to the target.
Lower targets are lost meanwhile anyway."""
LIFT_LATE_DEG, LITTLE_LATE_DEG = 1.0, 0.5
"""Both motors turn at once then, on relays in steps: the antenna is this much further off than after even motions. A
motor without relays is a little behind its path."""


class Turning:
    """Directions are `STEP_S` apart."""

    def __init__(self, mount: Mount, directions: Sequence[Direction], speeds: Speeds) -> None:
        self._mount = mount
        self._directions = directions
        self._speeds = speeds
        self._late_deg = lift_late_deg(speeds)
        self._elevation = mount.elevation
        self._seen = [is_seen(mount, *direction) for direction in directions]

    def arrival(self, from_deg: Place, to: Flown, earliest: int, *, left: int) -> int:
        """The look at which the antenna is on that way, `earliest` or later, if it left at the look `left`.

        The way moves on meanwhile. If the antenna does not get there before the path ends: the number of looks.
        """
        last = len(self._directions)
        for look in range(earliest, last):
            if self.travel_s(from_deg, to.place(look)) <= (look - left) * STEP_S:
                return look
        return last

    def change(self, before: Flown, to: Flown, look: int) -> int:
        """The look at which a change of way that begins at `look` is done. It is always a later look: two ways may wait
        at the same limit, and a change that takes no time could follow itself without end."""
        return self.arrival(before.place(look), to, look + 1, left=look)

    def errors_deg(self, from_deg: Place, to: Flown, look: int, arrival: int) -> list[float]:
        """The error from each look to the next until the antenna arrives. Looks at an unseen target are left out.

        Of a turn that is over before the next look, its middle counts: there it is worst.
        """
        there, errors_deg = to.place(min(arrival, len(self._directions) - 1)), []
        middle_s = STEP_S / 2
        if arrival == look + 1:
            middle_s = min(middle_s, self.travel_s(from_deg, there) / 2)
        stands_deg, past_s = from_deg[1], middle_s
        for number in range(look, arrival):
            azimuth_deg, elevation_deg = self._directions[number]
            axis_azimuth_deg, _ = self.after(from_deg, there, (number - look) * STEP_S + middle_s)
            lifted = lifted_between_deg(axis_azimuth_deg, self._directions[number], (from_deg[1], there[1]))
            aim_deg = there[1] if lifted is None else self._elevation.nearest(lifted)
            stands_deg = turned_deg(stands_deg, aim_deg, self._speeds.elevation_dps * past_s)
            past_s = STEP_S
            if self._seen[number]:
                off_deg = self._mount.off_deg((axis_azimuth_deg, stands_deg), (azimuth_deg, max(0.0, elevation_deg)))
                errors_deg.append(off_deg if lifted is None else off_deg + self._late_deg)
        return errors_deg

    def travel_s(self, from_deg: Place, to_deg: Place) -> float:
        """The time for this turn. Both motors turn at once."""
        return max(
            abs(to_deg[0] - from_deg[0]) / self._speeds.azimuth_dps,
            abs(to_deg[1] - from_deg[1]) / self._speeds.elevation_dps,
        )

    def after(self, from_deg: Place, to_deg: Place, seconds: float) -> Place:
        """Where both axes are after this time."""
        return (
            turned_deg(from_deg[0], to_deg[0], self._speeds.azimuth_dps * seconds),
            turned_deg(from_deg[1], to_deg[1], self._speeds.elevation_dps * seconds),
        )


def lift_late_deg(speeds: Speeds) -> float:
    """How much further off the antenna is while elevation is lifted."""
    return LIFT_LATE_DEG if speeds.stepped else LITTLE_LATE_DEG


def lifted_between_deg(axis_azimuth_deg: float, target: Direction, between_deg: tuple[float, float]) -> float | None:
    """The elevation for a moment of a turn between these two elevations, with azimuth where it is by then.

    A turn that begins or ends past the zenith goes through it while azimuth is a quarter of a turn off.
    None: the target is too low.
    """
    azimuth_deg, elevation_deg = target
    if elevation_deg < LIFTS_FROM_DEG:
        return None
    return lifted_deg(azimuth_deg - axis_azimuth_deg, elevation_deg, over_top=max(between_deg) > ZENITH_DEG)


def turned_deg(from_deg: float, to_deg: float, by_deg: float) -> float:
    """Where a motor is that may turn so far towards its goal."""
    return from_deg + max(-by_deg, min(by_deg, to_deg - from_deg))
