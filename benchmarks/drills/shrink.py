"""Makes a drill that shows a violation as small as it can: fewer events, a plainer box, the same judge.

Knows delta debugging: drop halves, quarters, single events, as long as what is left still shows it. Plays drills by a
function that it is given. Does not know what a violation is about.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from benchmarks.drills.judges import Violation
from benchmarks.drills.script import Drill, Event

AFTER_S = 0.2
"""A drill ends so much later than what it shows."""

Shows = Callable[[Drill], Violation | None]
"""The violation that is looked for, if this drill shows it."""


class Budget:
    """So many simulated seconds may be spent: a replay costs as much as what it plays."""

    def __init__(self, seconds: float) -> None:
        self.left_s = seconds

    def affords(self, drill: Drill) -> bool:
        self.left_s -= drill.seconds
        return self.left_s > 0


def shrink(drill: Drill, violation: Violation, shows: Shows, budget: Budget) -> tuple[Drill, Violation]:
    """The smallest drill found, and what it shows."""
    best = drill.until(violation.at_s + AFTER_S), violation

    def tried(candidate: Drill) -> bool:
        nonlocal best
        if not budget.affords(candidate):
            return False
        found = shows(candidate)
        if found is not None:
            best = candidate.until(found.at_s + AFTER_S), found
        return found is not None

    changed = True
    while changed and budget.left_s > 0:
        before = len(best[0].events), len(best[0].tables)
        _fewer(lambda: best[0], tried)
        for plainer in _plainer(best[0]):
            tried(plainer)
        changed = (len(best[0].events), len(best[0].tables)) != before
    for sooner in _sooner(best[0]):
        tried(sooner)
    return best


def _fewer(best: Callable[[], Drill], tried: Callable[[Drill], bool]) -> None:
    """Drop events, many at a time at first."""
    size = max(1, len(best().events) // 2)
    while True:
        start = 0
        while start < len(best().events):
            events = best().events
            if not tried(best().with_events(events[:start] + events[start + size :])):
                start += size
        if size == 1:
            return
        size //= 2


def _plainer(drill: Drill) -> Iterator[Drill]:
    """The same drill with less of a box, one key at a time; and with streams of fewer orders."""
    for key, value in drill.tables.items():
        rest = {name: table for name, table in drill.tables.items() if name != key}
        yield replace(drill, tables=rest)
        if isinstance(value, dict):
            for inner in value:
                yield replace(drill, tables=drill.tables | {key: _without(value, inner)})
    if drill.commissioning:
        yield replace(drill, commissioning="")
    for place, event in enumerate(drill.events):
        if event.what in ("stream", "flood") and float(event.args[-1]) > 1:
            fewer = replace(event, args=(*event.args[:-1], float(event.args[-1]) // 2))
            yield drill.with_events((*drill.events[:place], fewer, *drill.events[place + 1 :]))


def _without(table: dict[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in table.items() if name != key}


def _sooner(drill: Drill) -> Iterator[Drill]:
    """The same with the quiet before its first event cut away."""
    if drill.events and drill.events[0].at_s > 1.0:
        by_s = drill.events[0].at_s - 1.0
        moved: tuple[Event, ...] = tuple(replace(each, at_s=round(each.at_s - by_s, 3)) for each in drill.events)
        yield replace(drill, events=moved, seconds=max(1.0, drill.seconds - by_s))
