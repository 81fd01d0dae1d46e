"""Makes a drill that shows a violation smaller: fewer events and orders, a plainer box, the same judge.

Knows delta debugging: drop halves, quarters, single events, as long as what is left still shows it. Plays drills by a
function that it is given. Does not know what a violation is about.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from benchmarks.drills.accusations import Violation
from benchmarks.drills.script import PANEL, Drill

AFTER_S = 0.2
"""A drill ends this long after its violation."""

Shows = Callable[[Drill], Violation | None]
"""The violation that is looked for, if this drill shows it."""


class Shrinking:
    """`best`: the smallest drill so far, and what it shows. `left_s`: simulated seconds that may be spent; a replay
    costs the length of its drill."""

    def __init__(self, drill: Drill, violation: Violation, shows: Shows, left_s: float) -> None:
        self.best = drill.until(violation.at_s + AFTER_S), violation
        self._shows, self.left_s = shows, left_s

    def run(self) -> None:
        before = None
        while before != self.best[0]:
            before = self.best[0]
            self._drop_events()
            while any(map(self._try, _plainer(self.best[0]))):
                pass

    def _try(self, candidate: Drill) -> bool:
        self.left_s -= candidate.seconds
        if candidate == self.best[0] or self.left_s <= 0 or (found := self._shows(candidate)) is None:
            return False
        self.best = candidate.until(found.at_s + AFTER_S), found
        return True

    def _drop_events(self) -> None:
        """Many at a time at first."""
        size = max(1, len(self.best[0].events) // 2)
        while size:
            start = 0
            while start < len(events := self.best[0].events):
                if not self._try(self.best[0].with_events(events[:start] + events[start + size :])):
                    start += size
            size //= 2


def _plainer(drill: Drill) -> Iterator[Drill]:
    """The drill with a plainer box, without one table or key, or with half of the orders of one stream."""
    for key, value in drill.tables.items():
        if key == "panel" and any(event.who == PANEL for event in drill.events):
            continue  # the judges assume that the box has a panel that the script uses
        yield replace(drill, tables=_without(drill.tables, key))
        for inner in value:
            yield replace(drill, tables={**drill.tables, key: _without(value, inner)})
    yield replace(drill, commissioning="")
    for place, event in enumerate(drill.events):
        if event.what in ("stream", "flood", "arc"):
            fewer = replace(event, args=(*event.args[:-1], max(1.0, float(event.args[-1]) // 2)))
            yield drill.with_events((*drill.events[:place], fewer, *drill.events[place + 1 :]))


def _without(table: dict[str, object], key: str) -> dict[str, object]:
    return {name: value for name, value in table.items() if name != key}
