"""The points [degrees, value] of a drive without feedback: the reach that they give, and the faults against it.

Knows angles and the texts of the faults. Knows no drive: a value is a pulse width or a step of a chip.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from hw.ports import Axis
from rotator.config.axes import AxisTable


class StartsSomewhere(Protocol):
    @property
    def start_deg(self) -> float: ...


def reach_deg(points: list[tuple[float, float]]) -> tuple[float, float]:
    """The lowest and the highest angle of the points [degrees, value]."""
    angles_deg = [angle_deg for angle_deg, _ in points]
    return min(angles_deg), max(angles_deg)


def out_of_reach(
    axes: Mapping[Axis, AxisTable],
    key: str,
    name: str,
    points: Mapping[Axis, list[tuple[float, float]]],
    starts: Mapping[Axis, StartsSomewhere],
) -> list[str]:
    """Faults: an axis with limits beyond its points `key.AXIS.name`, or with a start angle outside its limits."""
    faults: list[str] = []
    for axis, limits in axes.items():
        start_deg = starts[axis].start_deg
        if not limits.min_deg <= start_deg <= limits.max_deg:
            faults.append(
                f"{key}.{axis.value}.start_deg = {start_deg:g} is outside {axis.value}'s range, "
                f"{limits.min_deg:g} to {limits.max_deg:g}"
            )
        low_deg, high_deg = reach_deg(points[axis])
        if not low_deg <= limits.min_deg < limits.max_deg <= high_deg:
            faults.append(
                f"{axis.value}: min_deg {limits.min_deg:g} to max_deg {limits.max_deg:g} goes beyond "
                f"{key}.{axis.value}.{name}, which reaches from {low_deg:g} to {high_deg:g}"
            )
    return faults
