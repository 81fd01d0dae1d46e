"""`rotator sky up`: what is above the horizon now, for a person in lines, and for the page as JSON with its paths.

Knows the words and the fields, and what stands first where not everything is shown. Does not know orbits.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import click

from rotator.cli import sky_plan
from rotator.cli.sky import read_sky, satellites
from rotator.cli.utc import local_time
from rotator.orbits.catalogue import NOT_FETCHED
from rotator.orbits.names import amateur_name
from rotator.orbits.passes import LOOK_S, Pass, passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere, Sight, Target
from rotator.orbits.twins import one_of_each

NEAR_S, NEAR_DEG = 120, -6.0
"""Seconds between two looks: what is lower at both does not rise and set again between them."""
SLOW_S, SLOW_LOOK_S = 20_000.0, 600.0
"""What takes longer than this for one revolution stays up for hours: fewer looks find its rise and its set."""
LEGS = 40
"""Straight pieces of a path."""


@dataclass(frozen=True, slots=True)
class Overhead:
    """`path`: the directions from `from_s` on, `step_s` seconds apart."""

    found: Pass
    from_s: float
    step_s: float
    path: list[Sight]


def overhead(target: Target, now_s: float, until_s: float) -> Iterator[Overhead]:
    """Each pass of it that is up at some moment between the two times. A satellite that has decayed has none."""
    slow = not isinstance(target, Satellite) or target.period_s > SLOW_S
    with suppress(NotThere):
        looks_s = (*range(int(now_s), int(until_s), NEAR_S), until_s)
        if not any(target.sight(look_s).elevation_deg > NEAR_DEG for look_s in looks_s):
            return
        for found in passes(target, now_s, until_s, every_s=SLOW_LOOK_S if slow else LOOK_S):
            from_s = now_s if found.aos_s is None else found.aos_s
            step_s = ((until_s if found.los_s is None else found.los_s) - from_s) / LEGS
            yield Overhead(found, from_s, step_s, [target.sight(from_s + step_s * leg) for leg in range(LEGS + 1)])


AHEAD_S = 420.0
"""What rises within so many seconds is in the JSON, too: the page asks again before that."""
MOST = 400
RANKS = "followed", "body", "amateur", ""
"""The importance of what is up, the highest first."""


def show_up(path: Path | None, at_s: float | None, *, as_json: bool) -> None:
    from rotator.orbits.celestial import Body  # noqa: PLC0415 - slow to load

    config, site, catalogue = read_sky(path)
    now_s, known = time.time() if at_s is None else at_s, satellites(site, catalogue)
    targets: list[Target] = [Body("Sun", site), Body("Moon", site), *one_of_each(known)]
    until_s = now_s + (AHEAD_S if as_json else 1.0)
    found = [(target, each) for target in targets for each in overhead(target, now_s, until_s)]
    if not as_json:
        for target, each in sorted(found, key=lambda pair: -pair[0].sight(now_s).elevation_deg):
            sight, los_s = target.sight(now_s), each.found.los_s
            sets = "stays up" if los_s is None else f"sets at {local_time(los_s)}"
            where = f"azimuth {sight.azimuth_deg:.0f}°, elevation {sight.elevation_deg:.0f}°"
            click.echo(f"{target.name}: {where}, highest {each.found.highest.elevation_deg:.0f}°, {sets}")
        return
    followed = {each.target.name for each in sky_plan.followed_by(config, site, catalogue)}
    ranked = sorted(
        ((_rank(target, followed), target, each) for target, each in found),
        key=lambda row: (RANKS.index(row[0]), -row[2].found.highest.elevation_deg),
    )
    told = {"utc_s": now_s, "until_s": until_s, "left_out": max(0, len(ranked) - MOST)}
    # Without any, the sentence says what to do about it.
    why_none = "" if known else catalogue.none_known
    there_are = {"satellites": len(known), "why_none": why_none, "unfetched": why_none == NOT_FETCHED}
    click.echo(json.dumps({**told, **there_are, "up": [_as_dict(*row) for row in ranked[:MOST]]}))


def _rank(target: Target, followed: set[str]) -> str:
    if target.name in followed:
        return "followed"
    if not isinstance(target, Satellite):
        return "body"
    return "amateur" if amateur_name(target.elements) else ""


def _as_dict(rank: str, target: Target, each: Overhead) -> dict[str, object]:
    found, elements = each.found, target.elements if isinstance(target, Satellite) else None
    return {
        "name": target.name,
        "short": (elements and amateur_name(elements)) or target.name.partition(" (")[0],
        "number": elements and elements.catalogue_number,
        "rank": rank,
        "aos_s": found.aos_s and round(found.aos_s, 1),
        "los_s": found.los_s and round(found.los_s, 1),
        "tca_s": round(found.tca_s, 1),
        "max_el_deg": round(found.highest.elevation_deg, 1),
        "from_s": round(each.from_s, 3),
        "step_s": round(each.step_s, 4),
        "points": [[round(sight.azimuth_deg, 2), round(sight.elevation_deg, 2)] for sight in each.path],
    }
