"""The file with the vain tries of the motors: a restart of the program, or of the Pi, does not reset their count.

Knows the file's form. A clock may jump, and a Pi without a network has none. So the file has no times, and after a
restart each try counts for its whole time again. The card is written when a fault stops a motor, when a person releases
it, and when the time is over. A running motor without visible motion yet is noted only in memory.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.faults import FaultKind
from rotator.status import NO_TRIES, Places, Tries
from rotator.store.forms import Form
from rotator.store.json_file import number
from rotator.store.spared import SparedFile

FILE_NAME = "tries.json"
"""Beside the state file."""
FORM = Form("rotator tries")
NOTHING: Mapping[Axis, Tries] = dict.fromkeys(Axis, NO_TRIES)
MOST_TRIES = 10
REFUSED_EVERY = 10
"""A card that refuses is written again at each change of its content, and without a change once in this many calls."""
WIDEST_DEG = 1000.0
"""Degrees: no rotor turns further."""


class TriesFile:
    """Call `load` first, then `save` after each change. Failures go to the log, and nothing is raised."""

    def __init__(self, path: Path, memory: Path | None = None) -> None:
        """`memory`: a folder that outlives the program, and not a boot; None: there is none."""
        self._file = SparedFile(path, FORM, "what the motors were tried for in vain", memory)
        self._written: dict[Axis, Tries] | None = None
        """The content of the card; None: not known."""
        self._refused: dict[Axis, Tries] | None = None
        self._refusals = 0
        """The last content that the card refused, and the number of calls since."""

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._file.trouble

    def load(self) -> dict[Axis, Tries]:
        """The tries that the last run left. A run without visible motion of its axis counts as a try."""
        none, damaged = dict.fromkeys(Axis, NO_TRIES), dict.fromkeys(Axis, NO_TRIES)
        on_card = not self._file.in_memory
        kept = self._file.load(_parse, absent=none, damaged=damaged, consequence="ignored, no motor counts as tried")
        if on_card and kept is not damaged:
            self._written = kept
        return {axis: replace(each, faults=each.faults + each.driven, driven=False) for axis, each in kept.items()}

    def save(self, tries: Mapping[Axis, Tries]) -> bool:
        """Write the changes. False: they would not outlive the program."""
        counted = {axis: replace(each, driven=False) for axis, each in tries.items()}
        if counted != self._written and not self._refuses(counted):
            kept = self._file.save(_content(counted))
            self._written, self._refused = (counted, None) if kept else (self._written, counted)
        if tries == self._written:
            self._file.forget_note()
        else:
            self._file.note(_content(tries))
        return self._file.outlives

    def _refuses(self, counted: dict[Axis, Tries]) -> bool:
        """Whether the card has just refused the same: a dying card is not written for each start of a motor."""
        self._refusals = self._refusals + 1 if counted == self._refused else 0
        return self._refusals % REFUSED_EVERY != 0


def _content(tries: Mapping[Axis, Tries]) -> dict[str, object]:
    return {
        "axes": {
            axis.value: {
                "faults": each.faults,
                "kind": each.kind.name if each.kind else "",
                "stood_deg": each.stood_deg,
                "stops_deg": each.stops_deg,
                "pressed": each.pressed,
                "driven": each.driven,
            }
            for axis, each in tries.items()
        }
    }


def _parse(content: dict[str, Any]) -> dict[Axis, Tries]:
    axes = dict(content["axes"])
    return {axis: _tries(axes[axis.value]) if axis.value in axes else NO_TRIES for axis in Axis}


def _tries(table: Mapping[str, Any]) -> Tries:
    pressed, driven = table["pressed"], table["driven"]
    if not isinstance(pressed, bool) or not isinstance(driven, bool):
        raise ValueError("pressed or driven is not true or false")
    return Tries(
        faults=int(number(table["faults"], "a number of tries", 0, MOST_TRIES)),
        kind=FaultKind[table["kind"]] if table["kind"] else None,
        stood_deg=_places(table["stood_deg"]),
        stops_deg=_places(table["stops_deg"]),
        pressed=pressed,
        driven=driven,
    )


def _places(values: Any) -> Places:
    plus, minus = (None if each is None else number(each, "an angle", -WIDEST_DEG, WIDEST_DEG) for each in values)
    return plus, minus
