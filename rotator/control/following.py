"""Whether a program's orders still agree with the satellite's path that is flown in their place.

Knows the path. `program_clock` says whether an order is near enough to it. Knows nothing of axes, nor of how the
satellite was recognised.
"""

from __future__ import annotations

from rotator.control.sky.angles import FULL_TURN_DEG, ZENITH_DEG, great_circle_deg
from rotator.control.sky.known_path import KnownPath
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Aim
from rotator.exchange.program_clock import ProgramClock
from rotator.exchange.sources import Source

CLOCK_STEP_S = 0.25
QUIET_S = 20.0
"""A stream has ended after this time without an order. Some programs send only when a whole degree has changed."""


class Following:
    """`order.stream` must be there: its sender is `source`."""

    def __init__(self, order: Fly, source: Source, now_s: float) -> None:
        assert order.stream is not None, "a flight in place of a stream names it"
        self.source = source
        self._path = KnownPath(order.path)
        self._heard_s = now_s
        least_s, most_s = order.stream.ahead_s
        count = int((most_s - least_s) / CLOCK_STEP_S) + 1
        self._clock = ProgramClock((least_s + CLOCK_STEP_S * step for step in range(count)), order.stream.rounding_deg)

    def agrees(self, source: Source, aim: Aim, now_s: float) -> bool:
        """Whether this order is one more of the stream. Any other order ends the flight."""
        azimuth_deg, elevation_deg = aim.azimuth_deg, aim.elevation_deg
        if source != self.source or not aim.engaged or aim.place or azimuth_deg is None or elevation_deg is None:
            return False
        if azimuth_deg > FULL_TURN_DEG or elevation_deg > ZENITH_DEG:  # the program plans by itself
            return False

        def apart_deg(ahead_s: float) -> float:
            path_azimuth_deg, path_elevation_deg = self._path.direction(now_s + ahead_s)
            # Programs send no elevation below zero.
            risen_deg = max(0.0, path_elevation_deg)
            return great_circle_deg(azimuth_deg, elevation_deg, path_azimuth_deg, risen_deg)

        if not self._clock.agrees(apart_deg):
            return False
        self._heard_s = now_s
        return True

    def silent(self, now_s: float) -> bool:
        return now_s - self._heard_s > QUIET_S
