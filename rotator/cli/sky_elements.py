"""`rotator sky elements`: which elements there are, how old they are, and what came of fetching them.

Knows the words and the fields. Reads the files, and the record of the running box; asks no server.
"""

from __future__ import annotations

import json
import time
from pathlib import Path

import click

from rotator.assembly.fetching import fetches_file
from rotator.assembly.sky import build_catalogue
from rotator.cli.utc import clock_time, day, iso, local_time
from rotator.config.load import load
from rotator.config.places import INSTALLED
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.elements import Elements
from rotator.store.fetches import Asked, Fetches

NOTHING = (
    "the configuration names no elements: write elements = [files] or fetch = [addresses] below [sky], or send a file "
    "by the page"
)


def show_elements(path: Path | None, *, as_json: bool) -> None:
    config = load(path or (INSTALLED if INSTALLED.exists() else None))
    catalogue, fetches = build_catalogue(config), fetches_file(config).load() or {}
    if as_json:
        click.echo(json.dumps(_as_dict(catalogue, fetches, config.sky.fetch)))
        return
    if not (config.sky.elements or config.sky.fetch or catalogue.by_file):
        click.echo(NOTHING)
        return
    now_s = time.time()
    count = len(catalogue.satellites)
    click.echo(f"{count} satellite{'' if count == 1 else 's'}{_age(catalogue.satellites, now_s)}")
    for file, sets in catalogue.by_file.items():
        click.echo(f"{file}\n  {len(sets)}{_age(sets, now_s)}")
    for address in config.sky.fetch:
        click.echo(address)
        for line in _went(fetches.get(address)):
            click.echo(f"  {line}")
    for fault in catalogue.faults:
        click.echo(f"[sky] elements: {fault}", err=True)


def _age(sets: tuple[Elements, ...], now_s: float) -> str:
    """In days, of the newest and of the oldest set."""
    if not sets:
        return ""
    ages = sorted(each.age_days(now_s) for each in sets)
    newest, oldest = f"{ages[0]:.1f}", f"{ages[-1]:.1f}"
    return f", elements {newest} days old" if newest == oldest else f", elements {newest} to {oldest} days old"


def _went(asked: Asked | None) -> list[str]:
    if asked is None:
        return ["not asked yet: the running box does it, as soon as its clock is right"]
    lines = []
    if asked.good_utc_s is not None:
        lines.append(f"last good {_moment(asked.good_utc_s)}: {asked.sets} satellites")
    if asked.trouble:
        lines.append(f"asked {_moment(asked.asked_utc_s)}: {asked.trouble}")
    return [*lines, f"not asked again before {_moment(_again_s(asked))}"]


def _again_s(asked: Asked) -> float:
    return asked.asked_utc_s + asked.wait_s


def _moment(utc_s: float) -> str:
    return f"{day(utc_s)} {clock_time(utc_s)[:5]} UTC ({local_time(utc_s)} here)"


def _as_dict(catalogue: Catalogue, fetches: Fetches, addresses: list[str]) -> dict[str, object]:
    return {
        "satellites": len(catalogue.satellites),
        "files": [_file(path, sets) for path, sets in catalogue.by_file.items()],
        "fetch": [_fetch(address, fetches.get(address)) for address in addresses],
        "faults": list(catalogue.faults),
    }


def _file(path: Path, sets: tuple[Elements, ...]) -> dict[str, object]:
    epochs_s = [each.epoch_utc_s for each in sets]
    return {
        "path": str(path),
        "satellites": len(sets),
        "oldest": iso(min(epochs_s)) if sets else None,
        "newest": iso(max(epochs_s)) if sets else None,
    }


def _fetch(address: str, asked: Asked | None) -> dict[str, object]:
    good_s = asked.good_utc_s if asked else None
    return {
        "address": address,
        "asked": iso(asked.asked_utc_s) if asked else None,
        "good": None if good_s is None else iso(good_s),
        "satellites": asked.sets if asked else 0,
        "not_before": iso(_again_s(asked)) if asked else None,
        "reason": (asked.trouble or None) if asked else "not asked yet",
    }
