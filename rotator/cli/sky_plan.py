"""The plan of the followed passes, for a person as a table and for programs as JSON.

Knows the words, the columns and the fields. What is flown is decided in `rotator.tracking`.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from itertools import groupby

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rotator.assembly.kept_files import build_state
from rotator.assembly.tracking import build_antenna, wanted_often
from rotator.cli.utc import clock_time, day, iso, local_time
from rotator.config.model import Config
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.store.priorities import Priorities
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.planned import Followed, PlannedPass
from rotator.tracking.schedule import schedule

NOTHING = (
    "the configuration follows nothing: write [[sky.follow]] into the file and below it, for example, "
    'name = "ISS"; one such table for each target'
)

NARROW = 64
"""A table needs this many columns."""
SHOWN_DEG = 0.05


def followed_by(config: Config, site: Site, catalogue: Catalogue) -> list[Followed]:
    """What `[[sky.follow]]` names. Says which targets are not known."""
    wanted, faults = wanted_often(config.sky, KnownSky(site, catalogue), Priorities(build_state(config)).of)
    for fault in faults:
        click.echo(fault, err=True)
    return [each.followed() for each in wanted]


def changed(config: Config) -> list[str]:
    """A line for each priority that a person has changed on the page."""
    priorities = Priorities(build_state(config))
    inforce = [(each, priorities.of(each.name, each.priority)) for each in config.sky.follow]
    return [
        f"{each.name}: priority {now:g}, changed on the page; the file says {each.priority:g}"
        for each, now in inforce
        if now != each.priority
    ]


def planned(config: Config, followed: Sequence[Followed], from_s: float, hours: float) -> tuple[PlannedPass, ...]:
    """The antenna begins at its park position."""
    return schedule(followed, build_antenna(config), from_s, from_s + hours * 3600)


def as_dict(each: PlannedPass) -> dict[str, object]:
    """What the plan adds to the fields of a pass; null in place of what a pass that is left out does not have."""
    flight = each.flight
    return {
        "set_off": iso(flight.set_off_s) if flight else None,
        "from": iso(flight.begin_s) if flight else None,
        "until": iso(flight.end_s) if flight else None,
        "wait_az_deg": round(flight.wait_deg[0], 2) if flight else None,
        "wait_el_deg": round(flight.wait_deg[1], 2) if flight else None,
        "over_the_top": flight.over_the_top if flight else None,
        "lost_s": round(flight.lost_s, 1) if flight else None,
        "flown": flight is not None,
        "reason": each.reason or None,
    }


def error_words(error_deg: float) -> str:
    """For a column; empty where it is too small to matter."""
    if error_deg < SHOWN_DEG:
        return ""
    return f"{error_deg:.1f}°" if error_deg < 9.95 else f"{error_deg:.0f}°"


def show(plan: Sequence[PlannedPass], errors_deg: Sequence[float], from_s: float) -> None:
    """In the order in which they are flown. `errors_deg`: to be expected in each pass."""
    if not plan:
        click.echo("no pass in this time")
        return
    console = Console(highlight=False)
    begins = sorted(
        ((_begin_s(each, from_s), each, error_deg) for each, error_deg in zip(plan, errors_deg, strict=True)),
        key=lambda row: row[0],
    )
    by_day = groupby(begins, key=lambda row: day(row[0]))
    if console.width < NARROW:
        for date, passes in by_day:
            click.echo(f"{date}, UTC")
            for begin_s, each, error_deg in passes:
                when, here, minutes, top, error, name, words = _row(each, begin_s, error_deg)
                click.echo(f"{when} ({here} here) {name}, {minutes}, {top}")
                words += error and f"; error up to {error}"
                click.echo(textwrap.fill(words, console.width, initial_indent="  ", subsequent_indent="  "))
        return
    table = Table(box=None, pad_edge=False)
    table.add_column("UTC", no_wrap=True)
    table.add_column("here", no_wrap=True)
    for heading in ("for", "top", "error"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("name", overflow="ellipsis", no_wrap=True, max_width=12)
    table.add_column("plan")
    for date, passes in by_day:
        table.add_row(f"[bold]{date}")
        for begin_s, each, error_deg in passes:
            # Names may come from the network, and rich takes what stands in square brackets for a style.
            cells = map(Text, _row(each, begin_s, error_deg))
            table.add_row(*cells, style="" if each.flight else "dim")
    console.print(table)


def _begin_s(each: PlannedPass, from_s: float) -> float:
    """Of what is flown, or of the whole pass."""
    if each.flight is not None:
        return each.flight.begin_s
    return from_s if each.found.aos_s is None else each.found.aos_s


def _row(each: PlannedPass, begin_s: float, error_deg: float) -> tuple[str, ...]:
    end_s = each.flight.end_s if each.flight else each.found.los_s
    return (
        clock_time(begin_s),
        local_time(begin_s),
        "" if end_s is None else f"{(end_s - begin_s) / 60:.0f} min",
        f"{each.found.highest.elevation_deg:.0f}°",
        error_words(error_deg),
        each.name,
        _words(each),
    )


def _words(each: PlannedPass) -> str:
    flight = each.flight
    if flight is None:
        return f"– {each.reason}"
    over = " over the top" if flight.over_the_top else ""
    words = f"sets off {clock_time(flight.set_off_s)} to {flight.wait_deg[0]:.0f}°{over}"
    if flight.lost_s >= 1:
        words += f", loses {flight.lost_s:.0f} s"
    return words + (f"; {each.reason}" if each.reason else "")
