"""The file with the trust in the motor relays: a relay in doubt stays in doubt after a restart.

Knows the file's form, and what the end of a program leaves uncertain. Does not know how a doubt arises or ends. While
the program runs the file says that each relay may be closed, because after a crash or a power cut no more is known.
The same holds without a file, and if the card refuses writes: then the file may be older than the last run. A power cut
hides that, if the card refused before it and does not after it: the message `UNKEPT` has told a person to look.
A card that hangs as the program begins counts as one that refuses.
The file is written at the start, at a proper end, and when a relay is suspected or cleared: seldom.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hw.ports import Axis
from rotator.exchange.motor import Trust, Trusts
from rotator.store.forms import Form
from rotator.store.hanging import HANGS_S, within
from rotator.store.spared import SparedFile

FILE_NAME = "relays.json"
"""Beside the state file."""
FORM = Form("rotator relays")
UNKNOWN: Trusts = (Trust.UNSEEN, Trust.UNSEEN)


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
        self._saving = threading.Lock()
        """The first write may still hang when the next one comes."""

    @property
    def trouble(self) -> str:
        """Why the card refused the last change; empty: it did not."""
        return self._file.trouble

    @property
    def outlives(self) -> bool:
        """Whether the present trust would survive if the program were killed now."""
        return self._file.outlives

    def begin(self, patience_s: float = HANGS_S) -> dict[Axis, Trusts]:
        """The trust at the begin of a run. From now on the file says that the program runs.

        Waits no longer than this for the card: its write then goes on in a thread.
        """
        in_memory, kept = self._file.in_memory, self.load()
        returned = within(patience_s, lambda: self.save(kept), "relays-first")
        if in_memory or (returned and not self.trouble):
            return kept
        # The card may have refused the run before this one too.
        return {axis: after(each, proper=False) for axis, each in kept.items()}

    def load(self) -> dict[Axis, Trusts]:
        """The trust that the last run left."""
        return self._file.load(
            _parse,
            absent=dict.fromkeys(Axis, UNKNOWN),
            damaged=dict.fromkeys(Axis, UNKNOWN),
            consequence="ignored, the axes are watched before a relay closes",
        )

    def save(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> bool:
        """Write it, if it or the file has changed. `ending`: the program ends properly, and no relay is closed any
        more.

        False: the card refuses.
        """
        with self._saving:
            kept = {axis: after(each, proper=ending) for axis, each in trusts.items()}
            if kept != self._written or self._file.changed:
                self._written = kept if self._file.save(_content(kept)) else {}
            return bool(self._written)

    def spare(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> None:
        """Note it in memory, while another thread still waits for the card. May be called from any thread."""
        self._file.note(_content({axis: after(each, proper=ending) for axis, each in trusts.items()}))


def _content(trusts: Mapping[Axis, Trusts]) -> dict[str, object]:
    return {"axes": {axis.value: {"plus": plus.value, "minus": minus.value} for axis, (plus, minus) in trusts.items()}}


def _parse(content: dict[str, Any]) -> dict[Axis, Trusts]:
    axes = dict(content["axes"])
    return {axis: _trusts(axes[axis.value]) if axis.value in axes else UNKNOWN for axis in Axis}


def _trusts(table: Mapping[str, Any]) -> Trusts:
    return Trust(table["plus"]), Trust(table["minus"])
