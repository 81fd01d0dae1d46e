"""The calibration table of one axis of a drive: from an angle to the number for the device, and back.

Knows the table's range, and refuses an angle outside it. Does not know whether the number is a pulse width in
microseconds or the step of a wiper.
"""

from __future__ import annotations

from collections.abc import Sequence

from hw.interpolation import PiecewiseLinear
from hw.ports import HardwareError

_ROUNDING_DEG = 1e-6


class CommandScale:
    """`points` are pairs of an angle in degrees and the device's number there, in any order; straight lines between.

    `name` opens each error. Raises HardwareError for fewer than two points, an angle given twice, or numbers that
    do not all rise or all fall.
    """

    def __init__(self, name: str, points: Sequence[tuple[float, float]]) -> None:
        self._name = name
        try:
            self._line = PiecewiseLinear(tuple(sorted(points)), "angles", "the device's numbers")
        except ValueError as fault:
            raise HardwareError(f"{name}: the calibration table: {fault}") from fault

    @property
    def low_deg(self) -> float:
        """The smallest angle of the table."""
        return self._line.points[0][0]

    @property
    def high_deg(self) -> float:
        """The largest angle of the table."""
        return self._line.points[-1][0]

    @property
    def values(self) -> tuple[float, float]:
        """The smallest and the largest number of the table."""
        ends = self._line.points[0][1], self._line.points[-1][1]
        return min(ends), max(ends)

    def check(self, angle_deg: float) -> None:
        """Raises HardwareError outside the table: the rotor was not calibrated there, and may meet its stop."""
        if not self.low_deg - _ROUNDING_DEG <= angle_deg <= self.high_deg + _ROUNDING_DEG:
            raise HardwareError(
                f"{self._name}: {angle_deg:.1f}° is outside its calibration table, "
                f"{self.low_deg:g}° to {self.high_deg:g}°: set the axis's limits within it"
            )

    def nearest_deg(self, angle_deg: float) -> float:
        """The nearest angle inside the table."""
        return min(max(angle_deg, self.low_deg), self.high_deg)

    def value(self, angle_deg: float) -> float:
        """The device's number for this angle. Raises HardwareError outside the table."""
        self.check(angle_deg)
        return self._line.at(angle_deg, clamp=True)

    def angle_deg(self, value: float) -> float:
        """The angle for this number; beyond the table the last line goes on."""
        return self._line.inverse(value)
