"""How often a satellite is taken for its neighbour in a train: `python -m benchmarks.trains [STREAMS [SEED [KNOWN]]]`.

A train is satellites of one launch on one orbit, seconds to minutes apart. The box knows one to eight of the train, but
not the one that a program sends, and KNOWN other satellites. The gaps are drawn from 1 s to 3 min, the orbits from real
ones and ones like them, the clock of the program from 5 s behind to 5 s ahead; it rounds to whole degrees or tenths, or
cuts off, and begins at the rise, up to a minute before it, or later. For each range of gaps: how many streams were
named as a neighbour.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

from benchmarks.numbers import numbers
from benchmarks.recognition import catalogue
from benchmarks.recognition_delay import UNSTEADY_S, Rise, rises
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.orbits.elements import Elements
from rotator.orbits.recognition import Recognised, StreamWatch
from rotator.orbits.satellite import Satellite
from tests.orbits.streams import whole

STREAMS, KNOWN = 200, 20
LIMITS_S = 1.0, 3.0, 5.0, 8.0, 12.0, 20.0, 60.0, 180.0
"""Of the ranges of gaps."""
HIDDEN_S = 6.0
"""Seconds that the box allows to the clock of a program, and to the age of its directions."""
MOST_KNOWN = 4
"""Neighbours before and behind that the box knows."""
LONGEST_S, EARLY_S, LATE_S = 900.0, 60.0, 300.0
DAY_S = 86_400.0
PERIODS_S = 1.0, 1.0, 1.0, 2.0, 5.0
ROUNDINGS: tuple[Callable[[float], float], ...] = (
    whole,
    math.floor,
    lambda deg: whole(deg * 10) / 10,
)


@dataclass(frozen=True, slots=True)
class Train:
    """`rise`: of the satellite that is sent. `known`: its neighbours of which the box has elements."""

    rise: Rise
    gap_s: float
    known: tuple[Elements, ...]

    @property
    def seems_off_s(self) -> float:
        """The clock error by which the stream seems to follow a known neighbour, the least of all."""
        gaps_s = (self.gap_s * number_of(each) for each in self.known)
        return min(abs(self.rise.ahead_s + gap_s) for gap_s in gaps_s)


@dataclass(frozen=True, slots=True)
class Outcome:
    """`wrong`: the stream was named as a known neighbour."""

    gap_s: float
    seems_off_s: float
    wrong: bool


def behind(elements: Elements, late_s: float, number: int) -> Elements:
    """The same orbit, flown so much later."""
    turned_deg = late_s * elements.mean_motion_rev_per_day / DAY_S * 360.0
    return replace(
        elements,
        name=f"{elements.name} {number:+d}",
        catalogue_number=700_000_000 + number,
        mean_anomaly_deg=(elements.mean_anomaly_deg - turned_deg) % 360.0,
    )


def number_of(neighbour: Elements) -> int:
    return int(neighbour.name.rsplit(" ", 1)[1])


def trains(
    dice: random.Random,
    elements: list[Elements],
    count: int,
    least_s: float = LIMITS_S[0],
    most_s: float = LIMITS_S[-1],
) -> Iterator[Train]:
    """Trains with gaps between these."""
    for rise in rises(dice, elements, count):
        gap_s = math.exp(dice.uniform(math.log(least_s), math.log(most_s)))
        before, after = dice.choice(((0, 1), (1, 0), (1, 1), (0, MOST_KNOWN), (MOST_KNOWN, MOST_KNOWN)))
        numbers = [number for number in range(-before, after + 1) if number]
        yield Train(rise, gap_s, tuple(behind(rise.elements, gap_s * number, number) for number in numbers))


def outcome(dice: random.Random, train: Train, elements: list[Elements]) -> Outcome:
    """What the box makes of a stream of the one satellite of the train that it does not know."""
    rise = train.rise
    known = [each for each in elements if each is not rise.elements] + list(train.known)
    dice.shuffle(known)
    likely = [each.name for each in dice.sample(known, 8)] if dice.random() < 0.5 else []
    watch = StreamWatch([Satellite(each, rise.site) for each in known], likely)
    truth, rounds, period_s = Satellite(rise.elements, rise.site), dice.choice(ROUNDINGS), dice.choice(PERIODS_S)
    begin_s = at_s = rise.aos_s + dice.choice(
        (dice.uniform(0, period_s), -dice.uniform(0, EARLY_S), dice.uniform(0, LATE_S))
    )
    wrong = False
    while at_s < begin_s + LONGEST_S and ((ordered := truth.sight(at_s)).elevation_deg > 0 or at_s < rise.aos_s + 1):
        aim = Aim(rounds(ordered.azimuth_deg) % 360, max(0.0, rounds(ordered.elevation_deg)))
        wrong |= isinstance(watch.hear(Source("gs232b"), aim, at_s - rise.ahead_s), Recognised)
        at_s += period_s + dice.uniform(-UNSTEADY_S, UNSTEADY_S)
    return Outcome(train.gap_s, train.seems_off_s, wrong)


def main(count: int, seed: int, known: int) -> None:
    dice = random.Random(seed)
    elements = catalogue(dice, known)
    found = [outcome(dice, each, elements) for each in trains(dice, elements, count)]
    for least_s, most_s in pairwise(LIMITS_S):
        these = [each.wrong for each in found if least_s <= each.gap_s < most_s]
        print(f"{least_s:3g} to {most_s:3g} s apart: {len(these):4} streams, {sum(these):3} named as a neighbour")
    hidden = [each for each in found if each.seems_off_s <= HIDDEN_S]
    told = [each for each in found if each.seems_off_s > HIDDEN_S]
    print(
        f"named as a neighbour: {sum(each.wrong for each in hidden)} of {len(hidden)} where an error of the program's "
        f"clock up to {HIDDEN_S:g} s explains the gap, {sum(each.wrong for each in told)} of the other {len(told)}"
    )


if __name__ == "__main__":
    main(*numbers(__doc__, streams=STREAMS, seed=15, known=KNOWN))
