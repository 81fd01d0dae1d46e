"""A cam on a rotor's shaft that closes a contact every few degrees: its geometry, and why counting it can be exact.

Knows angles and widths. Knows no time but what the motor's speed says, and does not count.

On paper. The cam divides the scale into zones, even ones closed, odd ones the gaps above them:

    zone          -1    |     0      |   1    |     2      |   3
    contact      open   |   closed   |  open  |   closed   |  open
    begins at          c+0       c+closed   c+spacing   c+spacing+closed

Both edges of a closure are counted, each is one zone: turning plus, zone + 1, turning minus, zone - 1. A rotor that
closes the contact turning plus stands at the low edge of zone 0; it stops there, or in the gap beyond. Turned back from
inside, it leaves over the low edge into zone -1; turned back from the gap, it enters zone 0 over its high edge. Whoever
counts closures only must know which of the two it is; counting zones, the same closure met again from the other side is
the same zone, and nothing can be off by one. `play_deg` between shaft and cam shifts each edge for a shaft that turns
minus, and changes no count.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cam:
    """The cam and the motor that turns it. Angles are on the rotor's own scale."""

    spacing_deg: float
    """From one closure to the next."""
    closed_deg: float
    """How much of that the contact is closed."""
    closes_at_deg: float
    """Any angle at which the contact closes when turning clockwise or up."""
    speed_dps: float
    coast_s: float = 0.5
    """How long it turns on with its relay open; five times the lag of a motor that slows down exponentially."""
    play_deg: float = 0.0
    """Turning back, the contact changes this much later: gear play before the cam, spring of the contact."""
    low_deg: float = -math.inf
    """Its end stops."""
    high_deg: float = math.inf

    @property
    def lag_s(self) -> float:
        return self.coast_s / 5.0

    @property
    def shortest_s(self) -> float:
        """How long the contact stays as it is at least while the rotor runs; a debounce must be much shorter."""
        return min(self.closed_deg, self.spacing_deg - self.closed_deg) / self.speed_dps

    def begins_deg(self, zone: int) -> float:
        turns, gap = divmod(zone, 2)
        return self.closes_at_deg + turns * self.spacing_deg + gap * self.closed_deg

    def zone_at(self, angle_deg: float) -> int:
        zone = 2 * math.floor((angle_deg - self.closes_at_deg) / self.spacing_deg)
        return zone + (angle_deg >= self.begins_deg(zone + 1))
