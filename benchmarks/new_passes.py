"""Positioned rotors on passes that stand in no file: run `python -m benchmarks.new_passes [PASSES [SEED]]`.

Passes at stations and moments drawn at random, of real satellites and of orbits like theirs, flown by hobby servos,
digital pots and moteus motors: as a stream of whole degrees, and known beforehand. Prints for each: the pointing error,
seconds beyond 10°, by how much an axis went beyond its limits, and the hardest jerk near a limit, as a change of speed
within a tenth of a second, beside the speed of the motor. A servo that holds trembles, and that counts too. `--each`
prints every pass, which takes some seconds.
"""

from __future__ import annotations

import argparse
import random
from collections.abc import Sequence
from dataclasses import dataclass

from benchmarks.kinds import KINDS, Kind, away_s
from benchmarks.passes import mean
from benchmarks.recognition import catalogue
from benchmarks.recognition_delay import rises
from rotator.control.sky.mount import Range
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import Pass
from rotator.rehearsal.summary import SAMPLE_S, Summary

PASSES, SATELLITES = 5, 30
LONGEST_S = 1500.0
PROFILES = "servos", "orbit360", "isel"
NEAR_DEG = 3.0
"""Degrees to a limit within which a jerk counts."""
OVER = round(0.1 / SAMPLE_S)
"""Samples over which a speed is taken, and within which it changes."""


@dataclass(frozen=True, slots=True)
class Flight:
    summary: Summary
    away_s: float
    beyond_deg: float
    jerk_dps: float
    fastest_dps: float


def drawn(count: int, seed: int) -> list[Pass]:
    dice = random.Random(seed)
    found: list[Pass] = []
    elements = catalogue(dice, SATELLITES)
    while len(found) < count:
        [rise] = rises(dice, elements, 1)
        satellite = Satellite(rise.elements, rise.site)
        one = next(passes(satellite, rise.aos_s - 1.0, rise.aos_s + 1.0))
        if one.los_s is None or one.los_s - rise.aos_s > LONGEST_S:
            continue
        sights = [satellite.sight(rise.aos_s + second) for second in range(int(one.los_s - rise.aos_s) + 1)]
        rows = tuple((float(second), each.azimuth_deg, each.elevation_deg) for second, each in enumerate(sights))
        found.append(Pass(f"{satellite.name}, {one.highest.elevation_deg:.0f}° high", rows))
    return found


def flown(kind: Kind, each: Pass, via: str) -> Flight:
    config = kind.config()
    trace, summary = fly(each, plant_maker(config, via=via))
    axes = (
        (config.azimuth, [sample.antenna_az for sample in trace]),
        (config.elevation, [sample.antenna_el for sample in trace]),
    )
    ranges = [(Range(axis.min_deg, axis.max_deg), angles_deg) for axis, angles_deg in axes]
    return Flight(
        summary,
        away_s(trace),
        max(abs(deg - limits.nearest(deg)) for limits, angles_deg in ranges for deg in angles_deg),
        max(jerk_dps(limits, angles_deg) for limits, angles_deg in ranges),
        max(abs(speed) for _, angles_deg in ranges for speed in speeds_dps(angles_deg)),
    )


def speeds_dps(angles_deg: Sequence[float]) -> list[float]:
    return [(b - a) / (OVER * SAMPLE_S) for a, b in zip(angles_deg, angles_deg[OVER:], strict=False)]


def jerk_dps(limits: Range, angles_deg: Sequence[float]) -> float:
    speeds = speeds_dps(angles_deg)
    return max(
        (
            abs(after - before)
            for before, after, deg in zip(speeds, speeds[OVER:], angles_deg[OVER:], strict=False)
            if min(abs(deg - limits.min_deg), abs(deg - limits.max_deg)) <= NEAR_DEG
        ),
        default=0.0,
    )


def line(name: str, flights: Sequence[Flight]) -> str:
    each = [flight.summary for flight in flights]
    mean_deg, p95_deg = mean([s.rms_deg for s in each]), mean([s.p95_deg for s in each])
    return (
        f"{name}: {mean_deg:.3f}° rms, 95 % within {p95_deg:.3f}°, worst {max(s.max_deg for s in each):.1f}°, "
        f"beyond 10° for {max(f.away_s for f in flights):.1f} s at most, "
        f"beyond a limit by {max(f.beyond_deg for f in flights):.3f}°, "
        f"jerk near it {max(f.jerk_dps for f in flights):.2f}°/s, "
        f"fastest {max(f.fastest_dps for f in flights):.1f}°/s"
    )


def main(count: int, seed: int, *, each: bool) -> None:
    wanted = drawn(count, seed)
    for kind in KINDS:
        if kind.profile not in PROFILES or kind.via != "gs232":
            continue
        for via in ("gs232", "track"):
            flights = []
            for one in wanted:
                flights.append(flown(kind, one, via))
                if each:
                    print(line(f"  {one.name}", flights[-1:]), flush=True)
            print(line(f"{kind.profile} {via}", flights), flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("passes", type=int, nargs="?", default=PASSES)
    parser.add_argument("seed", type=int, nargs="?", default=15)
    parser.add_argument("--each", action="store_true")
    asked = parser.parse_args()
    main(asked.passes, asked.seed, each=asked.each)
