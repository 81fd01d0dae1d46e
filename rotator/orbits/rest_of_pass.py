"""The rest of a pass that a program already sends: the flight in place of its orders.

Knows how far a program's clock may be behind, and that it sends on for a while after the set. Does not know how the
satellite was recognised.
"""

from __future__ import annotations

from dataclasses import dataclass

from rotator.orbits.sight import Target

CLOCKS_ASIDE_S = 10.0
"""Seconds before now at which a path begins, for the orders of a clock that is behind."""
AFTER_SET_S = 30.0
"""Programs send for a while after the target has set."""
LONGEST_PASS_S = 1800.0


@dataclass(frozen=True, slots=True)
class Rest:
    """Of a pass, from now on. Moments are UTC, in seconds since 1970."""

    rows: tuple[tuple[float, float, float], ...]
    """Each second: the moment, azimuth, elevation."""
    sets_s: float


def rest_of_pass(satellite: Target, utc_s: float) -> Rest:
    """The flight in place of a stream from this time on. Raises NotThere."""
    rows: list[tuple[float, float, float]] = []
    last_up_s, at_s = utc_s, utc_s - CLOCKS_ASIDE_S
    while at_s <= min(last_up_s + AFTER_SET_S, utc_s + LONGEST_PASS_S):
        seen = satellite.sight(at_s)
        rows.append((at_s, seen.azimuth_deg, seen.elevation_deg))
        if seen.elevation_deg > 0:
            last_up_s = max(last_up_s, at_s)
        at_s += 1.0
    return Rest(tuple(rows), last_up_s)
