"""The file of the priorities that a person has changed on the page. The configuration itself is not changed.

Knows that a change is valid only until the priority in the configuration is changed: then the configuration counts.
Does not know the use of a priority.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rotator.store import json_file
from rotator.store.forms import Form
from rotator.store.json_file import JsonFile, number

FORM = Form("rotator priorities")
FILE_NAME = "priorities.json"
MOST, LONGEST_NAME = 100, 80
MOST_PRIORITY = 1000.0


@dataclass(frozen=True, slots=True)
class Changed:
    """`written`: the priority in the configuration at the time of the change."""

    priority: float
    written: float


def decode(text: str) -> Mapping[str, Changed]:
    """The changes in the text of a file. Raises ValueError where the text is damaged or another file's."""
    return json_file.decode(FORM, text, _changes)


class Priorities:
    """May be used from any thread: a change replaces all priorities at once. Failures to write go to the log."""

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORM, "the order of the plan")
        nothing: Mapping[str, Changed] = {}
        without = "the plan has the priorities of the configuration"
        self._changed = self._file.load(_changes, absent=nothing, damaged=nothing, consequence=without)

    def of(self, name: str, written: float) -> float:
        """The present priority of a target. `written`: its priority in the configuration."""
        changed = self._changed.get(name)
        return changed.priority if changed is not None and changed.written == written else written

    def change(self, priorities: Mapping[str, float], written: Mapping[str, float]) -> bool:
        """Use these priorities from now on. False: they could not be written, and end with the program."""
        self._changed = {
            name: Changed(priority, written[name]) for name, priority in priorities.items() if priority != written[name]
        }
        return self._file.save({"changed": {name: asdict(each) for name, each in self._changed.items()}})


def _changes(content: dict[str, Any]) -> Mapping[str, Changed]:
    rows = content["changed"].items()
    return {str(name)[:LONGEST_NAME]: _change(row) for name, row in list(rows)[:MOST]}


def _change(row: Mapping[str, Any]) -> Changed:
    priority, written = (number(row[key], key, 0.0, MOST_PRIORITY) for key in ("priority", "written"))
    if priority <= 0:
        raise ValueError("a priority is above 0")
    return Changed(priority, written)
