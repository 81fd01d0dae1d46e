"""The file with the vain tries of the motors: a restart of the program, or of the Pi, does not reset their count.

Knows the file's form. A clock may jump, and a Pi without a network has none. So the file has no times, and after a
restart each try counts for its whole time again. The card is written when a fault stops a motor, when a person releases
it, and when the time is over. A running motor without visible motion yet is noted only in memory.
A place at which an axis stood is an angle, and means another place once the calibration or a limit is another one. So
the file has the settings beside it. After a change of them the count stays, and the places are forgotten.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Places, Tries
from rotator.store.forms import Form
from rotator.store.json_file import number
from rotator.store.spared import SparedFile

log = logging.getLogger(__name__)

FILE_NAME = "tries.json"
"""Beside the state file."""
FORM = Form("rotator tries")
NOTHING: Mapping[Axis, Tries] = dict.fromkeys(Axis, NO_TRIES)
NOWHERE: Places = (None, None)
MOST_TRIES = 10
REFUSED_EVERY = 10
"""What a card has refused is tried again when `save` is called with the very same, and else once in this many calls."""
WIDEST_DEG = 1000.0
"""Degrees: no rotor turns further."""

ScaleSettings = Mapping[str, object]
"""The settings of an axis that its angles depend on, in the types of JSON."""


class TriesFile:
    """Call `load` first, then `save` after each change. Failures go to the log, and nothing is raised."""

    def __init__(
        self, path: Path, memory: Path | None = None, settings: Mapping[Axis, ScaleSettings] | None = None
    ) -> None:
        """`memory`: a folder that outlives the program, and not a boot; None: there is none. `settings`: the present
        ones; None: they never change."""
        self._settings = {axis: dict((settings or {}).get(axis, {})) for axis in Axis}
        self._file = SparedFile(path, FORM, "what the motors were tried for in vain", memory)
        self._written: dict[Axis, Tries] | None = None
        """The content of the card; None: not known."""
        self._refused: dict[Axis, Tries] | None = None
        self._refusals = 0
        """The last content that the card refused, and the number of calls since."""
        self._last: dict[Axis, Tries] | None = None
        """What the last call of `save` was given."""

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._file.trouble

    def load(self) -> dict[Axis, Tries]:
        """The tries that the last run left. A run without visible motion of its axis counts as a try.

        Without its places where the axis has other settings by now.
        """
        none: dict[Axis, tuple[Tries, ScaleSettings]] = {axis: (NO_TRIES, self._settings[axis]) for axis in Axis}
        damaged = dict(none)
        on_card = not self._file.in_memory
        kept = self._file.load(_parse, absent=none, damaged=damaged, consequence="ignored, no motor counts as tried")
        if on_card and kept is not damaged:
            self._written = {axis: tries for axis, (tries, _) in kept.items()}
        return {axis: self._for_this_run(axis, *each) for axis, each in kept.items()}

    def _for_this_run(self, axis: Axis, tries: Tries, settings: ScaleSettings) -> Tries:
        tries = replace(tries, faults=tries.faults + tries.driven, driven=False)
        if settings == self._settings[axis] or (tries.stood_deg, tries.stops_deg) == (NOWHERE, NOWHERE):
            return tries
        log.info("%s: %s has been set up anew since; the stops that it met are forgotten", self._file.path, axis.value)
        return replace(tries, stood_deg=NOWHERE, stops_deg=NOWHERE)

    def save(self, tries: Mapping[Axis, Tries]) -> bool:
        """Write the changes. False: the card has not taken them; call it again after a pause, with the same."""
        counted = {axis: replace(each, driven=False) for axis, each in tries.items()}
        again, self._last = tries == self._last, dict(tries)
        different, noted = counted != self._written or self._file.changed, self._file.noted
        if different and (not self._refuses(counted) or again):
            # After a refusal it is not known what is on the card: so the next content is always written.
            noted = self._content(counted)
            kept = self._file.save(noted)
            self._written, self._refused = (counted, None) if kept else (None, counted)
        if tries == self._written:
            self._file.forget_note(noted)
        else:
            self._file.note(self._content(tries), after=noted)
        return self._written is not None

    def spare(self, tries: Mapping[Axis, Tries]) -> None:
        """Note it in memory, while another thread still waits for the card. May be called from any thread."""
        self._file.note(self._content(tries))

    def _refuses(self, counted: dict[Axis, Tries]) -> bool:
        """Whether the card has just refused the same: a dying card is not written for each start of a motor."""
        self._refusals = self._refusals + 1 if counted == self._refused else 0
        return self._refusals % REFUSED_EVERY != 0

    def _content(self, tries: Mapping[Axis, Tries]) -> dict[str, object]:
        return {
            "axes": {
                axis.value: {
                    "settings": self._settings[axis],
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


def _parse(content: dict[str, Any]) -> dict[Axis, tuple[Tries, ScaleSettings]]:
    axes = dict(content["axes"])
    return {axis: _axis(axes[axis.value]) if axis.value in axes else (NO_TRIES, {}) for axis in Axis}


def _axis(table: Mapping[str, Any]) -> tuple[Tries, ScaleSettings]:
    # An earlier version of the program wrote no settings: which they were is not known.
    return _tries(table), dict(table.get("settings", {}))


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
