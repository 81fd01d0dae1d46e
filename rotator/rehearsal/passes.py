"""A satellite pass from a CSV file with the columns `t,az,el`, in seconds and degrees; rows at any interval.

Knows the passes that come with the program, and how to interpolate between rows. A table with an azimuth above 360 or
an elevation above 90 names its turns, as a program does that plans by itself. Does not know the rotor.
"""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from pathlib import Path

from rotator.control.sky.known_path import Row, direction_at, rows_around
from rotator.control.sky.named_turns import names_turns, on_the_sky
from rotator.control.sky.timed_table import TimedTable
from rotator.protocols.table_text import TableError, no_text, read_table
from rotator.store.plain import NoPlainFileError, read_plain

SHIPPED = Path(__file__).parent / "shipped"
"""Twelve passes of real satellites over 48.85° N, 2.35° E, from AOS to LOS, a row a second."""
MOST_BYTES = 20_000_000


class PassError(Exception):
    """The file does not hold a pass. The text has the file, the line and the reason."""


@dataclass(frozen=True, slots=True)
class Pass:
    """Two or more rows (t_s, azimuth_deg, elevation_deg). The first time is 0, and times rise."""

    name: str
    rows: tuple[Row, ...]
    lines: tuple[int, ...] = ()
    """The line of each row in its file."""
    turns: bool = False
    """Whether the rows name the turns: their angles are then those of the rotor's axes."""

    @property
    def table(self) -> TimedTable:
        return TimedTable(self.name, self.rows, self.lines)

    @property
    def highest_deg(self) -> float:
        """The elevation at its culmination."""
        return max(self.at(t_s)[1] for t_s, _, _ in self.rows)

    @property
    def end_s(self) -> float:
        return self.rows[-1][0]

    def at(self, t_s: float) -> tuple[float, float]:
        """The direction on the sky, azimuth 0 to 360, elevation to 90. Between rows azimuth takes the shorter way."""
        azimuth_deg, elevation_deg = self.sent_at(t_s)
        if self.turns:
            _, azimuth_deg, elevation_deg = on_the_sky((t_s, azimuth_deg, elevation_deg))
        return azimuth_deg, elevation_deg

    def sent_at(self, t_s: float) -> tuple[float, float]:
        """The same as a program sends it: where the rows name the turns, their angles as they stand."""
        if not self.turns:
            return direction_at(self.rows, t_s)
        (_, az_a, el_a), (_, az_b, el_b), share = rows_around(self.rows, t_s)
        return az_a + share * (az_b - az_a), el_a + share * (el_b - el_a)


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
    try:
        table = read_table(_text(path), path.stem, str(path), turns=True)
    except TableError as fault:
        raise PassError(str(fault)) from None
    start_s = table.rows[0][0]
    rows = tuple((t - start_s, az, el) for t, az, el in table.rows)
    return Pass(path.stem, rows, table.lines, names_turns(rows))


def _text(path: Path) -> str:
    try:
        return read_plain(path, MOST_BYTES).decode("utf-8-sig")
    except NoPlainFileError as none:
        raise PassError(f"{path}: {none.strerror}") from none
    except OSError as fault:
        raise PassError(f"{path}: cannot be read: {fault.strerror}") from fault
    except UnicodeDecodeError as fault:
        raise PassError(no_text(str(path))) from fault
