"""Writes the result of a calibration into the configuration file, or shows it as text.

Knows which result is which key. The file itself is changed by `config.save`.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.calibrating.results import AxisCalibrated, MountFound, NorthFound, Saved
from rotator.config.save import changed, save_table


def save(result: Saved, path: Path) -> None:
    """Write into the file, whole or not at all. Raises OSError or ConfigError."""
    table, keys = _keys(result)
    save_table(path, table, **keys)


def saved_in(path: Path) -> str:
    """The sentence for the operator after `save`."""
    return f"Saved in {path}; the file before is {path.name}.bak."


def as_toml(result: Saved) -> str:
    """The same keys as text, for an operator who gave no file."""
    table, keys = _keys(result)
    return changed("", table, **keys)


def _keys(result: Saved) -> tuple[str, dict[str, Any]]:
    """The table, and what becomes of its keys."""
    match result:
        case AxisCalibrated(axis, points, min_deg, max_deg):
            limits = {"min_deg": min_deg, "max_deg": max_deg, "direction_checked": True}
            return axis.value, {"calibration": points, **limits}
        case NorthFound(offset_deg):
            return Axis.AZIMUTH.value, {"offset_deg": offset_deg}
        case MountFound(model, points):
            return "mount.model", {**asdict(model), "points": [[round(part, 3) for part in row] for row in points]}
