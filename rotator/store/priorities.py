"""The priorities that a person has changed on the page. The configuration itself is not changed.

Knows that a change is valid only until the priority in the configuration is changed: then the configuration counts.
Does not know the use of a priority.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from rotator.store.json_file import number
from rotator.store.state import Content, Section, State

MOST, LONGEST_NAME = 100, 80
MOST_PRIORITY = 1000.0
"""Beyond it all numbers shrink by one factor, because only their ratios count."""
EQUAL_WITHIN = 1e-4
"""Two numbers this close are equal: after the shrinking and the six decimals they could be one number."""


@dataclass(frozen=True, slots=True)
class Changed:
    """`written`: the priority in the configuration at the time of the change."""

    priority: float
    written: float


Changes = Mapping[str, Changed]
"""By the name of the target."""


def _content(changes: Changes) -> Content:
    return {"changed": {name[:LONGEST_NAME]: asdict(each) for name, each in list(changes.items())[:MOST]}}


def _parse(content: dict[str, Any]) -> Changes:
    rows = content["changed"].items()
    return {str(name)[:LONGEST_NAME]: _change(row) for name, row in list(rows)[:MOST]}


def _change(row: Mapping[str, Any]) -> Changed:
    priority, written = (number(row[key], key, 0.0, MOST_PRIORITY) for key in ("priority", "written"))
    if priority <= 0:
        raise ValueError("a priority is above 0")
    return Changed(priority, written)


NONE: Changes = {}
PRIORITIES: Section[Changes] = Section(
    "priorities", _parse, _content, NONE, NONE, "ignored, the plan has the priorities of the configuration"
)


class Priorities:
    """May be used from any thread: a change replaces all priorities at once."""

    def __init__(self, state: State) -> None:
        self._state = state
        self._changed = state.load(PRIORITIES)

    def of(self, name: str, written: float) -> float:
        """The present priority of a target. `written`: its priority in the configuration."""
        changed = self._changed.get(name)
        return changed.priority if changed is not None and changed.written == written else written

    def change(self, priorities: Mapping[str, float], written: Mapping[str, float]) -> bool:
        """Use these priorities from now on. False: they could not be written, and may end with the program."""
        self._changed = {
            name: Changed(priority, written[name]) for name, priority in priorities.items() if priority != written[name]
        }
        return self._state.keep(PRIORITIES, self._changed)


def ranked(priorities: Sequence[float]) -> list[float]:
    """The priority of each place in a list that a person has ordered, from the first on. `priorities`: of all targets,
    in any order.

    The numbers keep their places in the list and only the names move, so the scale stays: 10, 5, 1 stay 10, 5, 1. Of
    two equal numbers the upper one becomes larger, so that the order counts; two that the file's six decimals would
    hardly tell apart are equal.
    """
    places = sorted(priorities)
    for index in range(1, len(places)):
        if places[index] < places[index - 1] + EQUAL_WITHIN:
            places[index] = places[index - 1] + 1.0
    shrink = MOST_PRIORITY / max(MOST_PRIORITY, *places) if places else 1.0
    return [round(each * shrink, 6) for each in reversed(places)]
