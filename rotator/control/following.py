"""Whether a program's orders still agree with the satellite's path that is flown in their place.

Knows the path, and how far the program's clock may be ahead of the true time: each order narrows that. Knows nothing of
axes, nor of how the satellite was recognised.
"""

from __future__ import annotations

from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, great_circle_deg
from rotator.control.sky.known_path import KnownPath
from rotator.orders import Aim, Fly, Source, Stream

CLOCK_STEP_S = 0.25
QUIET_S = 20.0
"""A stream has ended after this time without an order. Some programs send only when a whole degree has changed."""


class Following:
    """`order.stream` must be there: its sender is `source`."""

    def __init__(self, order: Fly, source: Source, now_s: float) -> None:
        assert order.stream is not None, "a flight in place of a stream names it"
        self.source = source
        self._path = KnownPath(order.path)
        self._stream: Stream = order.stream
        self._heard_s = now_s
        least_s, most_s = self._stream.ahead_s
        count = int((most_s - least_s) / CLOCK_STEP_S) + 1
        self._clocks_s = tuple(least_s + CLOCK_STEP_S * step for step in range(count))
        """How far ahead the program's clock may be."""

    def agrees(self, source: Source, aim: Aim, now_s: float) -> bool:
        """Whether this order is one more of the stream. Any other order ends the flight."""
        azimuth_deg, elevation_deg = aim.azimuth_deg, aim.elevation_deg
        if source != self.source or not aim.engaged or aim.place or azimuth_deg is None or elevation_deg is None:
            return False
        if azimuth_deg > FULL_TURN_DEG or elevation_deg > ZENITH_DEG:  # the program plans by itself
            return False
        apart_deg = {}
        for ahead_s in self._clocks_s:
            path_azimuth_deg, path_elevation_deg = self._path.direction(now_s + ahead_s)
            # Programs send no elevation below zero.
            risen_deg = max(0.0, path_elevation_deg)
            apart_deg[ahead_s] = great_circle_deg(azimuth_deg, elevation_deg, path_azimuth_deg, risen_deg)
        if min(apart_deg.values()) > self._stream.departs_deg:
            return False
        self._clocks_s = self._stream.narrowed(apart_deg)
        self._heard_s = now_s
        return True

    def silent(self, now_s: float) -> bool:
        return now_s - self._heard_s > QUIET_S
