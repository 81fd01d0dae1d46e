"""The time to turn the antenna from one place to another between two passes, and the places where it may stand.

Knows the motors' speeds and the ways round forbidden sectors. Knows no pass and no time of day.
"""

from __future__ import annotations

from rotator.control.sky.angles import FULL_TURN_DEG, turn_deg
from rotator.control.sky.detour import Detours, box_about
from rotator.control.sky.flight_plan import Antenna, PlannedMotor
from rotator.control.sky.route import Speeds
from rotator.control.sky.sectors import Place, box_at, kept

ROOM_S = 0.5
"""Room of a motor before a sector: its way in this time, in seconds, plus its coast."""
STANDS_WITHIN_DEG = 0.5
"""Distance from its place at which an axis may stand, beside the play of its gears."""


class Travel:
    def __init__(self, antenna: Antenna) -> None:
        mount, azimuth, elevation = antenna.mount.about(0.0), antenna.azimuth, antenna.elevation
        self._endless = antenna.mount.azimuth.endless
        self._speeds = Speeds(azimuth.speed_dps, elevation.speed_dps)
        room_deg = _room_deg(azimuth), _room_deg(elevation)
        self._about_deg = azimuth.play_deg + STANDS_WITHIN_DEG, elevation.play_deg + STANDS_WITHIN_DEG
        self._zones = [kept(sector, *room_deg) for sector in mount.sectors]
        self._detours = Detours(mount, room_deg, self._about_deg, self._speeds)
        self._walls_deg = [
            zone.box.azimuth.middle_deg
            for zone in self._zones
            if zone.box.elevation.min_deg <= mount.elevation.min_deg
            and zone.box.elevation.max_deg >= mount.elevation.max_deg
        ]
        """Sectors from the lowest elevation to the highest. No way leads past them."""
        self._side = self._side_of(antenna.stands_deg)
        span = antenna.mount.azimuth.shown
        azimuth_s = (span.max_deg - span.min_deg) / azimuth.speed_dps
        elevation_s = (mount.elevation.max_deg - mount.elevation.min_deg) / elevation.speed_dps
        # Round a sector elevation turns to the other end and back while azimuth waits.
        self.longest_s = azimuth_s + 2 * elevation_s if mount.sectors else max(azimuth_s, elevation_s)
        """Seconds from any place to any other, at most."""

    def seconds(self, from_deg: Place, to_deg: Place) -> float:
        """Seconds for the way; infinite if no way leads there."""
        if not self._zones or from_deg == to_deg:
            return self.least_s(from_deg, to_deg)
        sides = [to_deg]
        if self._endless:
            from_deg = from_deg[0] % FULL_TURN_DEG, from_deg[1]
            east_deg = from_deg[0] + (to_deg[0] - from_deg[0]) % FULL_TURN_DEG
            sides = [(east_deg, to_deg[1]), (east_deg - FULL_TURN_DEG, to_deg[1])]
        here = box_about(from_deg, self._about_deg)
        return min(self._detours.seconds(here, side) for side in sides)

    def reaches(self, from_deg: Place, to_deg: Place, within_s: float) -> bool:
        if self.least_s(from_deg, to_deg) > within_s:
            return False
        return not self._zones or within_s >= self.longest_s or self.seconds(from_deg, to_deg) <= within_s

    def least_s(self, from_deg: Place, to_deg: Place) -> float:
        """Seconds with both motors at once, if no sector lies between."""
        turned_deg = turn_deg(from_deg[0], to_deg[0]) if self._endless else to_deg[0] - from_deg[0]
        azimuth_s = abs(turned_deg) / self._speeds.azimuth_dps
        elevation_s = abs(to_deg[1] - from_deg[1]) / self._speeds.elevation_dps
        return azimuth_s if azimuth_s > elevation_s else elevation_s

    def may_stand(self, place: Place) -> bool:
        """Whether the place lies outside each sector and the motors' room before it."""
        if self._endless:
            place = place[0] % FULL_TURN_DEG, place[1]
        return not any(zone.box.meets(box_at(place)) for zone in self._zones) and self.on_this_side(place)

    def on_this_side(self, place: Place) -> bool:
        """Whether no sector over all elevations lies between this place and the antenna."""
        return not self._walls_deg or self._side_of(place) == self._side

    def _side_of(self, place: Place) -> int:
        if not self._endless:
            return sum(wall_deg < place[0] for wall_deg in self._walls_deg)
        # Three turns of walls: past the last wall of a turn it is the first side again, and one wall has one side only.
        count = len(self._walls_deg) // 3
        return sum(wall_deg < place[0] % FULL_TURN_DEG for wall_deg in self._walls_deg) % count if count else 0


def _room_deg(motor: PlannedMotor) -> float:
    return motor.speed_dps * (ROOM_S + motor.coast_s)
