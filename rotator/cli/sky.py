"""`rotator sky where`, `passes` and `plan`: what the box knows of the sky, for a person or as JSON.

Knows the words and the columns. The sky itself is in `rotator.orbits`.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table
from rich.text import Text

from rotator.assembly.sky import build_catalogue, build_site
from rotator.cli import sky_plan
from rotator.cli.commands import HERE
from rotator.cli.failed import CommandFailed
from rotator.cli.utc import day_and_time, iso, local_time
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.places import INSTALLED
from rotator.config.sky import no_place
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.passes import Pass
from rotator.orbits.passes import passes as passes_of
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Target, beyond_beam, expected_error_deg, motion
from rotator.orbits.targets import find
from rotator.tracking.system_clock import ASSUMED_ERROR_S, SystemClock

UNSET = f"This computer's clock has reached no time server: {ASSUMED_ERROR_S:g} s of error are counted for it."
NO_PASS = "no pass in this time"
HEADINGS = "rises (UTC)", "here", "for", "from", "highest", "to", "error"
SPARED = "here", "to"
"""Columns that a narrow terminal does not show."""
SHORTEST_NAME, GAP = 8, 2


def show_where(path: Path | None, words: Sequence[str], at_s: float | None, *, as_json: bool) -> None:
    config, site, catalogue = read_sky(path)
    at_s = time.time() if at_s is None else at_s
    try:
        target = find(" ".join(words), site, catalogue)
        seen, error_deg = motion(target, at_s), expected_error_deg(target, at_s, clock_error_s(config))
    except (Unknown, NotThere) as reason:
        raise CommandFailed(str(reason)) from None
    if as_json:
        fields = {
            "name": target.name,
            "at": iso(at_s),
            "az_deg": round(seen.sight.azimuth_deg, 4),
            "el_deg": round(seen.sight.elevation_deg, 4),
            "az_dps": round(seen.azimuth_dps, 5),
            "el_dps": round(seen.elevation_dps, 5),
            "range_km": None if math.isinf(seen.sight.range_km) else round(seen.sight.range_km, 3),
            "expected_error_deg": round(error_deg, 4),
        }
        click.echo(json.dumps(fields))
        return
    sight = seen.sight
    far = "" if math.isinf(sight.range_km) else f", {sight.range_km:,.0f} km away"
    under = "" if sight.elevation_deg >= 0 else " (below the horizon)"
    click.echo(f"{target.name} at {day_and_time(at_s)} UTC ({local_time(at_s)} here)")
    click.echo(f"  azimuth {sight.azimuth_deg:.2f}°, elevation {sight.elevation_deg:.2f}°{under}{far}")
    click.echo(f"  moves {seen.azimuth_dps:+.3f}°/s in azimuth, {seen.elevation_dps:+.3f}°/s in elevation")
    if error_deg >= 0.005:
        click.echo(f"  expect an error of up to {error_deg:.2f}°{beyond_beam(error_deg, config.station.beam_deg)}")


def show_passes(
    path: Path | None, names: tuple[str, ...], from_s: float | None, hours: float, least_deg: float, *, as_json: bool
) -> None:
    config, site, catalogue = read_sky(path)
    from_s = time.time() if from_s is None else from_s
    try:
        if not (names or catalogue.satellites):
            raise Unknown(catalogue.none_known)
        targets = [find(name, site, catalogue) for name in names] or satellites(site, catalogue)
    except (Unknown, NotThere) as reason:
        raise CommandFailed(str(reason)) from None
    found = [
        (target, each) for target in targets for each in passes_of(target, from_s, from_s + hours * 3600, least_deg)
    ]
    found.sort(key=lambda pair: pair[1].aos_s or from_s)
    clock_s = clock_error_s(config)
    errors_deg = [_error_deg(target, each, clock_s) for target, each in found]
    if as_json:
        plan = sky_plan.planned(config, sky_plan.followed_by(config, site, catalogue), from_s, hours)
        # A long pass may be flown in parts: the row is that of the first one.
        parts = {(each.name, each.found.tca_s): each for each in reversed(plan)}
        rows = []
        for (_, each), error_deg in zip(found, errors_deg, strict=True):
            how = parts.get((each.name, each.tca_s))
            error = {"expected_error_deg": round(error_deg, 2)}
            rows.append({**_as_dict(each), **error, "plan": how and sky_plan.as_dict(how)})
        click.echo(json.dumps(rows))
        return
    if not found:
        click.echo(NO_PASS)
        return
    _table([each for _, each in found], errors_deg)
    _warn(((each.name, error_deg) for (_, each), error_deg in zip(found, errors_deg, strict=True)), config)


def show_plan(path: Path | None, from_s: float | None, hours: float, *, as_json: bool) -> None:
    config, site, catalogue = read_sky(path)
    if not config.sky.follow:
        raise CommandFailed(sky_plan.NOTHING)
    followed = sky_plan.followed_by(config, site, catalogue)
    if not followed:
        raise CommandFailed("none of the followed targets is known")
    from_s = time.time() if from_s is None else from_s
    plan = sky_plan.planned(config, followed, from_s, hours)
    targets, clock_s = {each.target.name: each.target for each in followed}, clock_error_s(config)
    errors_deg = [_error_deg(targets[each.name], each.found, clock_s) for each in plan]
    if as_json:
        rows = [
            {**_as_dict(each.found), "expected_error_deg": round(error_deg, 2), **sky_plan.as_dict(each)}
            for each, error_deg in zip(plan, errors_deg, strict=True)
        ]
        click.echo(json.dumps(rows))
        return
    sky_plan.show(plan, errors_deg, from_s)
    _warn(((each.name, error_deg) for each, error_deg in zip(plan, errors_deg, strict=True)), config)
    for line in sky_plan.changed(config):
        click.echo(line)


def read_sky(path: Path | None) -> tuple[Config, Site, Catalogue]:
    """Raises CommandFailed without a place. Says which files could not be read."""
    file = path or next((each for each in (INSTALLED, Path(HERE)) if each.exists()), None)
    config = load(file)
    site = build_site(config.station)
    if site is None:
        raise CommandFailed(no_place(file))
    catalogue = build_catalogue(config)
    for fault in catalogue.faults:
        click.echo(f"[sky] elements: {fault}", err=True)
    return config, site, catalogue


def satellites(site: Site, catalogue: Catalogue) -> list[Satellite]:
    """Every satellite whose elements sgp4 takes. Says which are left out."""
    found = []
    for elements in catalogue.satellites:
        try:
            found.append(Satellite(elements, site))
        except NotThere as reason:
            click.echo(str(reason), err=True)
    return found


def clock_error_s(config: Config) -> float:
    """How far this computer's clock may be off. Of a simulated rotor an unset clock is right, too."""
    clock = SystemClock()
    clock.look(0.0)
    if clock.is_set:
        return clock.error_s
    if config.simulated:
        return 0.0
    click.echo(UNSET, err=True)
    return ASSUMED_ERROR_S


