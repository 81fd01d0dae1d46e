"""The vain tries of the motors: a restart of the program, or of the Pi, does not reset their count.

A clock may jump, and a Pi without a network has none. So there are no times, and after a restart each try counts for
its whole time again. The card is written when a fault stops a motor, when a person releases it, and when the time is
over. A running motor without visible motion yet is noted only in memory.
A place at which an axis stood is an angle, and means another place once the calibration or a limit is another one. So
the settings are kept beside it. After a change of them the count stays, and the places are forgotten.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from hw.ports import Axis
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Places, Tries
from rotator.store.json_file import number
from rotator.store.state import Content, Section, State

log = logging.getLogger(__name__)

NOTHING: Mapping[Axis, Tries] = dict.fromkeys(Axis, NO_TRIES)
NOWHERE: Places = (None, None)
MOST_TRIES = 10
WIDEST_DEG = 1000.0
"""Degrees: no rotor turns further."""

ScaleSettings = Mapping[str, object]
"""The settings of an axis that its angles depend on, in the types of JSON."""
Kept = Mapping[Axis, tuple[Tries, ScaleSettings]]


class KeptTries:
    """Call `load` first, then `note` or `save` with each change."""

    def __init__(self, state: State, settings: Mapping[Axis, ScaleSettings] | None = None) -> None:
        """`settings`: the present ones; None: they never change."""
        self.state = state
        self._settings = {axis: dict((settings or {}).get(axis, {})) for axis in Axis}
        none = self._kept(NOTHING)
        self._section: Section[Kept] = Section(
            "tries", _parse, _content, none, none, "ignored, no motor counts as tried"
        )

    def load(self) -> dict[Axis, Tries]:
        """The tries that the last run left. A run without visible motion of its axis counts as a try.

        Without its places where the axis has other settings by now.
        """
        kept = self.state.load(self._section)
        return {axis: self._for_this_run(axis, *each) for axis, each in kept.items()}

    def _for_this_run(self, axis: Axis, tries: Tries, settings: ScaleSettings) -> Tries:
        tries = replace(tries, faults=tries.faults + tries.driven, driven=False)
        if settings == self._settings[axis] or (tries.stood_deg, tries.stops_deg) == (NOWHERE, NOWHERE):
            return tries
        log.info("%s: %s has been set up anew since; the stops that it met are forgotten", self.state.path, axis.value)
        return replace(tries, stood_deg=NOWHERE, stops_deg=NOWHERE)

    def note(self, tries: Mapping[Axis, Tries]) -> None:
        """This counts from now on. Whether an axis is being driven is noted in memory alone."""
        counted = {axis: replace(each, driven=False) for axis, each in tries.items()}
        if tries != NOTHING or self._section.name in self.state.sections:
            self.state.note(self._section, self._kept(tries), lasting=self._kept(counted))

    def save(self, tries: Mapping[Axis, Tries]) -> bool:
        """Note it, and have the card take what it is to have. False: it refuses."""
        self.note(tries)
        return self.state.save()

    def _kept(self, tries: Mapping[Axis, Tries]) -> Kept:
        return {axis: (each, self._settings[axis]) for axis, each in tries.items()}


def _content(kept: Kept) -> Content:
    return {
        "axes": {
            axis.value: {
                "settings": settings,
                "faults": each.faults,
                "kind": each.kind.name if each.kind else "",
                "stood_deg": list(each.stood_deg),
                "stops_deg": list(each.stops_deg),
                "pressed": each.pressed,
                "driven": each.driven,
            }
            for axis, (each, settings) in kept.items()
        }
    }


def _parse(content: dict[str, Any]) -> Kept:
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
