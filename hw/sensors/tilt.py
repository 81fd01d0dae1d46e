"""The elevation from the direction of gravity, by an accelerometer on the boom.

Knows how the board is mounted, and that an accelerometer cannot separate gravity from another acceleration: a reading
far from 1 g is not used. Knows no chip and no rotor.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable

from hw.ports import Accelerometer, AngleSource, BoardAxes, HardwareError
from hw.sensors.mounting import Mounting

SHAKEN_G = 0.15
"""A reading further from 1 g than this is shaken by the motor or the wind, and not used."""
AVERAGED_OVER_S = 0.3
"""A result is the mean of the good readings of this many seconds. While the board shakes, these are older readings."""
LEAST_IN_PLANE_G = 0.5
"""With less gravity than this in the plane in which the boom turns, the board lies on its side."""


class TiltSensor:
    """An accelerometer as a `hw.ports.AngleSensor`. `clock` gives seconds. `averaged`: the largest number of readings
    in an average.
    """

    source = AngleSource.MEASURED

    def __init__(
        self,
        chip: Accelerometer,
        clock: Callable[[], float],
        *,
        mounting: Mounting | None = None,
        averaged: int = 4,
    ) -> None:
        self._chip = chip
        self._clock = clock
        self._mounting = mounting or Mounting()
        self._taken: deque[tuple[float, float, float]] = deque(maxlen=averaged)
        """For each reading: its moment in seconds, then gravity along the boom and across it in g."""

    def read(self) -> float:
        """Elevation in degrees, -90 to 270, so that a boom which goes over the top reaches 180 without a jump.

        Raises HardwareError when the chip does not answer, is another chip, or has been shaken for too long.
        """
        board_g = self._chip.gravity_g()
        now_s = self._clock()
        while self._taken and now_s - self._taken[0][0] > AVERAGED_OVER_S:
            self._taken.popleft()
        force_g = math.hypot(*board_g)
        if abs(force_g - 1.0) <= SHAKEN_G:
            self._taken.append((now_s, *self._in_plane(board_g)))
        else:
            self._chip.restart()  # perhaps its supply dipped: the chip then sleeps and reads 0 g
            if not self._taken:
                raise HardwareError(
                    f"{self._chip.name}: it feels {force_g:.2f} g where gravity is 1 g; wait until the antenna stands "
                    "still, and fix the board to the boom where it shakes least"
                )
        forward, up = (math.fsum(taken[part] for taken in self._taken) for part in (1, 2))
        return (math.degrees(math.atan2(forward, up)) + 90.0) % 360.0 - 90.0

    def _in_plane(self, board_g: BoardAxes) -> tuple[float, float]:
        plane_g = self._mounting.upright(board_g)
        if math.hypot(*plane_g) < LEAST_IN_PLANE_G:
            raise HardwareError(
                f"{self._chip.name}: the board lies on its side; check which arrows point forward and up"
            )
        return plane_g
