"""A satellite pass from a CSV file with the columns `t,az,el`, in seconds and degrees; rows at any interval.

Knows the file's form, and how to interpolate between rows. Does not know the rotor.
"""

from __future__ import annotations

import csv
import math
from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from rotator.control.sky.angles import turn_deg


class PassError(Exception):
    """The file does not hold a pass. The text has the file, the line and the reason."""


@dataclass(frozen=True, slots=True)
class Pass:
    """Two or more rows (t_s, azimuth_deg, elevation_deg). The first time is 0, and times rise."""

    name: str
    rows: tuple[tuple[float, float, float], ...]

    @property
    def end_s(self) -> float:
        return self.rows[-1][0]

    def at(self, t_s: float) -> tuple[float, float]:
        """Azimuth (0 to 360) and elevation in degrees at this time. Between rows azimuth takes the shorter way."""
        after = min(max(bisect_right(self.rows, t_s, key=lambda row: row[0]), 1), len(self.rows) - 1)
        (t_a, az_a, el_a), (t_b, az_b, el_b) = self.rows[after - 1], self.rows[after]
        share = min(max((t_s - t_a) / (t_b - t_a), 0.0), 1.0)
        return (az_a + share * turn_deg(az_a, az_b)) % 360.0, el_a + share * (el_b - el_a)


def read_pass(path: Path) -> Pass:
    """The pass in a file, with its first time set to 0. Raises PassError."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file)
            if not {"t", "az", "el"} <= set(reader.fieldnames or ()):
                raise PassError(f"{path}: the first line must name the columns t,az,el")
            rows = [_row(path, reader.line_num, row) for row in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as fault:
        raise PassError(f"{path}: cannot be read: {fault}") from fault
    if len(rows) < 2:
        raise PassError(f"{path}: a pass needs two rows or more")
    if any(b[0] <= a[0] for a, b in pairwise(rows)):
        raise PassError(f"{path}: t must rise from row to row")
    start_s = rows[0][0]
    return Pass(path.stem, tuple((t - start_s, az, el) for t, az, el in rows))


def _row(path: Path, line: int, row: dict[str, str | None]) -> tuple[float, float, float]:
    try:
        t_s, azimuth_deg, elevation_deg = (float(row[key] or "") for key in ("t", "az", "el"))
    except ValueError:
        raise PassError(f"{path}:{line}: t, az and el must be numbers") from None
    if not all(map(math.isfinite, (t_s, azimuth_deg, elevation_deg))):
        raise PassError(f"{path}:{line}: t, az and el must be numbers")
    if not (-360 <= azimuth_deg <= 360 and -90 <= elevation_deg <= 90):
        raise PassError(f"{path}:{line}: azimuth {azimuth_deg:g}, elevation {elevation_deg:g} is no direction")
    return t_s, azimuth_deg % 360.0, elevation_deg
