"""Makes a drill that shows a violation as small as it can: fewer events, a plainer box, the same judge.

Knows delta debugging: drop halves, quarters, single events, as long as what is left still shows it. Plays drills by a
function that it is given. Does not know what a violation is about.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

from benchmarks.drills.accusations import Violation
from benchmarks.drills.script import PANEL, Drill, Event

AFTER_S = 0.2
"""A drill ends this long after its violation."""

Shows = Callable[[Drill], Violation | None]
"""The violation that is looked for, if this drill shows it."""
Change = Callable[[Drill], Drill]


class Budget:
    """The simulated seconds that may be spent. A replay costs the length of its drill."""

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
        before = best[0]
        _fewer(lambda: best[0], tried)
        for change in _plainer(best[0]):
            if (plainer := change(best[0])) != best[0]:
                tried(plainer)
        changed = best[0] != before
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


def _plainer(drill: Drill) -> Iterator[Change]:
    """Changes that make a drill plainer: the box without one table or key, or a stream of fewer orders."""
    for key, value in drill.tables.items():
        if key == "panel" and any(event.who == PANEL for event in drill.events):
            continue  # the judges assume that the box has a panel that the script uses
        yield partial(_without_table, key=key)
        for inner in value:
            yield partial(_without_key, key=key, inner=inner)
    yield partial(replace, commissioning="")
    for place in range(len(drill.events)):
        yield partial(_halved, place=place)


def _without_table(drill: Drill, *, key: str) -> Drill:
    return replace(drill, tables=_without(drill.tables, key))


def _without_key(drill: Drill, *, key: str, inner: str) -> Drill:
    if key not in drill.tables:
        return drill
    return replace(drill, tables=drill.tables | {key: _without(drill.tables[key], inner)})


def _halved(drill: Drill, *, place: int) -> Drill:
    """The drill with half of the orders of one stream. `place` may be beyond the end of a drill with fewer events."""
    event = drill.events[place] if place < len(drill.events) else None
    if event is None or event.what not in ("stream", "flood", "arc"):
        return drill
    fewer = replace(event, args=(*event.args[:-1], max(1.0, float(event.args[-1]) // 2)))
    return drill.with_events((*drill.events[:place], fewer, *drill.events[place + 1 :]))


def _without(table: dict[str, Any], key: str) -> dict[str, Any]:
    return {name: value for name, value in table.items() if name != key}


def _sooner(drill: Drill) -> Iterator[Drill]:
    """The drill without the quiet time before its first event."""
    if drill.events and drill.events[0].at_s > 1.0:
        by_s = drill.events[0].at_s - 1.0
        moved: tuple[Event, ...] = tuple(replace(each, at_s=round(each.at_s - by_s, 3)) for each in drill.events)
        yield replace(drill, events=moved, seconds=max(1.0, drill.seconds - by_s))
