"""How often something else is taken for a satellite: `python -m benchmarks.recognition [STREAMS [SEED [SATELLITES]]]`.

Streams of whole degrees, tenths and hundredths, each second, every two or every five seconds for 40 s, begin anywhere
in the sky, twenty at each of many moments of two days: standing antennas, antennas at the horizon, sweeps, a person at
a knob, stars, and great circles as fast as satellites are. The box knows 100 satellites, and its station follows some
of them: none to twenty, drawn for each moment. Prints how many streams it has recognised; 10 000 take a minute.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

from benchmarks.numbers import numbers
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.orbits import tle
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.recognition import Recognised, StreamWatch
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import Sight
from tests.orbits import skyfield_oracle
from tests.orbits.streams import Path, great_circle

STREAMS, SATELLITES, SECONDS = 10_000, 100, 40
MOST_FOLLOWED = 20
UNKNOWN, UNKNOWN_SECONDS = 100, 120
UNKNOWN_KIND = "another satellite"
UNKNOWN_DEG = -5.0, 60.0
"""Elevations of an unknown satellite at the begin of its stream."""
PERIODS_S = 1, 1, 1, 2, 5
AT_ONCE = 20
STATION = Site(48.85, 2.35)
STAR_DPS = 360.0 / 86_164.0


class Seen(Satellite):
    """Computed once for each moment."""

    def __init__(self, elements: Elements, site: Site) -> None:
        super().__init__(elements, site)
        self._seen: dict[float, Sight] = {}

    def sight(self, utc_s: float) -> Sight:
        if utc_s not in self._seen:
            self._seen[utc_s] = super().sight(utc_s)
        return self._seen[utc_s]


def catalogue(dice: random.Random, count: int) -> list[Elements]:
    """Three real satellites; then orbits as amateurs' satellites have them, each turned at random."""
    real = [each for each in tle.read(skyfield_oracle.TLE.read_text(encoding="utf-8")) if not isinstance(each, str)]
    return real + [
        replace(
            real[number % len(real)],
            name=f"OF {number}",
            catalogue_number=900_000 + number,
            ascending_node_deg=dice.uniform(0, 360),
            mean_anomaly_deg=dice.uniform(0, 360),
            perigee_argument_deg=dice.uniform(0, 360),
            inclination_deg=dice.choice((45.0, 51.6, 64.0, 82.0, 97.0, 98.0)),
            mean_motion_rev_per_day=dice.uniform(12.5, 15.6),
        )
        for number in range(len(real), count)
    ]


def stream(dice: random.Random, from_s: float, unknown: Sequence[Satellite]) -> tuple[str, Path]:
    """Its kind, and where it points. `unknown`: satellites that the box does not know."""
    begin = Sight(dice.uniform(0, 360), math.degrees(math.asin(dice.random())), math.inf)
    low = Sight(begin.azimuth_deg, dice.uniform(0, 15), math.inf)
    course_deg = dice.uniform(0, 360)
    kinds: dict[str, Callable[[], Path]] = {
        "stands": lambda: great_circle(begin, 0.0, 0.0, from_s),
        "stands at the horizon": lambda: great_circle(Sight(begin.azimuth_deg, 0.0, math.inf), 0.0, 0.0, from_s),
        "fast as a satellite": lambda: great_circle(begin, course_deg, dice.uniform(0.05, 1.2), from_s),
        "low and slow": lambda: great_circle(low, course_deg, dice.uniform(0.03, 0.2), from_s),
        "star": lambda: great_circle(begin, course_deg, STAR_DPS, from_s),
        "sweep": lambda: sweep(begin, dice.uniform(-3, 3), from_s),
        "knob": lambda: knob(dice, begin, from_s),
    }
    low_deg, high_deg = UNKNOWN_DEG
    if up := [each for each in unknown if low_deg < each.sight(from_s).elevation_deg < high_deg]:
        kinds[UNKNOWN_KIND] = lambda: program(dice.choice(up))
    kind = dice.choice(sorted(kinds))
    return kind, kinds[kind]()


def program(satellite: Satellite) -> Path:
    """It sends elevation 0 until the satellite rises, and ends when it sets."""

    def at(utc_s: float) -> tuple[float, float]:
        seen, soon = satellite.sight(utc_s), satellite.sight(utc_s + 1)
        waits = seen.elevation_deg < 0 and soon.elevation_deg > seen.elevation_deg
        return seen.azimuth_deg, 0.0 if waits else seen.elevation_deg

    return at


def sweep(begin: Sight, speed_dps: float, from_s: float) -> Path:
    return lambda utc_s: ((begin.azimuth_deg + speed_dps * (utc_s - from_s)) % 360.0, begin.elevation_deg)


def knob(dice: random.Random, begin: Sight, from_s: float) -> Path:
    """A person turns it by a degree or some, now and then."""
    places = [(begin.azimuth_deg, begin.elevation_deg)]
    for _ in range(SECONDS):
        azimuth_deg, elevation_deg = places[-1]
        azimuth_deg += dice.choice((0, 0, 0, -3, -2, -1, 1, 2, 3))
        elevation_deg = min(90.0, max(0.0, elevation_deg + dice.choice((0, 0, 0, 0, -2, -1, 1, 2))))
        places.append((azimuth_deg % 360.0, elevation_deg))
    return lambda utc_s: places[round(utc_s - from_s)]


def is_recognised(
    watch: StreamWatch, path: Path, from_s: float, per_degree: int, period_s: int = 1, *, seconds: int = SECONDS
) -> bool:
    for second in range(0, seconds, period_s):
        azimuth_deg, elevation_deg = (round(deg * per_degree) / per_degree for deg in path(from_s + second))
        if elevation_deg < 0:
            return False
        if isinstance(
            watch.hear(Source("gs232b"), Aim(azimuth_deg % 360.0, elevation_deg), from_s + second), Recognised
        ):
            return True
    return False


def main(count: int, seed: int, satellites: int) -> None:
    dice = random.Random(seed)
    elements = catalogue(dice, satellites)
    others = [each for each in catalogue(dice, UNKNOWN) if each not in elements]
    sent, taken = Counter[str](), Counter[str]()
    for number in range(count):
        if number % AT_ONCE == 0:
            known: list[Satellite] = [Seen(each, STATION) for each in elements]
            unknown = [Seen(each, STATION) for each in others]
            from_s = elements[0].epoch_utc_s + dice.uniform(0, 2 * 86_400.0)
            followed = [each.name for each in dice.sample(elements, min(satellites, dice.randint(0, MOST_FOLLOWED)))]
        kind, path = stream(dice, from_s, unknown)
        sent[kind] += 1
        watch = StreamWatch(known, followed)
        per_degree, period_s = dice.choice((1, 1, 1, 10, 100)), dice.choice(PERIODS_S)
        seconds = UNKNOWN_SECONDS if kind == UNKNOWN_KIND else SECONDS
        taken[kind] += is_recognised(watch, path, from_s, per_degree, period_s, seconds=seconds)
    for kind in sorted(sent):
        print(f"{kind:22} {sent[kind]:6} streams, {taken[kind]} taken for a satellite")
    print(f"{'all':22} {sent.total():6} streams, {taken.total()} taken for a satellite")


if __name__ == "__main__":
    main(*numbers(__doc__, streams=STREAMS, seed=15, satellites=SATELLITES))
