"""The file with what is known of the motor relays: a relay in doubt stays in doubt over a restart.

Knows the file's form, and what the end of a program leaves uncertain. Does not know how a doubt arises or ends. While
the program runs the file says that each relay may be closed: after a crash or a power cut that is all that is known.
The file is written at the start, at a proper end, and when a relay is suspected or cleared: seldom.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.status import ALL_OPEN, Trust, Trusts
from rotator.store.forms import Form
from rotator.store.json_file import JsonFile

FILE_NAME = "relays.json"
"""Beside the state file."""
FORM = Form("rotator relays")
UNKNOWN: Trusts = (Trust.UNSEEN, Trust.UNSEEN)


def after(trusts: Trusts, *, proper: bool) -> Trusts:
    """What may be believed of two relays once the program has ended: after a crash less than after a proper end."""
    if proper:
        return trusts
    plus, minus = (Trust.UNSEEN if each is Trust.OPEN else each for each in trusts)
    return plus, minus


class RelaysFile:
    """Call `load` first, then `save` now and then.

    Failures go to the log, and nothing is raised.
    """

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORM, "what is known of the relays")
        self._written: dict[Axis, Trusts] = {}

    def load(self) -> dict[Axis, Trusts]:
        """What the last run of the program left; without a file no relay has ever been closed."""
        return self._file.load(
            _parse,
            absent=dict.fromkeys(Axis, ALL_OPEN),
            damaged=dict.fromkeys(Axis, UNKNOWN),
            consequence="ignored, the axes are watched before a relay closes",
        )

    def save(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> None:
        """Write it, if it has changed. `ending`: the program ends properly, and no relay is closed any more."""
        kept = {axis: after(each, proper=ending) for axis, each in trusts.items()}
        if kept != self._written and self._file.save(_content(kept)):
            self._written = kept


def _content(trusts: Mapping[Axis, Trusts]) -> dict[str, object]:
    return {"axes": {axis.value: {"plus": plus.value, "minus": minus.value} for axis, (plus, minus) in trusts.items()}}


def _parse(content: dict[str, Any]) -> dict[Axis, Trusts]:
    axes = dict(content["axes"])
    return {axis: _trusts(axes[axis.value]) if axis.value in axes else ALL_OPEN for axis in Axis}


def _trusts(table: Mapping[str, Any]) -> Trusts:
    return Trust(table["plus"]), Trust(table["minus"])
