"""A latched stop or a storm park: after a restart of the program or the Pi it still holds.

Knows that a damaged file means a stop: the box cannot know that there was none. Changed only when a stop begins or
ends, because each write wears the card. Does not know who may stop or release the antenna.
"""

from __future__ import annotations

from typing import Any

from rotator.exchange.status import Latch
from rotator.store.state import Content, Section, State

BEFORE = " before the restart"
LONGEST_NAME = 200
DAMAGED = Latch("the damaged state file")
"""The box gives this as the sender of the stop when it cannot read what was kept."""


def _content(latch: Latch | None) -> Content:
    return {"by": latch.by if latch else "", "storm": latch is not None and latch.storm}


def _parse(content: dict[str, Any]) -> Latch | None:
    by, storm = content["by"], content["storm"]
    if not isinstance(by, str) or len(by) > LONGEST_NAME or not by.isprintable():
        raise ValueError("by is no name of a sender")
    if not isinstance(storm, bool) or (storm and not by):
        raise ValueError("storm is not true or false, or names no sender")
    return Latch(by, storm=storm) if by else None


LATCH: Section[Latch | None] = Section(
    "latch", _parse, _content, None, DAMAGED, "it may have kept a stop: nothing moves until resume"
)


class KeptLatch:
    """Call `load` first, then `note` or `save` with each change."""

    def __init__(self, state: State) -> None:
        self.state = state
        self._noted: Latch | None = None

    def load(self) -> Latch | None:
        """The stop that the last run left, in words for the new run; None: no stop."""
        latch = self._noted = self.state.load(LATCH)
        if latch is None or latch is DAMAGED:
            return latch
        return Latch(latch.by.removesuffix(BEFORE) + BEFORE, storm=latch.storm)

    def note(self, latch: Latch | None) -> None:
        """This is in force from now on. A repeated stop is the same stop."""
        if self._noted is DAMAGED or _kind(latch) != _kind(self._noted):
            self.state.note(LATCH, latch)
            self._noted = latch

    def save(self, latch: Latch | None) -> bool:
        """Note it, and have the card take it. False: it refuses."""
        self.note(latch)
        return self.state.save()


def _kind(latch: Latch | None) -> bool | None:
    return None if latch is None else latch.storm
