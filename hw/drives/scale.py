"""A calibration table between an axis's angle and what a device is told: a pulse width, a wiper step.

Knows straight lines between points. Does not know the device; it says its own ends and refuses what lies beyond them.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Sequence
from itertools import pairwise

from hw.ports import HardwareError

_ROUNDING_DEG = 1e-6


class Scale:
    """`points` are pairs of an angle in degrees and the device's value there; between them the line is straight.

    At least two, with rising angles; the values all rise or all fall. Raises HardwareError. `name` opens the errors.
    """

    def __init__(self, name: str, points: Sequence[tuple[float, float]]) -> None:
        ordered = sorted(points)
        steps = [(after[0] - before[0], after[1] - before[1]) for before, after in pairwise(ordered)]
        if not steps:
            raise HardwareError(f"{name}: the calibration table needs at least two points")
        if any(angle <= 0 for angle, _ in steps) or len({value > 0 for _, value in steps}) > 1:
            raise HardwareError(f"{name}: the calibration table turns back: give every angle once, values in order")
        if any(value == 0 for _, value in steps):
            raise HardwareError(f"{name}: the calibration table gives two angles the same value")
        self._name = name
        self._angles_deg = [angle for angle, _ in ordered]
        self._values = [value for _, value in ordered]

    @property
    def low_deg(self) -> float:
        return self._angles_deg[0]

    @property
    def high_deg(self) -> float:
        return self._angles_deg[-1]

    @property
    def values(self) -> tuple[float, float]:
        """The least and the greatest value in the table."""
        return min(self._values), max(self._values)

    def check(self, angle_deg: float) -> None:
        """Raises HardwareError where the table does not reach: what lies beyond its ends has never been tried."""
        if not self.low_deg - _ROUNDING_DEG <= angle_deg <= self.high_deg + _ROUNDING_DEG:
            raise HardwareError(
                f"{self._name}: {angle_deg:.1f}° is outside its calibration table, "
                f"{self.low_deg:g}° to {self.high_deg:g}°: set the axis's limits within it"
            )

    def within(self, angle_deg: float) -> float:
        """The nearest angle that the table reaches."""
        return min(max(angle_deg, self.low_deg), self.high_deg)

    def value(self, angle_deg: float) -> float:
        """What the device is told for this angle. Raises HardwareError outside the table."""
        self.check(angle_deg)
        return _on_line(angle_deg, self._angles_deg, self._values)

    def angle_deg(self, value: float) -> float:
        """The angle that this value means; beyond the table the last line goes on."""
        if self._values[0] < self._values[-1]:
            return _on_line(value, self._values, self._angles_deg)
        return _on_line(value, self._values[::-1], self._angles_deg[::-1])


def _on_line(at: float, rising: list[float], other: list[float]) -> float:
    left = min(max(bisect(rising, at) - 1, 0), len(rising) - 2)
    share = (at - rising[left]) / (rising[left + 1] - rising[left])
    return other[left] + share * (other[left + 1] - other[left])
