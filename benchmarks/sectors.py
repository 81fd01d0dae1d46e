"""Whether the antenna keeps out of forbidden sectors, on any way: run `python -m benchmarks.sectors`.

Lives of orders in the random worlds of `sector_worlds`: free places, streams, passes that are known beforehand, waiting
where they will rise, jogs, parks, a panel, restarts of the program with the world going on. `--moves N`: so many in
all, over the kinds in turn, on every core; or `--worlds N` of each kind; `--seed N`, `--kind NAME`. The exit code is 1
where one was inside a sector.
"""

from __future__ import annotations

import argparse
import logging
import os
import sys
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import count, islice
from multiprocessing import get_context

from benchmarks.sector_worlds import LINK, Outcome, World
from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Mode, Park, Release, SetMode, Stop
from rotator.exchange.sources import Source

PROFILES = ("g5500", "u100", "isel", "servos", "orbit360")
OTHER, PERSON, PANEL, TRACK = Source("rotctld", 1), Source("console"), Source("panel"), Source("track")
CHAPTERS = ("reach", "reach", "reach", "stream", "known", "jog", "park", "hurry", "panel", "restart")
CHAPTERS_OF_A_LIFE = 6
AT_ONCE = 20
"""So many worlds are counted together."""


def orders(world: World) -> Iterator[None]:
    """A life of orders; each `next` is one chapter of it."""
    draw = world.random
    while True:
        chapter = draw.choice(CHAPTERS)
        world.outcome.moves[chapter] += 1
        match chapter:
            case "reach":
                world.reach(world.place())
            case "stream":
                (azimuth_deg, elevation_deg), step = world.anywhere(), (draw.uniform(-4, 4), draw.uniform(-2, 2))
                for _ in range(draw.randint(5, 60)):
                    azimuth_deg, elevation_deg = azimuth_deg + step[0], elevation_deg + step[1]
                    high_deg = min(90.0, world.mount.elevation.max_deg)
                    world.order(Aim(azimuth_deg % 360.0, min(max(elevation_deg, 0.0), high_deg)))
                    world.run(1.0)
            case "known":
                world.order(world.known_pass(), TRACK)
                world.run(draw.uniform(5.0, 200.0))
            case "jog":
                seconds = draw.choice([None, draw.uniform(0.1, 5.0)])
                world.order(Jog(draw.choice(list(Axis)), draw.choice([Direction.PLUS, Direction.MINUS]), seconds))
                world.run(draw.uniform(0.5, 40.0))
            case "park":
                world.order(Park(storm=draw.random() < 0.5), PERSON)
                world.run(draw.uniform(5.0, 60.0))
                world.order(Release(), PERSON)
            case "hurry":
                for _ in range(draw.randint(3, 20)):
                    world.order(Aim(*world.anywhere()), draw.choice([LINK, OTHER]))
                    world.run(draw.choice([0.05, 0.3, 2.0, 8.0]))
                world.order(Stop())
                world.run(1.0)
            case "panel":
                world.order(SetMode(Mode.MANUAL), PANEL)
                for _ in range(draw.randint(1, 10)):
                    world.order(Aim(*world.anywhere(), place=True), PANEL)
                    world.run(draw.uniform(0.1, 5.0))
                world.order(SetMode(Mode.AUTO), PANEL)
            case "restart":
                world.order(Aim(*world.anywhere(), place=True))
                world.run(draw.uniform(0.5, 10.0))
                world.restart()
                world.run(1.0)
        yield


def live(profile: str, seed: int, chapters: int = CHAPTERS_OF_A_LIFE) -> Outcome | None:
    """One world; None where it has no place for the antenna."""
    try:
        world = World(profile, seed)
    except LookupError:
        return None
    try:
        world.run(2.0)
        life = orders(world)
        for _ in range(chapters):
            next(life)
            if world.outcome.inside:
                break
        return world.outcome
    finally:
        world.station.close()


def lives(job: tuple[int, str]) -> tuple[str, Outcome | None]:
    seed, profile = job
    logging.disable()
    return profile, live(profile, seed)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, help="so many in all, in place of --worlds")
    parser.add_argument("--worlds", type=int, default=60, help="of each kind (60)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=PROFILES)
    asked = parser.parse_args()
    kinds = (asked.kind,) if asked.kind else PROFILES
    seeds = islice(count(asked.seed), None if asked.moves else asked.worlds)
    jobs = ((seed, kind) for seed in seeds for kind in kinds)
    outcomes: dict[str, list[Outcome]] = {kind: [] for kind in kinds}
    done = 0
    with ProcessPoolExecutor(len(os.sched_getaffinity(0)), mp_context=get_context("fork")) as pool:
        while some := list(islice(jobs, AT_ONCE)):
            for profile, outcome in pool.map(lives, some):
                if outcome is not None:
                    outcomes[profile].append(outcome)
                    done += outcome.moves.total()
            if asked.moves and done >= asked.moves:
                break
    tell(outcomes)
    sys.exit(any(each.inside for some in outcomes.values() for each in some))


def tell(outcomes: dict[str, list[Outcome]]) -> None:
    print("rotor | worlds | moves | inside a sector | free places reached | missed")
    print("--|--|--|--|--|--")
    moves: Counter[str] = Counter()
    for profile, some in outcomes.items():
        mine = sum((each.moves for each in some), Counter())
        moves += mine
        inside, missed = [each for each in some if each.inside], [each for each in some if each.missed]
        reached = sum(each.reached for each in some)
        cells = profile, len(some), mine.total(), len(inside), reached, sum(len(each.missed) for each in missed)
        print(*cells, sep=" | ")
        for each in inside:
            print(f"  seed {each.seed}: {each.inside}")
        for each in missed:
            print(f"  seed {each.seed}: {each.missed}")
    print(f"{moves.total()} moves: " + ", ".join(f"{name} {number}" for name, number in sorted(moves.items())))


if __name__ == "__main__":
    main()
