"""Passes at random stations and moments, of real satellites and of orbits like theirs, for a box that knows them all.

Knows the station, the elements and the clock of the program that sends each pass. Does not know how it is flown.
"""

from __future__ import annotations

import json
import math
import random
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from benchmarks.recognition import catalogue
from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.load import parse
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.route import STEP_S, Speeds
from rotator.control.sky.ways import best_route
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.rehearsal.passes import Pass

SATELLITES = 30
LEAST_DEG = 10.0
CLOCK_S = 5.0
TURNING_S = 5.0
"""A pass that loses more seconds is one that the rotor unwinds for."""


@dataclass(frozen=True, slots=True)
class Job:
    """One pass. `ahead_s`: how far the program's clock is ahead."""

    name: str
    config: str
    elements: Elements
    site: Site
    aos_s: float
    los_s: float
    ahead_s: float
    early_s: float
    stands_deg: float | None
    """The antenna's azimuth at the beginning; None: where the stream begins."""


def omm(elements: Elements) -> dict[str, object]:
    epoch = datetime.fromtimestamp(elements.epoch_utc_s, UTC)
    return {
        "OBJECT_NAME": elements.name,
        "OBJECT_ID": "2025-001A",
        "EPOCH": epoch.strftime("%Y-%m-%dT%H:%M:%S.%f"),
        "MEAN_MOTION": elements.mean_motion_rev_per_day,
        "ECCENTRICITY": elements.eccentricity,
        "INCLINATION": elements.inclination_deg,
        "RA_OF_ASC_NODE": elements.ascending_node_deg,
        "ARG_OF_PERICENTER": elements.perigee_argument_deg,
        "MEAN_ANOMALY": elements.mean_anomaly_deg,
        "NORAD_CAT_ID": elements.catalogue_number,
        "BSTAR": elements.drag_per_earth_radius,
        "MEAN_MOTION_DOT": elements.mean_motion_dot,
        "MEAN_MOTION_DDOT": elements.mean_motion_ddot,
    }


def flown_pass(job: Job) -> Pass:
    """As a program sees it, from its rise on, or before: with a clock that is ahead the same, only earlier."""
    satellite = Satellite(job.elements, job.site)
    begin_s = job.aos_s - job.early_s
    count = int(job.los_s - begin_s) + 1
    sights = [satellite.sight(begin_s + second) for second in range(count)]
    rows = tuple((float(t), each.azimuth_deg, each.elevation_deg) for t, each in enumerate(sights))
    return Pass(job.name, rows)


def unwinds(job: Job) -> bool:
    """Whether the rotor turns right round in this pass, if it stands where the pass begins."""
    config = parse(job.config, "benchmark")
    path = KnownPath(flown_pass(job).rows)
    stands_deg = (path.rows[0][1] if job.stands_deg is None else job.stands_deg), 0.0
    azimuth, elevation = planned_motors(config)
    speeds = Speeds(azimuth.speed_dps, elevation.speed_dps, azimuth.switched)
    route = best_route(build_mount(config), path.directions(path.begin_s, STEP_S), stands_deg, 0.0, speeds)
    return route.lost_s > TURNING_S


def jobs(
    count: int, seed: int, extra: str, early_s: float, folder: Path, *, turning: bool = False, anywhere: bool = False
) -> list[Job]:
    dice = random.Random(seed)
    found: list[Job] = []
    elements = catalogue(dice, SATELLITES)
    file = folder / "elements.json"
    file.write_text(json.dumps([omm(each) for each in elements]), encoding="utf-8")
    while len(found) < count:
        site = Site(math.degrees(math.asin(dice.uniform(-0.9, 0.9))), dice.uniform(-180, 180), dice.uniform(0, 1000))
        each = dice.choice(elements[: dice.choice((3, SATELLITES))])
        from_s = each.epoch_utc_s + dice.uniform(0, 10 * 86_400.0)
        try:
            one = next(passes(Satellite(each, site), from_s, from_s + 86_400.0, LEAST_DEG), None)
        except NotThere:
            continue
        if one is None or one.aos_s is None or one.los_s is None or one.los_s - one.aos_s > 1500:
            continue
        config = (
            f"[station]\nlatitude_deg = {site.latitude_deg}\nlongitude_deg = {site.longitude_deg}\n"
            f"altitude_m = {site.altitude_m}\n[sky]\nelements = ['{file}']\n{extra}"
        )
        ahead_s = dice.uniform(-CLOCK_S, CLOCK_S)
        limits = build_mount(parse(config, "benchmark")).azimuth
        stands_deg = dice.uniform(limits.min_deg, limits.max_deg) if anywhere else None
        job = Job(each.name, config, each, site, one.aos_s, one.los_s, ahead_s, early_s, stands_deg)
        if not turning or unwinds(job):
            found.append(job)
    return found
