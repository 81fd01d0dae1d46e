"""The trust in the motor relays: a relay in doubt stays in doubt after a restart.

Knows what the end of a program leaves uncertain. Does not know how a doubt arises or ends. While the program runs the
file says that each relay may be closed, because after a crash or a power cut no more is known. The same holds without a
file, and if the card refuses writes: then the file may be older than the last run. A power cut hides that, if the card
refused before it and does not after it: the message `UNKEPT` has told a person to look.
A card that hangs as the program begins counts as one that refuses.
It changes at the start, at a proper end, and when a relay is suspected or cleared: seldom.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hw.ports import Axis
from rotator.exchange.motor import Trust, Trusts
from rotator.store.hanging import HANGS_S, within
from rotator.store.state import Content, Section, State

UNKNOWN: Trusts = (Trust.UNSEEN, Trust.UNSEEN)


def after(trusts: Trusts, *, proper: bool) -> Trusts:
    """The trust in two relays after the end of the program: after a crash less than after a proper end."""
    if proper:
        return trusts
    plus, minus = (Trust.UNSEEN if each is Trust.OPEN else each for each in trusts)
    return plus, minus


def _content(trusts: Mapping[Axis, Trusts]) -> Content:
    return {"axes": {axis.value: {"plus": plus.value, "minus": minus.value} for axis, (plus, minus) in trusts.items()}}


def _parse(content: dict[str, Any]) -> Mapping[Axis, Trusts]:
    axes = dict(content["axes"])
    return {axis: _trusts(axes[axis.value]) if axis.value in axes else UNKNOWN for axis in Axis}


def _trusts(table: Mapping[str, Any]) -> Trusts:
    return Trust(table["plus"]), Trust(table["minus"])


RELAYS: Section[Mapping[Axis, Trusts]] = Section(
    "relays",
    _parse,
    _content,
    dict.fromkeys(Axis, UNKNOWN),
    dict.fromkeys(Axis, UNKNOWN),
    "ignored, the axes are watched before a relay closes",
)


class KeptRelays:
    """Call `begin` first, then `note` or `save` with each change."""

    def __init__(self, state: State) -> None:
        self.state = state

    def begin(self, patience_s: float = HANGS_S) -> Mapping[Axis, Trusts]:
        """The trust at the begin of a run. From now on the file says that the program runs.

        Waits no longer than this for the card: its write then goes on in a thread.
        """
        kept = self.load()
        self.note(kept)
        returned = within(patience_s, self.state.save, "state-first")
        if self.state.in_memory or (returned and not self.state.trouble):
            return kept
        # The card may have refused the run before this one too.
        return {axis: after(each, proper=False) for axis, each in kept.items()}

    def load(self) -> Mapping[Axis, Trusts]:
        """The trust that the last run left."""
        return self.state.load(RELAYS)

    def note(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> None:
        """This is known from now on. `ending`: the program ends properly, and no relay is closed any more."""
        self.state.note(RELAYS, {axis: after(each, proper=ending) for axis, each in trusts.items()})

    def save(self, trusts: Mapping[Axis, Trusts], *, ending: bool = False) -> bool:
        """Note it, and have the card take it. False: it refuses."""
        self.note(trusts, ending=ending)
        return self.state.save()
