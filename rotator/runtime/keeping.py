"""What must outlive the program: handed over each time it changes, and whether the card keeps it.

Knows the status: a latched stop, vain tries, what is known of relays. Knows the words for a person where a card refuses
a write, or hangs, and when to say them. Does not know files: `state_thread` writes them, and the control thread, which
asks in each cycle, never waits for that.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path

from hw.ports import Axis
from rotator.exchange.faults import Notice
from rotator.exchange.motor import Tries, Trusts
from rotator.exchange.status import Latch, Status
from rotator.store.hanging import HANGS, Hanging, writes


@dataclass(eq=False)
class Keeping:
    """`latch` gets each latched stop and each release, `tries` the runs in which a motor did not turn, `trusts` what is
    known of the relays. The control thread calls them, and they must not wait."""

    _: KW_ONLY
    latch: Callable[[Latch | None], object] = lambda _latch: None
    tries: Callable[[dict[Axis, Tries]], object] = lambda _tries: None
    trusts: Callable[[dict[Axis, Trusts]], object] = lambda _trusts: None
    _before: Status | None = field(default=None, init=False)

    def look(self, now: Status) -> None:
        """The first status tells what the run began with: that is kept already."""
        before, self._before = self._before, now
        if before is None:
            return
        if now.latch != before.latch:
            self.latch(now.latch)
        if (now.azimuth.tries, now.elevation.tries) != (before.azimuth.tries, before.elevation.tries):
            self.tries({axis: now.axis(axis).tries for axis in Axis})
        if (now.azimuth.trusts, now.elevation.trusts) != (before.azimuth.trusts, before.elevation.trusts):
            self.trusts({axis: now.axis(axis).trusts for axis in Axis})


UNKEPT = (
    "the box cannot keep a stop, nor what it knows of the relays and motors: {trouble}. Look for a full or read-only "
    "card; look at the relays before the Pi starts again"
)


class CardWatch:
    """Whether the card keeps what the box must not forget: it may refuse a write, which is said at once, or not return
    from one, which is said after some seconds.

    `refusals`: why the card refused the last change of each file; empty where it did not.
    """

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
