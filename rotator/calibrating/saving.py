"""Writes the result of a calibration into the configuration file, or shows it as text.

Knows which result is which key. The file itself is changed by `config.save`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from hw.ports import Axis
from rotator.calibrating.results import AxisCalibrated, NorthFound, Saved
from rotator.config.save import changed, save_axis


def save(result: Saved, path: Path) -> None:
    """Write into the file, whole or not at all. Raises OSError or ConfigError."""
    keys = _keys(result)
    save_axis(path, keys.axis, calibration=keys.points, **keys.values)


def as_toml(result: Saved) -> str:
    """The same keys as text, for an operator who gave no file."""
    keys = _keys(result)
    return changed("", keys.axis, calibration=keys.points, **keys.values)


@dataclass(frozen=True, slots=True)
class _Keys:
    axis: str
    points: tuple[tuple[float, float], ...] | None
    values: dict[str, float | bool]


def _keys(result: Saved) -> _Keys:
    match result:
        case AxisCalibrated(axis, points, min_deg, max_deg):
            limits: dict[str, float | bool] = {"min_deg": min_deg, "max_deg": max_deg, "direction_checked": True}
            return _Keys(axis.value, points, limits)
        case NorthFound(offset_deg):
            return _Keys(Axis.AZIMUTH.value, None, {"offset_deg": offset_deg})
