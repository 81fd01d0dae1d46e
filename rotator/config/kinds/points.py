"""A table of points from the angle to the value of a drive without feedback: its ends are the reach of the rotor.

Knows angles and the words of the faults. Knows no drive.
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
    """The limits that the points `key.AXIS.name` do not reach, and the starts outside of the limits."""
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
