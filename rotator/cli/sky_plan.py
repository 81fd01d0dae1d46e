"""The plan of the followed passes, for a person as a table and for programs as JSON.

Knows the words, the columns and the fields. What is flown is decided in `rotator.tracking`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

import click
from rich.console import Console
from rich.table import Table

from rotator.assembly.sky import build_antenna, build_followed
from rotator.cli.failed import CommandFailed
from rotator.cli.utc import clock_time, day, iso, local_time
from rotator.config.model import Config
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.tracking.planned import PlannedPass
from rotator.tracking.schedule import schedule

NOTHING = (
    "the configuration follows nothing: write [[sky.follow]] into the file and below it, for example, "
    'name = "ISS"; one such table for each target'
)


def planned(config: Config, site: Site, catalogue: Catalogue, from_s: float, hours: float) -> tuple[PlannedPass, ...]:
    """The antenna begins at its park position. Says which targets are not known."""
    followed, faults = build_followed(config.sky, site, catalogue)
    for fault in faults:
        click.echo(fault, err=True)
    if faults and not followed:
        raise CommandFailed("none of the followed targets is known")
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


def show(plan: Sequence[PlannedPass], from_s: float) -> None:
    if not plan:
        click.echo("no pass in this time")
        return
    table = Table(box=None, pad_edge=False)
    table.add_column("UTC", no_wrap=True)
    table.add_column("here", no_wrap=True)
    for heading in ("for", "top"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("name", overflow="ellipsis", no_wrap=True, max_width=12)
    table.add_column("plan")
    for date, passes in groupby(plan, key=lambda each: day(_rises_s(each, from_s))):
        table.add_row(f"[bold]{date}")
        for each in passes:
            table.add_row(*_row(each), style="" if each.flight else "dim")
    Console(highlight=False).print(table)


def _row(each: PlannedPass) -> tuple[str, ...]:
    found = each.found
    return (
        "is up" if found.aos_s is None else clock_time(found.aos_s),
        "" if found.aos_s is None else local_time(found.aos_s),
        "" if found.aos_s is None or found.los_s is None else f"{(found.los_s - found.aos_s) / 60:.0f} min",
        f"{found.highest.elevation_deg:.0f}°",
        each.name,
        _words(each),
    )


def _words(each: PlannedPass) -> str:
    flight = each.flight
    if flight is None:
        return f"– {each.reason}"
    words = [f"sets off {clock_time(flight.set_off_s)}, waits at {flight.wait_deg[0]:.0f}°"]
    if flight.over_the_top:
        words.append("over the top")
    if flight.lost_s >= 1:
        words.append(f"loses {flight.lost_s:.0f} s")
    return ", ".join(words) + (f"; {each.reason}" if each.reason else "")


def _rises_s(each: PlannedPass, from_s: float) -> float:
    return from_s if each.found.aos_s is None else each.found.aos_s
