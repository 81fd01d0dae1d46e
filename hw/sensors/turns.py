"""A sensor that knows the angle within one turn, on an axis that turns on and on: the whole turns are added.

Knows the sensor's latest reading: the next one is the nearest of all that look the same, so that north is no special
place. Begins anew, from 0 to 360, with the program. Does not judge a reading.
"""

from __future__ import annotations

import math

from hw.ports import AngleSensor


class Turns:
    """In degrees. `sensor`: its own reading grows by 1 in a whole turn. From one reading to the next the axis must turn
    by less than half a turn.
    """

    def __init__(self, sensor: AngleSensor) -> None:
        self._sensor = sensor
        self._last_deg: float | None = None
        self.source = sensor.source

    def read(self) -> float:
        """The angle in degrees, on past 360 and below 0. Raises HardwareError."""
        angle_deg = self._sensor.read() * 360.0
        if self._last_deg is not None:
            angle_deg = self._last_deg + math.remainder(angle_deg - self._last_deg, 360.0)
        self._last_deg = angle_deg
        return angle_deg
