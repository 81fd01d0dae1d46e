"""How far off the antenna is as a satellite passes overhead: run `python -m benchmarks.zenith [PASSES [SEED]]`.

Passes at random stations and moments that culminate at 85° to 90°, on the shipped G-5500 (450° by 180°) with flip on:
known beforehand (`--via track`), and as a stream of whole degrees to a box that knows no satellites. Errors are those
to the true satellite, the stream's those to the true path that it is rounded from.
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from itertools import islice

from benchmarks.numbers import numbers
from benchmarks.recognition import catalogue
from rotator.config.load import parse
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.rehearsal.flight import Summary, fly, plant_maker
from rotator.rehearsal.passes import Pass

PASSES, SEED, SATELLITES = 20, 85, 30
LEAST_DEG, WORST_DEG = 85.0, 6.0
WITHIN_S = 10 * 86_400.0
CONFIG = "[azimuth]\nmax_deg = 450\n[elevation]\nmax_deg = 180\n[mount]\nflip = 'over-top'\n"


def drawn(dice: random.Random, least_deg: float = LEAST_DEG) -> Iterator[Pass]:
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
        yield Pass(satellite.name, tuple(rows))


def fly_one(flown: Pass, via: str) -> Summary:
    return fly(flown, plant_maker(parse(CONFIG, "benchmark"), via=via))[1]


def main(count: int, seed: int) -> None:
    wanted = list(islice(drawn(random.Random(seed)), count))
    with ProcessPoolExecutor() as pool:
        for via in ("track", "gs232"):
            flown = list(pool.map(partial(fly_one, via=via), wanted))
            worst = [summary.max_deg for summary in flown]
            print(
                f"{via}: {sum(s.rms_deg for s in flown) / len(flown):.2f}° rms, worst {max(worst):.1f}°, "
                f"above {WORST_DEG:g}° on {sum(deg > WORST_DEG for deg in worst)} of {len(worst)} passes",
                flush=True,
            )


if __name__ == "__main__":
    main(*numbers(__doc__, passes=PASSES, seed=SEED))
