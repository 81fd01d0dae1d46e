"""Whether an event loop still runs: one serves links and consoles, another the page. If it hangs, no stop arrives.

Knows times. The event loop ticks in a task of its own; the control loop asks. Does not know what a stall ends.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable

TICK_S = 0.2
LONGEST_S = 1.0
"""Without a tick for this time, in seconds, the event loop counts as stalled."""


class EventWatch:
    """`tick` belongs to the event loop's thread, `stalled` to the control thread. `clock` gives seconds."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._ticked_s: float | None = None

    async def run(self) -> None:
        """Tick until cancelled. Then the watch reports no stall: a box that ends has no event loop to watch."""
        try:
            while True:
                self.tick()
                await asyncio.sleep(TICK_S)
        finally:
            self._ticked_s = None

    def tick(self) -> None:
        self._ticked_s = self._clock()

    def stalled_s(self, now_s: float) -> float:
        """For how long the event loop has stood still, in seconds; 0: it runs, or it has not begun to tick."""
        ticked_s = self._ticked_s
        silent_s = 0.0 if ticked_s is None else now_s - ticked_s
        return silent_s if silent_s > LONGEST_S else 0.0
