"""How soon a satellite is recognised: `python -m benchmarks.recognition_delay [PASSES [SEED [SATELLITES]]]`.

Passes of satellites drawn at random over stations drawn at random, sent in whole degrees by a program whose clock is up
to 5 s off. The station uses eight of the satellites that the box knows, and the one that is sent is among these, or it
is not. Rounded, and cut off. The stream begins at the rise; or it begins a minute before, at the horizon, with the
satellite's azimuth or with that of its rise. Moments count from the rise as the program sees it. Or the stream begins
in the middle of the pass, and moments count from its first order.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from benchmarks.numbers import numbers
from benchmarks.recognition import SATELLITES, catalogue
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.orbits.earth import Site
from rotator.orbits.elements import Elements
from rotator.orbits.passes import passes
from rotator.orbits.recognition import Recognised, StreamWatch
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from tests.orbits.streams import whole

PASSES, USED = 200, 8
CLOCK_S = 5.0
UNSTEADY_S = 0.05
LEAST_DEG, DAYS = 5.0, 8.0
LONGEST_S = 120.0
EARLY_S = 60.0
LATE_S = 10.0
ROUNDINGS: dict[str, Callable[[float], int]] = {"rounded": lambda deg: int(whole(deg)), "cut off": math.floor}


@dataclass(frozen=True, slots=True)
class Rise:
    """A pass that begins at `aos_s`; the program sees it `ahead_s` earlier, and sends its first order within a
    period after that."""

    elements: Elements
    site: Site
    aos_s: float
    los_s: float
    ahead_s: float


def rises(dice: random.Random, elements: list[Elements], count: int) -> list[Rise]:
    found: list[Rise] = []
    while len(found) < count:
        site = Site(math.degrees(math.asin(dice.uniform(-0.95, 0.95))), dice.uniform(-180, 180), dice.uniform(0, 1500))
        each = dice.choice(elements)
        from_s = each.epoch_utc_s + dice.uniform(0, DAYS * 86_400.0)
        try:
            one = next(passes(Satellite(each, site), from_s, from_s + 86_400.0, LEAST_DEG), None)
        except NotThere:
            continue
        if one is not None and one.aos_s is not None and one.los_s is not None and one.aos_s > from_s:
            found.append(Rise(each, site, one.aos_s, one.los_s, dice.uniform(-CLOCK_S, CLOCK_S)))
    return found


@dataclass(frozen=True, slots=True)
class Program:
    """How it rounds, and how often and from when on it sends. `waits`: before the rise it sends the rise's azimuth.
    `joins`: it begins after this share of the pass."""

    rounds: Callable[[float], int]
    period_s: float = 1.0
    early_s: float = 0.0
    waits: bool = False
    joins: float = 0.0

    def order(self, truth: Satellite, aos_s: float, at_s: float) -> Aim:
        seen = truth.sight(max(at_s, aos_s) if self.waits else at_s)
        return Aim(self.rounds(seen.azimuth_deg) % 360, max(0, self.rounds(seen.elevation_deg)))


def recognised_after_s(rise: Rise, watch: StreamWatch, program: Program, dice: random.Random) -> tuple[str, float]:
    """The name that is recognised, and the seconds since the program has seen the rise, or since its first order in the
    middle; empty and infinite: none."""
    truth = Satellite(rise.elements, rise.site)
    since_s = rise.aos_s + program.joins * (rise.los_s - rise.aos_s)
    at_s = since_s - program.early_s + dice.uniform(0.0, program.period_s)
    while at_s < min(since_s + LONGEST_S, rise.los_s):
        aim = program.order(truth, rise.aos_s, at_s)
        if isinstance(news := watch.hear(Source("gs232b"), aim, at_s - rise.ahead_s), Recognised):
            return news.satellite.name, at_s - since_s
        at_s += program.period_s + dice.uniform(-UNSTEADY_S, UNSTEADY_S)
    return "", math.inf


def used(rise: Rise, elements: list[Elements], dice: random.Random) -> list[str]:
    """Those that the station uses, the one that is sent among them."""
    names = [rise.elements.name, *(each.name for each in dice.sample(elements, USED - 1))]
    dice.shuffle(names)
    return names


def programs() -> Iterator[tuple[str, Program]]:
    for period_s in (1.0, 2.0, 5.0):
        for rounding, rounds in ROUNDINGS.items():
            yield f"every {period_s:g} s, {rounding}", Program(rounds, period_s)
    for waits in (False, True):
        for rounding, rounds in ROUNDINGS.items():
            described = f"{EARLY_S:g} s early, {'azimuth of the rise' if waits else 'its azimuth'}, {rounding}"
            yield described, Program(rounds, early_s=EARLY_S, waits=waits)
    for joins in (0.3, 0.6):
        for rounding, rounds in ROUNDINGS.items():
            yield f"joins after {joins:.0%} of the pass, {rounding}", Program(rounds, joins=joins)


def main(count: int, seed: int, satellites: int) -> None:
    dice = random.Random(seed)
    elements = catalogue(dice, satellites)
    found = rises(dice, elements, count)
    for described, program in programs():
        for among in (True, False):
            after_s, wrong = [], 0
            for rise in found:
                known = [Satellite(each, rise.site) for each in elements]
                watch = StreamWatch(known, used(rise, elements, dice) if among else ())
                name, late_s = recognised_after_s(rise, watch, program, dice)
                wrong += name not in ("", rise.elements.name)
                after_s.append(late_s)
            after_s.sort()
            print(
                f"{described}, {'used' if among else 'not used'}: "
                f"median {after_s[count // 2]:4.1f} s, 90 % within {after_s[count * 9 // 10]:4.1f} s, "
                f"worst {after_s[-1]:4.1f} s; {sum(each > LATE_S for each in after_s)} of {count} "
                f"after {LATE_S:g} s; {wrong} wrong"
            )


if __name__ == "__main__":
    main(*numbers(__doc__, passes=PASSES, seed=15, satellites=SATELLITES))
