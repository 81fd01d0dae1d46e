"""The file with the trust in the motor relays: a relay in doubt stays in doubt after a restart.

Knows the file's form, and what the end of a program leaves uncertain. Does not know how a doubt arises or ends. While
the program runs the file says that each relay may be closed, because after a crash or a power cut no more is known.
The same holds without a file, and if the card refuses writes: then the file may be older than the last run. A power cut
hides that, if the card refused before it and does not after it: the message `UNKEPT` has told a person to look.
The file is written at the start, at a proper end, and when a relay is suspected or cleared: seldom.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.exchange.motor import Trust, Trusts
from rotator.store.forms import Form
from rotator.store.spared import SparedFile

FILE_NAME = "relays.json"
"""Beside the state file."""
FORM = Form("rotator relays")
UNKNOWN: Trusts = (Trust.UNSEEN, Trust.UNSEEN)
REFUSED_EVERY = 10
"""A card that refuses is written again at each change, and without a change once in this many calls."""


def after(trusts: Trusts, *, proper: bool) -> Trusts:
    """The trust in two relays after the end of the program: after a crash less than after a proper end."""
    if proper:
        return trusts
    plus, minus = (Trust.UNSEEN if each is Trust.OPEN else each for each in trusts)
    return plus, minus


class RelaysFile:
    """Call `begin` first, then `save` now and then.

    Failures go to the log, and nothing is raised.
    """

    def __init__(self, path: Path, memory: Path | None = None) -> None:
        """`memory`: a folder that outlives the program, and not a boot; None: there is none."""
        self._file = SparedFile(path, FORM, "what is known of the relays", memory)
        self._written: dict[Axis, Trusts] = {}
        self._tried: dict[Axis, Trusts] = {}
        """The last content that the card refused."""
        self._refused = 0

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._file.trouble

    @property
    def outlives(self) -> bool:
        """Whether the present trust would survive if the program were killed now."""
        return self._file.outlives

    def begin(self) -> dict[Axis, Trusts]:
        """The trust at the begin of a run. From now on the file says that the program runs."""
        in_memory, kept = self._file.in_memory, self.load()
        self.save(kept)
        if in_memory or not self.trouble:
            return kept
        # It may have refused the run before this one too.
        return {axis: after(each, proper=False) for axis, each in kept.items()}

    def load(self) -> dict[Axis, Trusts]:
        """The trust that the last run left."""
        return self._file.load(
            _parse,
            absent=dict.fromkeys(Axis, UNKNOWN),
            damaged=dict.fromkeys(Axis, UNKNOWN),
            consequence="ignored, the axes are watched before a relay closes",
        )

    def save(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> None:
        """Write it, if it has changed. `ending`: the program ends properly, and no relay is closed any more."""
        kept = {axis: after(each, proper=ending) for axis, each in trusts.items()}
        if kept == self._written:
            return
        self._refused = self._refused + 1 if kept == self._tried else 0
        if self._refused % REFUSED_EVERY:
            return
        self._tried = kept
        if self._file.save(_content(kept)):
            self._written, self._tried = kept, {}
        else:
            self._written = {}


def _content(trusts: Mapping[Axis, Trusts]) -> dict[str, object]:
    return {"axes": {axis.value: {"plus": plus.value, "minus": minus.value} for axis, (plus, minus) in trusts.items()}}


def _parse(content: dict[str, Any]) -> dict[Axis, Trusts]:
    axes = dict(content["axes"])
    return {axis: _trusts(axes[axis.value]) if axis.value in axes else UNKNOWN for axis in Axis}


def _trusts(table: Mapping[str, Any]) -> Trusts:
    return Trust(table["plus"]), Trust(table["minus"])
