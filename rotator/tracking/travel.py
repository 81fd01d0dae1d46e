"""The time to turn the antenna from one place to another between two passes, and the places where it may stand.

Knows the motors' speeds and the ways round forbidden sectors. Knows no pass and no time of day.
"""

from __future__ import annotations

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
        mount, azimuth, elevation = antenna.mount, antenna.azimuth, antenna.elevation
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
        azimuth_s = (mount.azimuth.max_deg - mount.azimuth.min_deg) / azimuth.speed_dps
        elevation_s = (mount.elevation.max_deg - mount.elevation.min_deg) / elevation.speed_dps
        # Round a sector elevation turns to the other end and back while azimuth waits.
        self.longest_s = azimuth_s + 2 * elevation_s if mount.sectors else max(azimuth_s, elevation_s)
        """Seconds from any place to any other, at most."""

    def seconds(self, from_deg: Place, to_deg: Place) -> float:
        """Seconds for the way; infinite if no way leads there."""
        if not self._zones or from_deg == to_deg:
            return self.least_s(from_deg, to_deg)
        return self._detours.seconds(box_about(from_deg, self._about_deg), to_deg)

    def reaches(self, from_deg: Place, to_deg: Place, within_s: float) -> bool:
        if self.least_s(from_deg, to_deg) > within_s:
            return False
        return not self._zones or within_s >= self.longest_s or self.seconds(from_deg, to_deg) <= within_s

    def least_s(self, from_deg: Place, to_deg: Place) -> float:
        """Seconds with both motors at once, if no sector lies between."""
        azimuth_s = abs(to_deg[0] - from_deg[0]) / self._speeds.azimuth_dps
        elevation_s = abs(to_deg[1] - from_deg[1]) / self._speeds.elevation_dps
        return azimuth_s if azimuth_s > elevation_s else elevation_s

    def may_stand(self, place: Place) -> bool:
        """Whether the place lies outside each sector and the motors' room before it."""
        return not any(zone.box.meets(box_at(place)) for zone in self._zones) and self.on_this_side(place)

    def on_this_side(self, place: Place) -> bool:
        """Whether no sector over all elevations lies between this place and the antenna."""
        return not self._walls_deg or self._side_of(place) == self._side

    def _side_of(self, place: Place) -> int:
        return sum(wall_deg < place[0] for wall_deg in self._walls_deg)


def _room_deg(motor: PlannedMotor) -> float:
    return motor.speed_dps * (ROOM_S + motor.coast_s)
