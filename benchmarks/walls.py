"""Whether anything that is ordered leads the antenna into a wall: run `python -m benchmarks.walls [ORDERS [SEED]]`.

The random worlds of `benchmarks.sectors`, half of them with trees around (`[mount] horizon`). In each the antenna is
given 40 orders: passes that are planned whole, jogs, places to wait at, parks; the next one often comes before the last
one is done. Judged by the simulated shaft and boom alone: none may be inside a sector, and when the antenna comes to
rest after an order for a place, its boom stands above the trees. A sector is a wall to every motion; trees are one only
to a place, for a beam that sweeps across them breaks nothing. `--kind NAME`: worlds of this kind alone.
"""

from __future__ import annotations

import argparse
import logging
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial

from benchmarks.sector_worlds import World
from benchmarks.sectors import PERSON, PROFILES, TRACK
from hw.ports import Axis, Direction
from rotator.config.model import Config
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import Aim, Jog, Order, Park, Release
from rotator.exchange.sources import Source

ORDERS, SEED = 10_000, 1
EACH = 40
"""Orders in one world."""
TREES = ((0.0, 25.0), (0.0, 60.0), (0.0, 10.0))
RESTS_S = 90.0
"""After so long without an order the antenna has come to rest, on any kind of rotor."""
LOW_DEG = 3.0
"""It may rest so much below the trees: its tolerance, its play and its noise."""


@dataclass
class Life:
    """What came of one world."""

    profile: str
    seed: int
    given: Counter[str] = field(default_factory=Counter)
    inside: str = ""
    low: list[str] = field(default_factory=list)
    """Places at which it came to rest below the trees."""


class Wooded(World):
    """A world with trees around, or without."""

    def _drawn(self, profile: str) -> Config:
        config = super()._drawn(profile)
        if self.random.random() < 0.5:
            return config
        azimuths_deg = sorted(self.random.sample(range(360), self.random.randint(2, 8)))
        trees = [(float(each), self.random.uniform(*self.random.choice(TREES))) for each in azimuths_deg]
        return config.model_copy(update={"mount": config.mount.model_copy(update={"horizon": trees})})

    def rests_low(self) -> str:
        """Where it stands below the trees; empty: it does not."""
        azimuth_deg, elevation_deg = self.world.antenna()
        least_deg = _least_deg(self.mount, azimuth_deg, elevation_deg)
        if least_deg - abs(elevation_deg if elevation_deg <= 90.0 else 180.0 - elevation_deg) <= LOW_DEG:
            return ""
        return f"rests at {azimuth_deg:.1f} {elevation_deg:.1f}, trees up to {least_deg:.1f}"


def _least_deg(mount: Mount, azimuth_deg: float, elevation_deg: float) -> float:
    if elevation_deg > 90.0:
        azimuth_deg += 180.0
    # A beam in the middle of a steep slope of trees may stand some degrees aside.
    return min(mount.horizon_deg(azimuth_deg + aside_deg) for aside_deg in (-5.0, 0.0, 5.0))


def live(job: tuple[str, int]) -> Life | None:
    """One world; None where it has no place for the antenna."""
    profile, seed = job
    logging.disable()
    try:
        world = Wooded(profile, seed)
    except LookupError:
        return None
    life = Life(profile, seed)
    try:
        world.run(2.0)
        for _ in range(EACH):
            _give(world, life)
            if world.outcome.inside:
                life.inside = world.outcome.inside
                break
        return life
    finally:
        world.station.close()


def _give(world: Wooded, life: Life) -> None:
    draw = world.random
    give = partial(world.order, by=Source("gs232b", draw.randint(1, 3)))
    kind = draw.choices(("plan", "jog", "place", "park"), (4, 3, 4, 1))[0]
    life.given[kind] += 1
    match kind:
        case "plan":
            world.order(world.known_pass(), TRACK)
            world.run(draw.choice([2.0, 10.0, 40.0]))
        case "jog":
            order: Order = Jog(draw.choice(list(Axis)), draw.choice([Direction.PLUS, Direction.MINUS]))
            give(order)
            world.run(draw.choice([0.2, 1.0, 5.0, 20.0]))
        case "place":
            give(Aim(*world.anywhere(), place=True))
            world.run(draw.choice([1.0, 5.0, 20.0]))
            if draw.random() < 0.1:
                world.run(RESTS_S)
                if not world.outcome.inside and _at_rest(world) and (low := world.rests_low()):
                    life.low.append(low)
        case "park":
            world.order(Park(storm=True), PERSON)
            world.run(draw.choice([1.0, 10.0]))
            world.order(Release(), PERSON)


def _at_rest(world: Wooded) -> bool:
    """It reached its place: beside a sector it stands where it may."""
    status = world.loop.status
    notices = [*status.azimuth.notices, *status.elevation.notices]
    return not (status.moving or status.faults or notices)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("orders", type=int, nargs="?", default=ORDERS)
    parser.add_argument("seed", type=int, nargs="?", default=SEED)
    parser.add_argument("--kind", choices=PROFILES)
    asked = parser.parse_args()
    profiles = (asked.kind,) if asked.kind else PROFILES
    worlds = asked.orders // EACH + 1
    jobs = [(profiles[number % len(profiles)], asked.seed + number) for number in range(worlds)]
    lives: list[Life] = []
    with ProcessPoolExecutor() as pool:
        for life in pool.map(live, jobs):
            if life is None:
                continue
            lives.append(life)
            for fault in filter(None, (life.inside, *life.low)):
                print(f"{life.profile}, seed {life.seed}: {fault}", flush=True)
    given = sum((life.given for life in lives), Counter[str]())
    kinds = ", ".join(f"{count} {kind}s" for kind, count in sorted(given.items()))
    print(f"{given.total()} orders in {len(lives)} worlds: {kinds}")
    print(f"inside a sector: {sum(bool(life.inside) for life in lives)}")
    print(f"at rest below the trees: {sum(len(life.low) for life in lives)}")


if __name__ == "__main__":
    main()
