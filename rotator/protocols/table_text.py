"""A timed table of directions as text: CSV with the columns `t,az,el`, in seconds and degrees, rows at any interval.

Knows the form, what people write instead, and the ways to write a moment. A row that may mean something else is
refused, never guessed; the error names its line. Knows neither files nor the rotor.
"""

from __future__ import annotations

import csv
import re
from datetime import UTC, datetime

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.known_path import Row
from rotator.control.sky.named_turns import names_turns
from rotator.control.sky.timed_table import TimedTable

COLUMNS = ("t", "az", "el")
FORM = "The first line is t,az,el; each further line has seconds, azimuth, elevation, like 12.5,274.6,8.1"
LONGEST_S = 86_400.0
LEAST_S = 0.001
"""Seconds. Rows nearer in time ask for a speed that no antenna has, and two rows at one moment for none at all."""
FARTHEST_DEG = 45.0
"""Between rows further apart on the sky the curve is a guess: over the zenith, or a jump from side to side."""
SINCE_1970_S = 1e9
"""A larger t counts from 1970."""
FARTHEST_AZIMUTH_DEG = 720
_NUMBER = re.compile(r"[-+]?(?:[0-9]++(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")
_COMMA = re.compile(r"[-+]?[0-9]+,[0-9]+")
_UTC = re.compile(r"[0-9]{4}-?[0-9]{2}-?[0-9]{2}[T ][0-9:.]+(?:Z|[-+][0-9:]+)?", re.IGNORECASE)


class TableError(ValueError):
    """The text holds no table. It says where, with the line, and why."""


def no_text(place: str) -> str:
    """The sentence about a file whose bytes are no text."""
    return f"{place}: is no text file (UTF-8). {FORM}"


def read_table(text: str, name: str, place: str, *, turns: bool = False) -> TimedTable:
    """`place`: where the text stands, for the error. `turns`: azimuth may be above 360 and elevation above 90; then the
    table names its turns, and all of its angles stay as they stand. Raises TableError.
    """
    lines = text.splitlines()
    if not lines:
        raise TableError(f"{place}: is empty. {FORM}")
    header = [column.strip().lower() for column in lines[0].split(",")]
    if not set(COLUMNS) <= set(header):
        raise TableError(f"{place}: the first line must name the columns t,az,el{_separator(lines[0])}. {FORM}")
    try:
        table = list(enumerate(csv.reader(lines[1:], strict=True), 2))
    except csv.Error as fault:
        raise TableError(f"{place}: cannot be read: {fault}. {FORM}") from fault
    rows: list[Row] = []
    numbers: list[int] = []
    before, in_utc = "", False
    for number, values in table:
        if not "".join(values).strip():
            continue
        row = _row(f"{place}:{number}", header, values, turns=turns)
        moment = values[header.index("t")].strip()
        # A computer without the right time writes a moment in 1970: that is no number of seconds from now.
        utc = row[0] >= SINCE_1970_S or _UTC.fullmatch(moment) is not None
        if rows and utc is not in_utc:
            raise TableError(
                f"{place}:{number}: t is {moment}, and {before} in the row before: write each t in seconds, or each in "
                "UTC"
            )
        if rows and row[0] <= rows[-1][0]:
            raise TableError(f"{place}:{number}: t must rise from row to row: {moment} comes after {before}")
        if rows and row[0] - rows[-1][0] < LEAST_S:
            raise TableError(
                f"{place}:{number}: is less than {LEAST_S:g} s after the row before: leave one of them out"
            )
        if rows and (turn_deg := great_circle_deg(*rows[-1][1:], *row[1:])) > FARTHEST_DEG:
            raise TableError(
                f"{place}:{number}: is {turn_deg:.0f}° on the sky from the row before, and which way between them is "
                f"not told: write rows nearer to each other, {FARTHEST_DEG:g}° at most"
            )
        rows.append(row)
        numbers.append(number)
        before, in_utc = moment, utc
    if len(rows) < 2:
        raise TableError(f"{place}: a pass needs two rows or more. {FORM}")
    lasts_s = rows[-1][0] - rows[0][0]
    if lasts_s > LONGEST_S:
        raise TableError(f"{place}: lasts {lasts_s / 3600:.0f} h; t is in seconds, and a day is the most")
    if not names_turns(rows):
        rows = [(t_s, azimuth_deg % 360.0, elevation_deg) for t_s, azimuth_deg, elevation_deg in rows]
    return TimedTable(name, tuple(rows), tuple(numbers), utc=in_utc)


def _separator(line: str) -> str:
    """What stands between the columns instead of a comma, where that is seen."""
    found = next((name for mark, name in ((";", "a semicolon"), ("\t", "a tab")) if mark in line), "")
    return f" with commas between; {found} stands there" if found else ""


def _row(place: str, header: list[str], values: list[str], *, turns: bool) -> Row:
    if len(values) != len(header):
        has = (
            f"{place}: has {len(values)} value{'s' if len(values) > 1 else ''}, and the first line names {len(header)}"
        )
        raise TableError(f"{has}: commas stand between values, and decimals have a point: 12.5,274.6,8.1")
    named = {column: value.strip() for column, value in zip(header, values, strict=True)}
    t_s = _utc_s(place, named["t"]) if _UTC.fullmatch(named["t"]) else _number(place, "t", named["t"])
    azimuth_deg, elevation_deg = (_number(place, column, named[column]) for column in COLUMNS[1:])
    most_az_deg, most_el_deg = (FARTHEST_AZIMUTH_DEG, 180) if turns else (360, 90)
    if not (-360 <= azimuth_deg <= most_az_deg and -90 <= elevation_deg <= most_el_deg):
        raise TableError(f"{place}: azimuth {azimuth_deg:g}, elevation {elevation_deg:g} is no direction")
    return t_s, azimuth_deg, elevation_deg


def _utc_s(place: str, text: str) -> float:
    try:
        moment = datetime.fromisoformat(text.upper())
    except ValueError:
        raise TableError(f"{place}: t is {text}: no such moment; write it as 2026-11-22T18:30:00Z") from None
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()


def _number(place: str, column: str, text: str) -> float:
    if _NUMBER.fullmatch(text):
        return float(text)
    if _COMMA.fullmatch(text):
        raise TableError(f"{place}: {column} is {text}: write it with a point, {text.replace(',', '.')}")
    raise TableError(f"{place}: {column} is {text[:20]!r}: t, az and el must be numbers")
