"""What an unrecognised stream costs where it crosses the rotor's seam: run `python -m benchmarks.seam [PASSES [SEED]]`.

The shipped `servos` (0 to 180 twice, the other half over the top) and `f1efw` (0 to 360, no overlap), simulated, follow
passes of circular orbits 400 to 1500 km high that cross the end of the azimuth range, drawn at random: as a stream of
whole degrees (gs232) or hundredths (rotctld) to a box that knows no satellite, and known beforehand (track), which is
what could be done. `--turns-back`: each stream ends its course 1 to 15 degrees before the seam instead: it goes back
the way it came, or stands. Prints the error integrated over the pass, and how long it is beyond 10°. A flight takes
some 10 s.
"""

from __future__ import annotations

import argparse
import math
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from benchmarks.kinds import Kind, away_s
from benchmarks.passes import mean
from rotator.control.sky.angles import turn_deg
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.rehearsal.flight import SAMPLE_S, fly, plant_maker
from rotator.rehearsal.passes import Pass
from rotator.views.trace import SETTLING_S, Sample

PASSES, SEED = 20, 44
HEIGHTS_KM, EARTH_KM, MU_KM3_S2 = (400.0, 1500.0), 6378.0, 398_600.4
LEAST_DEG, LOWEST_DEG = 10.0, 2.0
"""The least culmination, and the least elevation at the seam."""
EPOCH_S, DAYS = 1_700_000_000.0, 2
SEAMS = {"servos": (0.0, 180.0), "f1efw": (0.0,)}
"""The azimuths where the way round ends."""
BEFORE_DEG = 1.0, 15.0
NEAR_DEG = 90.0
STANDS_S = 120
VIAS = "gs232", "rotctld", "track"


@dataclass(frozen=True, slots=True)
class Crossing:
    flown: Pass
    at: int
    """The row behind the seam."""


def crossings(dice: random.Random, seams: Sequence[float]) -> Iterator[Crossing]:
    while True:
        axis_km = EARTH_KM + dice.uniform(*HEIGHTS_KM)
        rev_per_day = 86_400.0 / math.tau * math.sqrt(MU_KM3_S2 / axis_km**3)
        tilt_deg, node_deg, anomaly_deg = dice.uniform(30.0, 150.0), dice.uniform(0.0, 360.0), dice.uniform(0.0, 360.0)
        orbit = Elements("CIRCLE", 1, EPOCH_S, rev_per_day, 0.0, tilt_deg, node_deg, 0.0, anomaly_deg)
        satellite = Satellite(orbit, Site(dice.uniform(-65.0, 65.0), dice.uniform(-180.0, 180.0)))
        found = next(passes(satellite, EPOCH_S, EPOCH_S + DAYS * 86_400.0, LEAST_DEG), None)
        if found is None or found.aos_s is None or found.los_s is None:
            continue
        sights = [satellite.sight(found.aos_s + second) for second in range(int(found.los_s - found.aos_s) + 1)]
        rows = tuple((float(t), each.azimuth_deg, each.elevation_deg) for t, each in enumerate(sights))
        for at, (before, after) in enumerate(pairwise(rows), 1):
            if after[2] >= LOWEST_DEG and any(
                turn_deg(before[1], seam) * turn_deg(after[1], seam) < 0 and abs(turn_deg(seam, after[1])) < NEAR_DEG
                for seam in seams
            ):
                yield Crossing(Pass(f"up to {found.highest.elevation_deg:.0f}°", rows), at)
                break


def turned_back(dice: random.Random, each: Crossing) -> Pass | None:
    """The same stream up to some degrees before the seam; None: it rises nearer than that."""
    rows, before_deg = each.flown.rows, dice.uniform(*BEFORE_DEG)
    seam_deg = rows[each.at][1]
    last = next((at for at in range(each.at, -1, -1) if abs(turn_deg(rows[at][1], seam_deg)) >= before_deg), 0)
    if last < 10:
        return None
    back = rows[last::-1] if dice.random() < 0.5 else (rows[last],) * STANDS_S
    course = (*rows[: last + 1], *back)
    return Pass(each.flown.name, tuple((float(t), az, el) for t, (_, az, el) in enumerate(course)))


def integral_deg_s(trace: Sequence[Sample]) -> float:
    return SAMPLE_S * sum(one.error_deg for one in trace if one.t >= SETTLING_S and one.target_el >= 0)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("passes", type=int, nargs="?", default=PASSES)
    parser.add_argument("seed", type=int, nargs="?", default=SEED)
    parser.add_argument("--turns-back", action="store_true")
    parser.add_argument("--machines", nargs="+", choices=SEAMS, default=list(SEAMS), metavar="M")
    parser.add_argument("--via", nargs="+", choices=VIAS, default=VIAS, metavar="V")
    asked = parser.parse_args()
    for machine in asked.machines:
        dice = random.Random(asked.seed)
        drawn = crossings(dice, SEAMS[machine])
        wanted: list[Pass] = []
        while len(wanted) < asked.passes:
            one = next(drawn)
            flown = turned_back(dice, one) if asked.turns_back else one.flown
            if flown:
                wanted.append(flown)
        for via in asked.via:
            costs, aways = [], []
            for each in wanted:
                trace, _ = fly(each, plant_maker(Kind(machine, machine, via).config(), via=via))
                costs.append(integral_deg_s(trace))
                aways.append(away_s(trace))
            print(f"{machine} {via}: {mean(costs):.0f}° s, beyond 10° for {mean(aways):.1f} s", flush=True)


if __name__ == "__main__":
    main()
