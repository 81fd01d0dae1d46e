"""The azimuth from the earth's magnetic field, by a compass chip that turns with the mast and stays level.

Knows how the board is mounted, what the iron around it does to the field once that has been learnt, and the range in
which the axis turns. A compass shows no turn: of the angles that fit, it takes the one within the range. Knows no
declination and no chip. Tilted, it would read the field's vertical part too: far wrong.
"""

from __future__ import annotations

import math
from collections import deque

from hw.ports import AngleSource, Ellipse, HardwareError, Magnetometer
from hw.sensors.mounting import Mounting

LEAST_SHARE, MOST_SHARE = 0.5, 1.5
"""With less or more than this of the learnt field, something pulls it."""
STEADIED = 8
"""Before the iron is learnt the heading is that of the mean of so many readings: iron that nearly cancels the earth's
field makes its noise many degrees.
"""
CLINGS_DEG = 15.0
"""So far beyond the window of one turn an angle goes on where it was, so that noise at its edge is no jump."""


class HeadingSensor:
    """A compass chip as a `hw.ports.AngleSensor` and `FeelsField`. `middle_deg`: the middle of the range, which is
    less than a turn.
    """

    source = AngleSource.MEASURED

    def __init__(
        self, chip: Magnetometer, middle_deg: float, *, mounting: Mounting | None = None, ellipse: Ellipse | None = None
    ) -> None:
        self.ellipse = ellipse
        self.field_ut: tuple[float, float] | None = None
        self._chip = chip
        self._middle_deg = middle_deg
        self._mounting = mounting or Mounting()
        self._felt: deque[tuple[float, float]] = deque(maxlen=STEADIED)
        self._latest_deg: float | None = None

    def read(self) -> float:
        """The heading in degrees, clockwise from magnetic north, on the turn in which the range lies.

        Raises HardwareError when the chip does not answer, is another chip, or feels no field of the earth alone.
        """
        field_ut = self.field_ut = self._mounting.level(self._chip.field_ut())
        if self.ellipse is None:
            self._felt.append(field_ut)
            ahead, left = map(math.fsum, zip(*self._felt, strict=True))
        else:
            self._felt.clear()
            ahead, left = self.ellipse.unit(field_ut)
            if not LEAST_SHARE <= (share := math.hypot(ahead, left)) <= MOST_SHARE:
                raise HardwareError(
                    f"{self._chip.name}: the field is {100 * share:.0f} % of what it was when it was learnt; something "
                    "of iron, a magnet or a motor's current is near: take it away, or calibrate the azimuth again"
                )
        heading_deg = math.degrees(math.atan2(left, ahead))
        angle_deg = self._middle_deg + _half_turn(heading_deg - self._middle_deg)
        if self._latest_deg is not None:
            going_on_deg = self._latest_deg + _half_turn(angle_deg - self._latest_deg)
            if abs(going_on_deg - self._middle_deg) <= 180.0 + CLINGS_DEG:
                angle_deg = going_on_deg
        self._latest_deg = angle_deg
        return angle_deg


def _half_turn(angle_deg: float) -> float:
    """The same angle between -180 and 180."""
    return (angle_deg + 180.0) % 360.0 - 180.0
