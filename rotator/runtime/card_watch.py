"""Whether the card keeps what the box must not forget: it may refuse a write, or hang.

Knows the words for a person, and when to say them: at once after a refusal, after some seconds of a write that does not
return. The control thread asks in each cycle; no answer waits for the card.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from rotator.exchange.faults import Notice
from rotator.store.hanging import HANGS, Hanging, writes

UNKEPT = (
    "the box cannot keep a stop, nor what it knows of the relays and motors: {trouble}. Look for a full or read-only "
    "card; look at the relays before the Pi starts again"
)


class CardWatch:
    """`refusals`: why the card refused the last change of each file; empty where it did not."""

    def __init__(
        self, refusals: Callable[[], list[str]] = list, under_way: Callable[[], Mapping[int, Path]] = writes
    ) -> None:
        self._refusals = refusals
        self._under_way = under_way
        self._hanging: Hanging[int] = Hanging()

    def look(self, now_s: float) -> Notice | None:
        """What a person must hear of the card; None: it takes each write."""
        begun = self._under_way()
        for number in self._hanging.look(begun, now_s):
            if (path := begun.get(number)) is not None:
                return Notice(UNKEPT.format(trouble=f"{HANGS}, and {path.name} is not written"), "CARD HANGS")
        for refusal in self._refusals():
            if refusal:
                return Notice(UNKEPT.format(trouble=refusal), "CARD REFUSES")
        return None
