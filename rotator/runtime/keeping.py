"""Hands over what must outlive the program, each time it changes: a latched stop, vain tries, what is known of relays.

Knows the status. Does not know files: `state_thread` writes them, and the control thread never waits for that.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field

from hw.ports import Axis
from rotator.exchange.motor import Tries, Trusts
from rotator.exchange.status import Latch, Status


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
