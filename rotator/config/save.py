"""Writes a calibration back into the user's file: its comments stay, a copy is kept, and it is whole at any moment.

Knows how to change a file safely. Knows nothing of where the points come from.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import tomlkit

from rotator.config.load import parse


def save_calibration(path: Path, axis: str, points: tuple[tuple[float, float], ...]) -> None:
    """Replace `[axis] calibration` in the file. Raises OSError or ConfigError; then the file is as it was."""
    document = tomlkit.parse(path.read_text(encoding="utf-8"))
    table = document.setdefault(axis, tomlkit.table())
    rows = tomlkit.array()
    for reading, angle_deg in points:
        rows.append([round(reading, 5), round(angle_deg, 3)])
    table["calibration"] = rows
    text = tomlkit.dumps(document)
    parse(text, str(path))
    shutil.copy2(path, path.with_name(path.name + ".bak"))
    new = path.with_name(path.name + ".new")
    with new.open("w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    shutil.copymode(path, new)
    new.replace(path)
