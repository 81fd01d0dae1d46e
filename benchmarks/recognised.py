"""What recognition gains: run `python -m benchmarks.recognised [PASSES [SEED]]`.

Passes at random stations and moments, of real satellites and of orbits like theirs, all of them in the catalogue. Each
is flown three times from the rotor's place at its beginning: known beforehand (`--via track`), as a stream of whole
degrees from a program whose clock is up to 5 s off, and as the same stream to a box that knows no satellites. The
stream begins as the program sees the satellite rise. Errors are those to the true satellite; those of the last flight
are to the stream itself. `--flip`: a rotor of 360° that goes over the top; `--single`: one of 360° that does not.
`--early S`: the program sends so long before the rise, with elevation 0. `--turning`: only passes that the rotor has to
unwind for, from where it stands as they begin. `--anywhere`: the antenna does not stand where the stream begins.
"""

from __future__ import annotations

import argparse
import json
import math
import random
import tempfile
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from benchmarks.recognition import catalogue
from firmware_sim.clock import SimClock
from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.route import STEP_S, Speeds
from rotator.control.sky.ways import best_route
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.rehearsal.flight import fly
from rotator.rehearsal.overhearing import Told
from rotator.rehearsal.passes import Pass
from rotator.rehearsal.plants import BoxPlant, Plant
from rotator.rehearsal.summary import SAMPLE_S, Summary

PASSES, SATELLITES = 40, 30
LEAST_DEG = 10.0
CLOCK_S = 5.0
LOST_DEG = 10.0
FLIP = "[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 180\n[mount]\nflip = 'over-top'\n"
SINGLE = "[azimuth]\nmax_deg = 360\n[elevation]\nmax_deg = 90\n"
TURNING_S = 5.0
"""A pass that loses more seconds is one that the rotor unwinds for."""
WORSE_DEG, WORSE_S = 0.05, 1.0


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


@dataclass(frozen=True, slots=True)
class Flight:
    """`lost_s`: for so long the antenna was more than 10° off while the satellite was up."""

    summary: Summary
    lost_s: float

    @property
    def rms_deg(self) -> float:
        return self.summary.rms_deg

    @property
    def starts(self) -> int:
        return self.summary.relay_starts or 1


@dataclass(frozen=True, slots=True)
class Flights:
    job: Job
    known: Flight
    recognised: Flight
    stream: Flight

    @property
    def ratio(self) -> float:
        """Of error times starts, to those of the known pass: the least error is nearly as one over the starts."""
        each = [flown.rms_deg * flown.starts for flown in (self.recognised, self.known)]
        return each[0] / each[1]

    @property
    def told(self) -> Told | None:
        return self.recognised.summary.recognised

    @property
    def worse(self) -> bool:
        """Than the stream alone: in seconds; where they are equal, in degrees."""
        lost_s = self.recognised.lost_s - self.stream.lost_s
        return lost_s > WORSE_S or (lost_s > -WORSE_S and self.recognised.rms_deg > self.stream.rms_deg + WORSE_DEG)


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


def flights(job: Job) -> Flights:
    config: Config = parse(job.config, "benchmark")
    flown = flown_pass(job)
    begin_utc_s = job.aos_s - job.early_s - job.ahead_s
    stands_deg = (flown.rows[0][1] if job.stands_deg is None else job.stands_deg), 0.0

    def maker(via: str = "gs232", utc_s: float | None = None) -> Callable[[SimClock, Pass], Plant]:
        return lambda clock, _flown: BoxPlant(config, clock, stands_deg, via, utc_s=utc_s)

    makers = maker("track"), maker(utc_s=begin_utc_s), maker()
    return Flights(job, *(_flight(flown, make) for make in makers))


def _flight(flown: Pass, make: Callable[[SimClock, Pass], Plant]) -> Flight:
    trace, summary = fly(flown, make)
    off = sum(sample.error_deg > LOST_DEG and sample.target_el > 0 and sample.t >= 0 for sample in trace)
    return Flight(summary, off * SAMPLE_S)


def unwinds(job: Job) -> bool:
    """Whether the rotor turns right round in this pass, if it stands where the pass begins."""
    config = parse(job.config, "benchmark")
    path = KnownPath(flown_pass(job).rows)
    stands_deg = (path.rows[0][1] if job.stands_deg is None else job.stands_deg), 0.0
    speeds = Speeds(*(motor.speed_dps for motor in planned_motors(config)))
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


def line(each: Flights) -> str:
    told = each.told
    named = f"{told.name} after {told.after_s - each.job.early_s:5.1f} s" if told else "none"
    shown = "; ".join(
        f"{one.rms_deg:6.2f}° {one.starts:3} starts {one.lost_s:5.1f} s"
        for one in (each.known, each.recognised, each.stream)
    )
    wrong = " WRONG" if told and told.name != each.job.name else ""
    worse = " WORSE" if each.worse else ""
    return f"{each.job.name:8} {each.job.ahead_s:+.1f} s: {shown}; {each.ratio:.2f}; {named}{wrong}{worse}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("passes", type=int, nargs="?", default=PASSES)
    parser.add_argument("seed", type=int, nargs="?", default=15)
    parser.add_argument("--flip", dest="rotor", action="store_const", const=FLIP, default="")
    parser.add_argument("--single", dest="rotor", action="store_const", const=SINGLE)
    parser.add_argument("--turning", action="store_true")
    parser.add_argument("--anywhere", action="store_true")
    parser.add_argument("--early", type=float, default=0.0)
    parser.add_argument("--each", action="store_true", help="print every pass")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, ProcessPoolExecutor() as pool:
        kinds = {"turning": asked.turning, "anywhere": asked.anywhere}
        wanted = jobs(asked.passes, asked.seed, asked.rotor, asked.early, Path(folder), **kinds)
        done = []
        for each in pool.map(flights, wanted):
            done.append(each)
            if asked.each:
                print(line(each), flush=True)
    after_s = [each.told.after_s - each.job.early_s for each in done if each.told]
    print(f"{len(done)} passes, {len(after_s)} recognised, at most {max(after_s, default=0.0):.1f} s after the rise")
    for name in ("known", "recognised", "stream"):
        flown: list[Flight] = [getattr(each, name) for each in done]
        print(
            f"{name:10} {sum(f.rms_deg for f in flown) / len(flown):6.3f}° rms, "
            f"{sum(f.starts for f in flown) / len(flown):5.1f} starts, "
            f"p95 {sum(f.summary.p95_deg for f in flown) / len(flown):.2f}°, "
            f"beyond 10° for {sum(f.lost_s for f in flown) / len(flown):.1f} s"
        )
    plain = [each for each in done if max(each.known.rms_deg, each.recognised.rms_deg) < LOST_DEG / 2]
    mean = sum(each.ratio for each in plain) / max(1, len(plain))
    print(f"error x starts, recognised to known: {mean:.3f} on the {len(plain)} passes with no turn round")
    worse = [each for each in done if each.worse]
    most_s = max((each.recognised.lost_s - each.stream.lost_s for each in worse), default=0.0)
    most_deg = max((each.recognised.rms_deg - each.stream.rms_deg for each in worse), default=0.0)
    print(f"worse than the stream alone: {len(worse)} passes, by {most_s:.1f} s and {most_deg:.2f}° at most")


if __name__ == "__main__":
    main()
