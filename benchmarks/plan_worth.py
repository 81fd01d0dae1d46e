"""The plan of many passes beside the best that is possible: `python -m benchmarks.plan_worth [CASES [SEED]]`.

Two to four short passes at random, which overlap, of satellites that are worth 1, 2 or 5; an antenna of 450° by 180°
or of 360° that goes over the top, at random azimuth. The best plan is found by trying all chains of the parts of these
passes. Prints the plan's share of its worth: the mean, and the least; `--each` prints every case.
"""

from __future__ import annotations

import argparse
import random
from statistics import mean

from rotator.tracking.planned import Followed
from tests.tracking.arcs import EPOCH_S, FULL, OVER, Arc
from tests.tracking.test_schedule_worth import PROMISED, most_worth, worth_of_plan

CASES = 50
MOUNTS = {"450 × 180": FULL, "360 × 180, over the top": OVER}


def drawn(dice: random.Random) -> list[Followed]:
    return [
        Followed(
            Arc(
                name,
                EPOCH_S + dice.uniform(30, 700),
                dice.uniform(150, 300),
                dice.uniform(0, 359),
                dice.uniform(-90, 90),
                dice.uniform(5, 85),
            ),
            dice.choice((1.0, 2.0, 5.0)),
        )
        for name in "abcd"[: dice.randint(2, 4)]
    ]


def main(cases: int, seed: int, *, each: bool) -> None:
    dice = random.Random(seed)
    shares: list[float] = []
    while len(shares) < cases:
        followed, stands_deg = drawn(dice), dice.uniform(0, 360)
        name = dice.choice(sorted(MOUNTS))
        best = most_worth(followed, MOUNTS[name], stands_deg)
        if best == 0:
            continue
        shares.append(worth_of_plan(followed, MOUNTS[name], stands_deg) / best)
        if each:
            print(f"{name:24} {len(followed)} passes: {100 * shares[-1]:6.1f} %", flush=True)
    low = sum(share < PROMISED for share in shares)
    print(
        f"{len(shares)} cases, the best plan's worth is reached to {100 * mean(shares):.1f} % in the mean, "
        f"{100 * min(shares):.1f} % at least; below {100 * PROMISED:g} %: {low}"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", type=int, nargs="?", default=CASES)
    parser.add_argument("seed", type=int, nargs="?", default=15)
    parser.add_argument("--each", action="store_true")
    asked = parser.parse_args()
    main(asked.cases, asked.seed, each=asked.each)
