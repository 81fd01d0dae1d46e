"""A satellite pass from a CSV file with the columns `t,az,el`, in seconds and degrees; rows at any interval.

Knows the file's form, what people write instead, the passes that come with the program, and how to interpolate between
rows. A row that may mean something else is refused, never guessed. Does not know the rotor.
"""

from __future__ import annotations

import csv
import difflib
import re
from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path

from rotator.control.sky.angles import turn_deg

SHIPPED = Path(__file__).parent / "shipped"
"""Twelve passes of real satellites over 48.85° N, 2.35° E, from AOS to LOS, a row a second."""
COLUMNS = ("t", "az", "el")
FORM = "The first line is t,az,el; each further line has seconds, azimuth, elevation, like 12.5,274.6,8.1"
LONGEST_S = 86_400.0
MOST_BYTES = 20_000_000
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")
_COMMA = re.compile(r"[-+]?[0-9]+,[0-9]+")


class PassError(Exception):
    """The file does not hold a pass. The text has the file, the line and the reason."""


@dataclass(frozen=True, slots=True)
class Pass:
    """Two or more rows (t_s, azimuth_deg, elevation_deg). The first time is 0, and times rise."""

    name: str
    rows: tuple[tuple[float, float, float], ...]

    @property
    def highest_deg(self) -> float:
        """The elevation at its culmination."""
        return max(elevation_deg for _, _, elevation_deg in self.rows)

    @property
    def end_s(self) -> float:
        return self.rows[-1][0]

    def at(self, t_s: float) -> tuple[float, float]:
        """Azimuth (0 to 360) and elevation in degrees at this time. Between rows azimuth takes the shorter way."""
        after = min(max(bisect_right(self.rows, t_s, key=lambda row: row[0]), 1), len(self.rows) - 1)
        (t_a, az_a, el_a), (t_b, az_b, el_b) = self.rows[after - 1], self.rows[after]
        share = min(max((t_s - t_a) / (t_b - t_a), 0.0), 1.0)
        return (az_a + share * turn_deg(az_a, az_b)) % 360.0, el_a + share * (el_b - el_a)


def shipped_names() -> list[str]:
    return sorted(path.stem for path in SHIPPED.glob("*.csv"))


def find_pass(word: str) -> Pass:
    """The pass in the file `word`, else the shipped pass of that name. Raises PassError."""
    path = Path(word)
    names = shipped_names()
    if path.exists() or word not in names:
        if path.suffix or path.exists() or len(path.parts) > 1:
            return read_pass(path)
        close = difflib.get_close_matches(word, names, n=1, cutoff=0.5)
        meant = f"; did you mean {close[0]}?" if close else "."
        raise PassError(f"{word}: no such file, and no pass of that name{meant} There are: {', '.join(names)}")
    return read_pass(SHIPPED / f"{word}.csv")


def read_pass(path: Path) -> Pass:
    """The pass in a file, with its first time set to 0. Raises PassError."""
    lines = _text(path).splitlines()
    if not lines:
        raise PassError(f"{path}: is empty. {FORM}")
    header = [name.strip().lower() for name in lines[0].split(",")]
    if not set(COLUMNS) <= set(header):
        raise PassError(f"{path}: the first line must name the columns t,az,el{_separator(lines[0])}. {FORM}")
    try:
        table = list(enumerate(csv.reader(lines[1:], strict=True), 2))
    except csv.Error as fault:
        raise PassError(f"{path}: cannot be read: {fault}. {FORM}") from fault
    rows: list[tuple[float, float, float]] = []
    for number, values in table:
        if not "".join(values).strip():
            continue
        row = _row(f"{path}:{number}", header, values)
        if rows and row[0] <= rows[-1][0]:
            raise PassError(f"{path}:{number}: t must rise from row to row: {row[0]:g} comes after {rows[-1][0]:g}")
        rows.append(row)
    if len(rows) < 2:
        raise PassError(f"{path}: a pass needs two rows or more. {FORM}")
    start_s, end_s = rows[0][0], rows[-1][0]
    if end_s - start_s > LONGEST_S:
        raise PassError(f"{path}: lasts {(end_s - start_s) / 3600:.0f} h; t is in seconds, and a day is the most")
    return Pass(path.stem, tuple((t - start_s, az, el) for t, az, el in rows))


def _text(path: Path) -> str:
    try:
        if path.stat().st_size > MOST_BYTES:
            raise PassError(f"{path}: is too large for a pass: {path.stat().st_size / 1e6:.0f} MB")
        return path.read_text(encoding="utf-8-sig")
    except OSError as fault:
        raise PassError(f"{path}: cannot be read: {fault.strerror}") from fault
    except UnicodeDecodeError as fault:
        raise PassError(f"{path}: is no text file (UTF-8). {FORM}") from fault


def _separator(line: str) -> str:
    """What stands between the columns instead of a comma, where that is seen."""
    found = next((name for mark, name in ((";", "a semicolon"), ("\t", "a tab")) if mark in line), "")
    return f" with commas between; {found} stands there" if found else ""


def _row(place: str, header: list[str], values: list[str]) -> tuple[float, float, float]:
    if len(values) != len(header):
        has = (
            f"{place}: has {len(values)} value{'s' if len(values) > 1 else ''}, and the first line names {len(header)}"
        )
        raise PassError(f"{has}: commas stand between values, and decimals have a point: 12.5,274.6,8.1")
    named = dict(zip(header, values, strict=True))
    t_s, azimuth_deg, elevation_deg = (_number(place, column, named[column].strip()) for column in COLUMNS)
    if not (-360 <= azimuth_deg <= 360 and -90 <= elevation_deg <= 90):
        raise PassError(f"{place}: azimuth {azimuth_deg:g}, elevation {elevation_deg:g} is no direction")
    return t_s, azimuth_deg % 360.0, elevation_deg


def _number(place: str, column: str, text: str) -> float:
    if _NUMBER.fullmatch(text):
        return float(text)
    if _COMMA.fullmatch(text):
        raise PassError(f"{place}: {column} is {text}: write it with a point, {text.replace(',', '.')}")
    raise PassError(f"{place}: {column} is {text[:20]!r}: t, az and el must be numbers")
