"""How far the clock of a tracking program may be ahead of the true time, as the orders of its stream show it.

Knows the clock errors that are still possible, and the rounding of the program's orders; each order narrows them. Does
not know the satellite's path: the caller measures how far an order is from it. The recognition of a satellite and the
flight in place of a stream both ask here, so they agree on the order that ends a stream.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

DEPARTS_DEG = 1.5
"""Degrees beside the rounding: an order further from the satellite's path ends the match of its stream."""
BEARS_OUT_DEG = 0.5
"""Degrees beside the rounding: if the assumed clock error is right, the orders lie this near to the path."""


class ProgramClock:
    """`ahead_s`: the clock errors that are possible at first. `rounding_deg`: of the orders, 1 for whole degrees."""

    def __init__(self, ahead_s: Iterable[float], rounding_deg: float) -> None:
        self._ahead_s = tuple(ahead_s)
        self._rounding_deg = rounding_deg

    def agrees(self, apart_deg: Callable[[float], float]) -> bool:
        """Whether an order is still for this satellite. Then only the clock errors that agree with it are kept.

        `apart_deg`: the order's distance from the satellite's path if the clock has this error.
        """
        found_deg = {ahead_s: apart_deg(ahead_s) for ahead_s in self._ahead_s}
        nearest_deg = min(found_deg.values())
        if nearest_deg > self._rounding_deg + DEPARTS_DEG:
            return False
        most_deg = max(nearest_deg, self._rounding_deg) + BEARS_OUT_DEG
        self._ahead_s = tuple(ahead_s for ahead_s, deg in found_deg.items() if deg <= most_deg)
        return True