def _warn(errors: Iterable[tuple[str, float]], config: Config) -> None:
    """Once for each target of which a pass may be outside the beam."""
    worst_deg: dict[str, float] = {}
    for name, error_deg in errors:
        worst_deg[name] = max(error_deg, worst_deg.get(name, 0.0))
    for name, error_deg in worst_deg.items():
        if warning := beyond_beam(error_deg, config.station.beam_deg):
            click.echo(f"{name}: expect an error of up to {error_deg:.0f}°{warning}")


def _error_deg(target: Target, each: Pass, clock_s: float) -> float:
    """The largest that is to be expected in the pass, from the age of the elements and from the clock."""
    moments_s = [moment_s for moment_s in (each.aos_s, each.tca_s, each.los_s) if moment_s is not None]
    try:
        return max(expected_error_deg(target, moment_s, clock_s) for moment_s in moments_s)
    except NotThere:
        return 0.0


def _as_dict(each: Pass) -> dict[str, object]:
    return {
        "name": each.name,
        "aos": None if each.aos_s is None else iso(each.aos_s),
        "los": None if each.los_s is None else iso(each.los_s),
        "tca": iso(each.tca_s),
        "aos_az_deg": None if each.aos is None else round(each.aos.azimuth_deg, 2),
        "los_az_deg": None if each.los is None else round(each.los.azimuth_deg, 2),
        "max_el_deg": round(each.highest.elevation_deg, 2),
    }


def _table(found: Sequence[Pass], errors_deg: Sequence[float]) -> None:
    """Names of satellites are shortened where the terminal is narrow, times and angles never."""
    console, table = Console(highlight=False), Table(box=None, pad_edge=False)
    rows = [_row(each, error_deg) for each, error_deg in zip(found, errors_deg, strict=True)]
    left_out = SPARED if console.width < sky_plan.NARROW else ()
    shown = [column for column, heading in enumerate(HEADINGS) if heading not in left_out]
    widths = {column: max(len(row[column]) for row in (HEADINGS, *rows)) for column in shown}
    left = console.width - sum(width + GAP for width in widths.values())
    table.add_column("name", overflow="ellipsis", no_wrap=True, max_width=max(SHORTEST_NAME, left))
    for column in shown:
        table.add_column(HEADINGS[column], justify="right", no_wrap=True)
    for each, row in zip(found, rows, strict=True):
        # A name may come from the network, and rich takes what stands in square brackets for a style.
        table.add_row(Text(each.name), *(row[column] for column in shown))
    console.print(table)


def _row(each: Pass, error_deg: float) -> tuple[str, ...]:
    return (
        "is up" if each.aos_s is None else day_and_time(each.aos_s),
        "" if each.aos_s is None else local_time(each.aos_s),
        "" if each.aos_s is None or each.los_s is None else f"{(each.los_s - each.aos_s) / 60:.0f} min",
        "" if each.aos is None else f"{each.aos.azimuth_deg:.0f}°",
        f"{each.highest.elevation_deg:.0f}°",
        "stays" if each.los is None else f"{each.los.azimuth_deg:.0f}°",
        sky_plan.error_words(error_deg),
    )
