"""A campaign: drills drawn from a seed until their hours are full, played on every core, and their violations.

Knows seeds, hours and processes. Does not know the parts of a drill.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import get_context

from benchmarks.drills.accusations import TABLE, Violation
from benchmarks.drills.boxes import KINDS
from benchmarks.drills.draw import BESIDE, draw
from benchmarks.drills.play import FAILS, play
from benchmarks.drills.script import Drill
from benchmarks.drills.shrink import Shrinking
from rotator.config.load import ConfigError

HOUR_S = 3600.0
SHRINK_S = 3600.0
"""Simulated seconds spent on making one counterexample small."""


@dataclass(frozen=True, slots=True)
class Found:
    """A violation, and the smallest drill that shows it."""

    violation: Violation
    drill: Drill

    @property
    def seed(self) -> str:
        return self.drill.seed


@dataclass(slots=True)
class Tally:
    """The drills of one kind of rotor: their number, their hours and what they showed."""

    drills: int = 0
    hours: float = 0.0
    cpu_s: float = 0.0
    by_judge: dict[str, int] = field(default_factory=lambda: dict.fromkeys((*TABLE, FAILS), 0))


def shows(wanted: Violation, drill: Drill) -> Violation | None:
    """The same violation in this drill, or None. An exception must be the same one. A box that cannot be built shows
    nothing."""
    try:
        alike = [each for each in play(drill).violations if each.judge == wanted.judge]
    except ConfigError:
        return None
    return next((each for each in alike if wanted.judge != FAILS or each.measured == wanted.measured), None)


def seeds(seed: int, hours: float, kind: str = "", *, beside_sectors: bool = False) -> Iterator[tuple[str, str]]:
    """The seed and the kind of each drill until they fill `hours`; the kinds take turns."""
    kinds = [kind] if kind else list(KINDS)
    filled_s, number = 0.0, 0
    while filled_s < hours * HOUR_S:
        mine = kinds[number % len(kinds)]
        each = f"{seed}.{number}{BESIDE if beside_sectors else ''}"
        filled_s += draw(each, mine).seconds
        yield each, mine
        number += 1


def try_one(job: tuple[str, str], *, small: bool = True) -> tuple[str, float, float, list[Found]]:
    """Draw and play one drill. Returns its kind, its hours, its CPU seconds and its finds. `small`: made small."""
    seed, kind = job
    began_s = time.process_time()
    drill = draw(seed, kind)
    found = play(drill).violations
    cpu_s = time.process_time() - began_s
    kept = [small_one(drill, violation) if small else Found(violation, drill) for violation in found[:1]]
    return kind, drill.seconds / HOUR_S, cpu_s, kept


def small_one(drill: Drill, violation: Violation) -> Found:
    shrinking = Shrinking(drill, violation, lambda each: shows(violation, each), SHRINK_S)
    shrinking.run()
    least, shown = shrinking.best
    return Found(shown, least)


def run(
    drills: Iterator[tuple[str, str]], *, first: bool = False, tell: Callable[[Found], None] = lambda _found: None
) -> tuple[dict[str, Tally], list[Found]]:
    """A whole campaign, on the cores that it may use. `first`: it ends at the first violation, which stays as it is.

    `tell`: of each find at once, for a campaign may take hours.
    """
    tallies: dict[str, Tally] = {}
    everything: list[Found] = []
    with ProcessPoolExecutor(len(os.sched_getaffinity(0)), mp_context=get_context("fork")) as pool:
        for kind_of, hours_of, cpu_s, found in pool.map(partial(try_one, small=not first), drills):
            tally = tallies.setdefault(kind_of, Tally())
            tally.drills += 1
            tally.hours += hours_of
            tally.cpu_s += cpu_s
            for each in found:
                tally.by_judge[each.violation.judge] += 1
                tell(each)
            everything += found
            if first and found:
                pool.shutdown(wait=False, cancel_futures=True)
                break
    return tallies, everything
