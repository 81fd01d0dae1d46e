"""A satellite pass to fly: from a CSV file with the columns `t,az,el`, or the next one of a target over the station.

Knows the passes that come with the program, how to interpolate between rows, and the configuration's elements. A table
with an azimuth above 360 or an elevation above 90 names its turns, as a program does that plans by itself. Does not
know the rotor.
"""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass
from pathlib import Path

from rotator.assembly.sky import build_catalogue, build_site
from rotator.assembly.tracking import TrackedBox
from rotator.config.model import Config
from rotator.config.sky import NO_PLACE
from rotator.control.sky.known_path import Row, direction_at, rows_around
from rotator.control.sky.mount import Mount
from rotator.control.sky.named_turns import names_turns, on_the_sky
from rotator.control.sky.timed_table import TimedTable
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import find
from rotator.protocols.table_text import TableError, no_text, read_table
from rotator.rehearsal.overhearing import PlansAtOnce
from rotator.runtime.loop import ControlLoop
from rotator.store.plain import NoPlainFileError, read_plain
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.next_flight import AHEAD_S, does_not_rise, target_path
from rotator.tracking.tracker import Tracker

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


LONGEST_S = 7200.0
"""Sun and Moon are up for half a day, which takes minutes to fly and shows nothing more."""


@dataclass(frozen=True, slots=True)
class SkyTarget:
    """`begin_utc_s`: when its pass begins."""

    words: str
    begin_utc_s: float
    config: Config
    site: Site
    catalogue: Catalogue

    def tracker(self, loop: ControlLoop, mount: Mount) -> Tracker:
        """The tracker of a box in simulated time."""
        sky = KnownSky(self.site, self.catalogue)
        return Tracker(sky, PlansAtOnce(), TrackedBox(self.config, loop, mount), lambda: True)


def next_pass(config: Config, words: str, after_utc_s: float) -> tuple[Pass, SkyTarget]:
    """The target's first pass that ends after that moment, from where it rises. Raises PassError."""
    site, catalogue = build_site(config.station), build_catalogue(config)
    if site is None:
        raise PassError(NO_PLACE)
    try:
        target = find(words, site, catalogue)
        found = next(passes(target, after_utc_s, after_utc_s + AHEAD_S), None)
    except (Unknown, NotThere) as reason:
        raise PassError(str(reason)) from None
    if found is None:
        raise PassError(does_not_rise(target))
    if found.aos_s is None or found.los_s is None or not math.isfinite(found.los_s - found.aos_s):
        raise PassError(f"{target.name} does not rise and set: there is no pass to fly")
    until_s, name = found.los_s, target.name
    if until_s - found.aos_s > LONGEST_S:
        until_s, name = found.aos_s + LONGEST_S, f"{name} (its first {LONGEST_S / 3600:.0f} hours)"
    rows = target_path(target, found.aos_s, until_s, apart_s=found.aos_s).rows
    return Pass(name, rows), SkyTarget(words, found.aos_s, config, site, catalogue)
