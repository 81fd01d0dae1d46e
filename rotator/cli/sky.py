"""`rotator sky where`, `passes` and `plan`: what the box knows of the sky, for a person or as JSON.

Knows the words and the columns. The sky itself is in `rotator.orbits`.
"""

from __future__ import annotations

import json
import math
import time
from pathlib import Path

import click
from rich.console import Console
from rich.table import Table

from rotator.assembly.sky import build_catalogue, build_site
from rotator.cli import sky_plan
from rotator.cli.failed import CommandFailed
from rotator.cli.utc import day_and_time, iso, local_time
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.places import INSTALLED
from rotator.config.station import NO_PLACE
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.passes import Pass
from rotator.orbits.passes import passes as passes_of
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Target, expected_error_deg, motion
from rotator.orbits.targets import find

NO_PASS = "no pass in this time"


def show_where(path: Path | None, words: str, at_s: float | None, *, as_json: bool) -> None:
    config = load(path or (INSTALLED if INSTALLED.exists() else None))
    site, catalogue = _sky(config)
    at_s = time.time() if at_s is None else at_s
    try:
        target = find(words, site, catalogue)
        seen, error_deg = motion(target, at_s), expected_error_deg(target, at_s)
    except (Unknown, NotThere) as reason:
        raise CommandFailed(str(reason)) from None
    if as_json:
        told = {
            "name": target.name,
            "at": iso(at_s),
            "az_deg": round(seen.sight.azimuth_deg, 4),
            "el_deg": round(seen.sight.elevation_deg, 4),
            "az_dps": round(seen.azimuth_dps, 5),
            "el_dps": round(seen.elevation_dps, 5),
            "range_km": _km(seen.sight.range_km),
            "expected_error_deg": round(error_deg, 4),
        }
        click.echo(json.dumps(told))
        return
    sight = seen.sight
    far = "" if math.isinf(sight.range_km) else f", {sight.range_km:,.0f} km away"
    under = "" if sight.elevation_deg >= 0 else " (below the horizon)"
    click.echo(f"{target.name} at {day_and_time(at_s)} UTC ({local_time(at_s)} here)")
    click.echo(f"  azimuth {sight.azimuth_deg:.2f}°, elevation {sight.elevation_deg:.2f}°{under}{far}")
    click.echo(f"  moves {seen.azimuth_dps:+.3f}°/s in azimuth, {seen.elevation_dps:+.3f}°/s in elevation")
    if error_deg >= 0.005:
        click.echo(f"  expect an error of up to {error_deg:.2f}°{_beyond(error_deg, config.station.beam_deg)}")


def show_passes(
    path: Path | None, names: tuple[str, ...], from_s: float | None, hours: float, least_deg: float, *, as_json: bool
) -> None:
    config = load(path or (INSTALLED if INSTALLED.exists() else None))
    site, catalogue = _sky(config)
    from_s = time.time() if from_s is None else from_s
    try:
        targets = [find(name, site, catalogue) for name in names] or _all(site, catalogue)
    except (Unknown, NotThere) as reason:
        raise CommandFailed(str(reason)) from None
    found = [
        (target, each) for target in targets for each in passes_of(target, from_s, from_s + hours * 3600, least_deg)
    ]
    found.sort(key=lambda pair: pair[1].aos_s or from_s)
    if as_json:
        plan = sky_plan.planned(config, sky_plan.followed_by(config, site, catalogue), from_s, hours)
        # A long pass may be flown in parts: its first one is told.
        parts = {(each.name, each.found.tca_s): each for each in reversed(plan)}
        rows = []
        for target, each in found:
            how = parts.get((each.name, each.tca_s))
            error = {"expected_error_deg": round(_error_deg(target, each), 2)}
            rows.append({**_as_dict(each), **error, "plan": how and sky_plan.as_dict(how)})
        click.echo(json.dumps(rows))
        return
    if not found:
        click.echo(NO_PASS)
        return
    _table([each for _, each in found])


def show_plan(path: Path | None, from_s: float | None, hours: float, *, as_json: bool) -> None:
    config = load(path or (INSTALLED if INSTALLED.exists() else None))
    site, catalogue = _sky(config)
    if not config.sky.follow:
        raise CommandFailed(sky_plan.NOTHING)
    followed = sky_plan.followed_by(config, site, catalogue)
    if not followed:
        raise CommandFailed("none of the followed targets is known")
    from_s = time.time() if from_s is None else from_s
    plan = sky_plan.planned(config, followed, from_s, hours)
    if as_json:
        click.echo(json.dumps([{**_as_dict(each.found), **sky_plan.as_dict(each)} for each in plan]))
        return
    sky_plan.show(plan, from_s)
    for line in sky_plan.changed(config):
        click.echo(line)


def _sky(config: Config) -> tuple[Site, Catalogue]:
    """Raises CommandFailed without a place. Says which files could not be read."""
    site = build_site(config.station)
    if site is None:
        raise CommandFailed(NO_PLACE)
    catalogue = build_catalogue(config)
    for fault in catalogue.faults:
        click.echo(f"[sky] elements: {fault}", err=True)
    return site, catalogue


def _all(site: Site, catalogue: Catalogue) -> list[Target]:
    """Every satellite whose elements sgp4 takes."""
    if not catalogue.satellites:
        raise Unknown("name a target: there are no elements of satellites ([sky] elements names files of them)")
    targets: list[Target] = []
    for elements in catalogue.satellites:
        try:
            targets.append(Satellite(elements, site))
        except NotThere as reason:
            click.echo(str(reason), err=True)
    return targets


def _error_deg(target: Target, each: Pass) -> float:
    """The largest that is to be expected in the pass, from the age of the elements."""
    moments_s = [moment_s for moment_s in (each.aos_s, each.tca_s, each.los_s) if moment_s is not None]
    try:
        return max(expected_error_deg(target, moment_s) for moment_s in moments_s)
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


def _table(found: list[Pass]) -> None:
    table = Table(box=None, pad_edge=False)
    table.add_column("name", overflow="ellipsis", no_wrap=True)
    for heading in ("rises (UTC)", "here", "for", "from", "highest", "to"):
        table.add_column(heading, justify="right", no_wrap=True)
    for each in found:
        table.add_row(
            each.name,
            "is up" if each.aos_s is None else day_and_time(each.aos_s),
            "" if each.aos_s is None else local_time(each.aos_s),
            "" if each.aos_s is None or each.los_s is None else f"{(each.los_s - each.aos_s) / 60:.0f} min",
            "" if each.aos is None else f"{each.aos.azimuth_deg:.0f}°",
            f"{each.highest.elevation_deg:.0f}°",
            "stays" if each.los is None else f"{each.los.azimuth_deg:.0f}°",
        )
    Console(highlight=False).print(table)


def _km(range_km: float) -> float | None:
    return None if math.isinf(range_km) else round(range_km, 3)


def _beyond(error_deg: float, beam_deg: float) -> str:
    return f": more than half of the beam of {beam_deg:g}°" if error_deg > beam_deg / 2 else ""
