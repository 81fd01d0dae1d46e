"""How far off the antenna is as a satellite passes overhead: run `python -m benchmarks.zenith [PASSES [SEED]]`.

Passes at random stations and moments that culminate at 85° to 90°, on the shipped G-5500 (450° by 180°) with flip on:
known beforehand (`--via track`), and as a stream of whole degrees to a box that knows no satellites. Errors are those
to the true satellite, the stream's those to the true path that it is rounded from. `--each` prints every pass.
"""

from __future__ import annotations

import argparse
import math
import random
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from itertools import islice

from benchmarks.recognition import catalogue
from rotator.config.load import parse
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import Pass
from rotator.rehearsal.summary import Summary

PASSES, SEED, SATELLITES = 20, 85, 30
LEAST_DEG, WORST_DEG = 85.0, 6.0
WITHIN_S = 10 * 86_400.0
CONFIG = "[azimuth]\nmax_deg = 450\n[elevation]\nmax_deg = 180\n[mount]\nflip = 'over-top'\n"


@dataclass(frozen=True, slots=True)
class Overhead:
    flown: Pass
    culmination_deg: float


def drawn(dice: random.Random, least_deg: float = LEAST_DEG) -> Iterator[Overhead]:
    """Passes at random stations, that culminate there or higher."""
    elements = catalogue(dice, SATELLITES)
    while True:
        site = Site(math.degrees(math.asin(dice.uniform(-0.9, 0.9))), dice.uniform(-180, 180))
        satellite = Satellite(dice.choice(elements), site)
        from_s = satellite.elements.epoch_utc_s
        try:
            found = next(passes(satellite, from_s, from_s + WITHIN_S, least_deg), None)
        except NotThere:
            continue
        if found is None or found.aos_s is None or found.los_s is None or found.los_s - found.aos_s > 1500:
            continue
        rows = []
        for second in range(int(found.los_s - found.aos_s) + 1):
            sight = satellite.sight(found.aos_s + second)
            rows.append((float(second), sight.azimuth_deg, sight.elevation_deg))
        yield Overhead(Pass(satellite.name, tuple(rows)), found.highest.elevation_deg)


def fly_one(each: Overhead, via: str) -> Summary:
    return fly(each.flown, plant_maker(parse(CONFIG, "benchmark"), via=via))[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("passes", type=int, nargs="?", default=PASSES)
    parser.add_argument("seed", type=int, nargs="?", default=SEED)
    parser.add_argument("--each", action="store_true")
    asked = parser.parse_args()
    wanted = list(islice(drawn(random.Random(asked.seed)), asked.passes))
    with ProcessPoolExecutor() as pool:
        for via in ("track", "gs232"):
            flown = []
            for each, summary in zip(wanted, pool.map(partial(fly_one, via=via), wanted), strict=True):
                flown.append(summary)
                if asked.each:
                    print(
                        f"{via:5} {each.flown.name:8} up to {each.culmination_deg:.1f}°: {summary.rms_deg:5.2f}° rms, "
                        f"{summary.max_deg:5.1f}° at most, {summary.relay_starts} starts",
                        flush=True,
                    )
            worst = [summary.max_deg for summary in flown]
            print(
                f"{via}: {sum(s.rms_deg for s in flown) / len(flown):.2f}° rms, worst {max(worst):.1f}°, "
                f"above {WORST_DEG:g}° on {sum(deg > WORST_DEG for deg in worst)} of {len(worst)} passes",
                flush=True,
            )


if __name__ == "__main__":
    main()
