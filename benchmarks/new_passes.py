"""The machines on passes that stand in no file: run `python -m benchmarks.new_passes [PASSES [SEED]]`.

Passes at stations and moments drawn at random, of real satellites and of orbits like theirs, flown by the machines that
are named (`--machines`; else isel, servos and orbit360): as a stream of whole degrees, and known beforehand. Prints for
each: the pointing error; motor starts; seconds beyond 10°, and how many the best way through these passes costs; by how
much a shaft went beyond its limits; and its hardest jerk near a limit, as a change of speed within a tenth of a second,
beside the speed of the motor. `--highest 80` draws only passes that culminate there or above. `--each` prints every
pass, which takes some seconds.
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
from firmware_sim.clock import SimClock
from firmware_sim.rotors.digipot import SimDigipotRotor
from firmware_sim.rotors.rotor import SimRotor
from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.model import Config
from rotator.control.sky.known_path import KnownPath
from rotator.control.sky.mount import Range
from rotator.control.sky.route import STEP_S, Speeds
from rotator.control.sky.ways import best_route
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.rehearsal.flight import fly
from rotator.rehearsal.passes import Pass
from rotator.rehearsal.plants import KNOWN_S, BoxPlant
from rotator.rehearsal.summary import SAMPLE_S, Summary

PASSES, SATELLITES = 5, 30
LONGEST_S = 1500.0
MACHINES = "simulated", "u100", "isel", "servos", "orbit360"
POSITIONED = MACHINES[2:]
NEAR_DEG = 3.0
"""Degrees to a limit within which a jerk counts."""
OVER = round(0.1 / SAMPLE_S)
"""Samples over which a speed is taken, and within which it changes."""


@dataclass(frozen=True, slots=True)
class Flight:
    summary: Summary
    starts: int | None
    """None: its motors have no switches."""
    away_s: float
    possible_s: float
    """How long the best way is beyond 10°, looked at every `STEP_S`."""
    beyond_deg: float
    jerk_dps: float
    fastest_dps: float


def drawn(count: int, seed: int, highest_deg: float) -> list[Pass]:
    dice = random.Random(seed)
    found: list[Pass] = []
    elements = catalogue(dice, SATELLITES)
    while len(found) < count:
        [rise] = rises(dice, elements, 1)
        satellite = Satellite(rise.elements, rise.site)
        one = next(passes(satellite, rise.aos_s - 1.0, rise.aos_s + 1.0))
        if one.los_s is None or one.los_s - rise.aos_s > LONGEST_S or one.highest.elevation_deg < highest_deg:
            continue
        sights = [satellite.sight(rise.aos_s + second) for second in range(int(one.los_s - rise.aos_s) + 1)]
        rows = tuple((float(second), each.azimuth_deg, each.elevation_deg) for second, each in enumerate(sights))
        found.append(Pass(f"{satellite.name}, {one.highest.elevation_deg:.0f}° high", rows))
    return found


def flown(kind: Kind, each: Pass, via: str) -> Flight:
    config = kind.config()
    shafts: list[tuple[float, float]] = []
    worlds: list[SimRotor] = []

    def make(clock: SimClock, one: Pass) -> BoxPlant:
        plant = BoxPlant(config, clock, (one.rows[0][1], 0.0), via)
        worlds.append(plant.world)
        clock.every(SAMPLE_S, lambda _now_s: shafts.append(plant.world.shafts()))
        return plant

    trace, summary = fly(each, make)
    axes = [
        (Range(axis.min_deg, axis.max_deg), angles_deg)
        for axis, angles_deg in zip((config.azimuth, config.elevation), zip(*shafts, strict=True), strict=True)
    ]
    return Flight(
        summary,
        starts(worlds[0]),
        away_s(trace),
        possible_s(config, each, KNOWN_S if via == "track" else 0.0),
        max(abs(deg - limits.nearest(deg)) for limits, angles_deg in axes for deg in angles_deg),
        max(jerk_dps(limits, angles_deg) for limits, angles_deg in axes),
        max(abs(speed) for _, angles_deg in axes for speed in speeds_dps(angles_deg)),
    )


def starts(world: SimRotor) -> int | None:
    if isinstance(world, SimDigipotRotor):  # the control boxes switch their motors
        return world.azimuth.starts + world.elevation.starts
    return world.relay_starts


def possible_s(config: Config, each: Pass, early_s: float) -> float:
    """From where the pass begins, as the antenna stands."""
    mount, (azimuth, elevation) = build_mount(config), planned_motors(config)
    path = KnownPath(each.rows)
    speeds = Speeds(azimuth.speed_dps, elevation.speed_dps, azimuth.switched)
    stands_deg = mount.azimuth.nearest(each.rows[0][1]), mount.elevation.min_deg
    return best_route(mount, path.directions(path.begin_s, STEP_S), stands_deg, early_s, speeds).lost_s


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
    counts = [float(flight.starts) for flight in flights if flight.starts is not None]
    away, possible = mean([f.away_s for f in flights]), mean([f.possible_s for f in flights])
    return (
        f"{name}: {mean_deg:.3f}° rms, 95 % within {p95_deg:.3f}°, worst {max(s.max_deg for s in each):.1f}°, "
        f"{f'{mean(counts):.0f} starts, ' if counts else ''}"
        f"beyond 10° for {away:.1f} s, the best way for {possible:.0f}, "
        f"beyond a limit by {max(f.beyond_deg for f in flights):.3f}°, "
        f"jerk near it {max(f.jerk_dps for f in flights):.2f}°/s, "
        f"fastest {max(f.fastest_dps for f in flights):.1f}°/s"
    )


def main(count: int, seed: int, machines: Sequence[str], highest_deg: float, *, each: bool) -> None:
    wanted = drawn(count, seed, highest_deg)
    for kind in KINDS:
        if kind.profile not in machines or kind.via != "gs232" or kind.overlap:
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
    parser.add_argument("--machines", nargs="+", choices=MACHINES, default=POSITIONED, metavar="M")
    parser.add_argument("--highest", type=float, default=0.0, metavar="DEG")
    parser.add_argument("--each", action="store_true")
    asked = parser.parse_args()
    main(asked.passes, asked.seed, asked.machines, asked.highest, each=asked.each)
