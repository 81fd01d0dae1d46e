"""A cam on a rotor's shaft that closes a contact every few degrees: its geometry, and why the count can be exact.

Knows angles, widths and the motor's speed. Does not know when the contact changes, and does not count.

The geometry. The cam divides the scale into zones, even ones closed, odd ones the gaps above them:

    zone          -1    |     0      |   1    |     2      |   3
    contact      open   |   closed   |  open  |   closed   |  open
    begins at          c+0       c+closed   c+spacing   c+spacing+closed

Both edges of a closure are counted. Each edge is one zone: zone + 1 when turning plus, zone - 1 when turning minus. A
rotor that turns plus and closes the contact is at the low edge of zone 0. It stops inside zone 0, or in the gap beyond.
Turned back from inside, it leaves over the low edge into zone -1. Turned back from the gap, it enters zone 0 over its
high edge. A count of closures alone would have to know which of the two happened. A count of zones need not: from both
sides the same closure is the same zone, so the count cannot be off by one. `play_deg` between shaft and cam shifts each
edge for a shaft that turns minus, and changes no count.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Direction

BEYOND = 2.0
"""Closures that a shaft may stand beyond the end of its range, at most."""
FASTER = 2.0
"""Factor by which the measured speed of a motor may differ from its configured speed."""


@dataclass(frozen=True, slots=True)
class Cam:
    """The cam and the motor that turns it. Angles are on the rotor's own scale."""

    spacing_deg: float
    """From one closure to the next."""
    closed_deg: float
    """The part of the spacing in which the contact is closed."""
    closes_at_deg: float
    """One angle at which the contact closes when the shaft turns clockwise or up. Any such angle will do."""
    speed_dps: float
    coast_s: float = 0.5
    """Seconds that the shaft turns on after its relay opened: five time constants of the motor."""
    play_deg: float = 0.0
    """Degrees by which a shaft that turns back meets each edge later: gear play, and spring of the contact."""
    low_deg: float = -math.inf
    """The lower end stop."""
    high_deg: float = math.inf
    """The upper end stop."""

    @property
    def lag_s(self) -> float:
        """The time constant of the motor."""
        return self.coast_s / 5.0

    @property
    def shortest_s(self) -> float:
        """The shortest time between two changes while the rotor runs; a debounce must be much shorter."""
        return min(self.closed_deg, self.spacing_deg - self.closed_deg) / self.speed_dps

    def crossing_s(self, *, closed: bool) -> float:
        """Seconds that the contact stays closed, or open, at full speed."""
        width_deg = self.closed_deg if closed else self.spacing_deg - self.closed_deg
        return width_deg / self.speed_dps

    def reaches(self, angle_deg: float) -> bool:
        """Whether the shaft may stand there. A stop may lie somewhat beyond its angle in the configuration."""
        return self.low_deg - BEYOND * self.spacing_deg <= angle_deg <= self.high_deg + BEYOND * self.spacing_deg

    def begins_deg(self, zone: int) -> float:
        """The zone's lower edge."""
        turns, gap = divmod(zone, 2)
        return self.closes_at_deg + turns * self.spacing_deg + gap * self.closed_deg

    def zone_at(self, angle_deg: float) -> int:
        """The zone of this angle. The contact is closed in even zones, open in odd ones."""
        zone = 2 * math.floor((angle_deg - self.closes_at_deg) / self.spacing_deg)
        return zone + (angle_deg >= self.begins_deg(zone + 1))

    def zones(self, low_deg: float, high_deg: float) -> range:
        """The possible zones of a shaft between these angles. If the shaft last turned minus, the cam may be above it,
        by the play, `play_deg` at most."""
        return range(self.zone_at(low_deg), self.zone_at(high_deg + self.play_deg) + 1)

    def ahead(self, zone: int) -> frozenset[Direction]:
        """The directions in which a shaft in this zone crosses an edge before its stop."""
        below = self.begins_deg(zone) - self.play_deg > self.low_deg
        above = self.begins_deg(zone + 1) <= self.high_deg
        return frozenset(way for way, edge in ((Direction.MINUS, below), (Direction.PLUS, above)) if edge)
