"""Whose orders move the antenna: latches, and streams that a stop has silenced.

Knows sources and moments. Knows nothing of what the orders say beyond stop, release and the rest.
"""

from __future__ import annotations

from rotator.orders import Source

PAUSE_S = 10.0
"""A stream stopped from elsewhere counts as ended once it has paused this long."""


class Authority:
    """Every order that would move something is asked about here first."""

    def __init__(self) -> None:
        self.latched = ""
        """Who pressed a stop that only a person releases; empty: nobody."""
        self.controlled_by: Source | None = None
        self._last_heard_s: dict[Source, float] = {}
        self._silenced: set[Source] = set()

    def stopped(self, source: Source, now_s: float, *, latch: bool) -> None:
        """`source` said stop: whatever else is streaming stays without effect until it pauses or reconnects."""
        self._forget(now_s)
        self._silenced |= set(self._last_heard_s) - {source}
        self._silenced.discard(source)
        self.controlled_by = None
        if latch:
            self.latched = str(source)

    def take(self, source: Source, why: str) -> None:
        """A person takes the antenna for something that nobody may interrupt until released."""
        self.latched = f"{source}: {why}"
        self.controlled_by = source

    def released(self) -> None:
        """A person lets the box move again; nobody stays silenced."""
        self.latched = ""
        self._silenced.clear()

    def may_move(self, source: Source, now_s: float) -> bool:
        """Whether an order that moves, from `source` at this moment, has effect. Asking counts as being heard."""
        self._forget(now_s)
        self._last_heard_s[source] = now_s
        if self.latched or source in self._silenced:
            return False
        self.controlled_by = source
        return True

    def _forget(self, now_s: float) -> None:
        quiet = [source for source, heard_s in self._last_heard_s.items() if now_s - heard_s >= PAUSE_S]
        for source in quiet:
            del self._last_heard_s[source]
            self._silenced.discard(source)
