"""What the code achieves, beside what it achieved before: run `python -m benchmarks.scores`.

Plays simulated axes at random, from fixed seeds and from new ones: healthy ones, that nothing may doubt, and ones whose
relays weld. Injects every fault of `benchmarks.faults`, and flies the passes of `benchmarks.passes`. `--whole` plays
six times as many worlds, and looks whether the drills still see every planted bug; that takes some minutes. All of it
is simulated, and the same on every machine, but for the new seeds. `--seed` plays those of an earlier run again.
"""

from __future__ import annotations

import argparse
import logging
import random
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial

from benchmarks.drills.planted.hunt import seen
from benchmarks.drills.planted.patch import bugs
from benchmarks.faults import DRILLS, worst
from benchmarks.passes import TOLERANCES_DEG, fly_all, mean
from benchmarks.weld_world import WeldWorld

WORLDS, WHOLE = 60, 360
WORLD_S = 90.0
FIXED_SEED = 0
DOUBTS = frozenset({"relay welded", "relay not seen to open", "turning with no relay on"})

REFERENCE = {
    "healthy worlds doubted": "0",
    "welded worlds: both directions fed": "0 s",
    "welded worlds: longest turn until it is told": "2.60 s",
    "faults within their limits": "19 of 19",
    "passes at 4°": "35.3 starts, 2.04° rms, 1.101 x the optimum",
    "passes at 2°": "71.2 starts, 1.08° rms, 1.122 x the optimum",
    "passes at 1°": "149.9 starts, 0.64° rms, 1.289 x the optimum",
    "planted bugs seen": "47 of 47",
}
"""What each score was when it was first written down; of worlds, of those from seed 0."""


@dataclass(frozen=True, slots=True)
class Score:
    """`about`: a key of `REFERENCE`. `of`: the seed, where it has one."""

    about: str
    now: str
    of: str = ""

    @property
    def line(self) -> str:
        return f"| {self.about} | {self.of} | {self.now} | {REFERENCE[self.about]} |"


@dataclass(frozen=True, slots=True)
class Life:
    """What came of one world: whether a relay was doubted, and for how long the worst went on."""

    doubted: bool
    shorted_s: float
    untold_s: float


def live(seed: int, *, healthy: bool) -> Life:
    """One world of each seed; those of odd seeds are calibrated."""
    world = WeldWorld(seed, healthy=healthy, calibrated=bool(seed % 2))
    world.play(WORLD_S)
    return Life(bool(DOUBTS & world.faults), world.motor.shorted_s, world.longest_untold_s)


def worlds(pool: Executor, first_seed: int, count: int) -> Iterator[Score]:
    seeds = range(first_seed, first_seed + count)
    of = f"{count} from seed {first_seed}"
    healthy = list(pool.map(partial(live, healthy=True), seeds, chunksize=4))
    doubted = [str(seed) for seed, life in zip(seeds, healthy, strict=True) if life.doubted]
    yield Score("healthy worlds doubted", " ".join([str(len(doubted)), *(f"({each})" for each in doubted)]), of)
    welded = list(pool.map(partial(live, healthy=False), seeds, chunksize=4))
    yield Score("welded worlds: both directions fed", f"{max(life.shorted_s for life in welded):g} s", of)
    untold_s = max(life.untold_s for life in welded)
    yield Score("welded worlds: longest turn until it is told", f"{untold_s:.2f} s", of)


def faults(pool: Executor) -> Score:
    """Those that are beyond their limit are named."""
    beyond = [
        f"{drill.fault} ({drill.injected}): {took_s:.2f} s"
        for drill, took_s in zip(DRILLS, pool.map(worst, DRILLS), strict=True)
        if took_s > drill.limit_s
    ]
    return Score("faults within their limits", "; ".join([f"{len(DRILLS) - len(beyond)} of {len(DRILLS)}", *beyond]))


def passes() -> Iterator[Score]:
    for tolerance_deg in TOLERANCES_DEG:
        flights = fly_all((tolerance_deg,))
        starts, ratio = mean([float(each.starts) for each in flights]), mean([each.ratio for each in flights])
        rms_deg = mean([each.summary.rms_deg for each in flights])
        now = f"{starts:.1f} starts, {rms_deg:.2f}° rms, {ratio:.3f} x the optimum"
        yield Score(f"passes at {tolerance_deg:g}°", now)


def planted() -> Score:
    """Those that no judge of theirs sees are named."""
    known = list(bugs().values())
    unseen = [bug.name for bug, judge in seen(known) if not judge]
    return Score("planted bugs seen", "; ".join([f"{len(known) - len(unseen)} of {len(known)}", *unseen]))


def scores(seed: int, *, whole: bool) -> Iterator[Score]:
    """Each as soon as it is there."""
    count = WHOLE if whole else WORLDS
    # The log would stand among the lines of the table.
    with ProcessPoolExecutor(initializer=logging.disable) as pool:
        for first_seed in (FIXED_SEED, seed):
            yield from worlds(pool, first_seed, count)
        yield faults(pool)
    yield from passes()
    if whole:
        yield planted()


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=None, help="of the new worlds; a new one, unless it is given")
    parser.add_argument("--whole", action="store_true", help=f"{WHOLE} worlds, not {WORLDS}; and the planted bugs")
    asked = parser.parse_args(arguments)
    seed = random.SystemRandom().randrange(1, 10**6) if asked.seed is None else asked.seed
    print(f"seed {seed}\n\n| score | worlds | now | reference |\n|---|---|---|---|", flush=True)
    for score in scores(seed, whole=asked.whole):
        print(score.line, flush=True)


if __name__ == "__main__":
    main()
