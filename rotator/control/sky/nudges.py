"""How far a person at the panel has shifted everything that is asked for.

Knows two angles. Knows nothing of who asks, or of where the antenna is.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis
from rotator.orders import Aim

FULL_TURN_DEG = 360.0


class Nudges:
    def __init__(self) -> None:
        self._deg = dict.fromkeys(Axis, 0.0)

    def set(self, axis: Axis, offset_deg: float) -> None:
        self._deg[axis] = offset_deg

    def clear(self) -> None:
        self._deg = dict.fromkeys(Axis, 0.0)

    def applied(self, asked: Aim) -> Aim:
        """What is asked for, shifted; an azimuth that does not name a turn of the overlap stays one of the circle."""
        azimuth_deg, elevation_deg = asked.azimuth_deg, asked.elevation_deg
        if azimuth_deg is not None and (by_deg := self._deg[Axis.AZIMUTH]):
            names_turn = azimuth_deg > FULL_TURN_DEG
            azimuth_deg = azimuth_deg + by_deg if names_turn else (azimuth_deg + by_deg) % FULL_TURN_DEG
        if elevation_deg is not None:
            elevation_deg += self._deg[Axis.ELEVATION]
        return replace(asked, azimuth_deg=azimuth_deg, elevation_deg=elevation_deg)
