"""Whose orders move the antenna: latches, a panel's mode switch, and streams that a stop has silenced.

Knows sources and moments. Knows nothing of what the orders say beyond stop, release and the rest.
"""

from __future__ import annotations

from rotator.orders import Mode, Source

PAUSE_S = 10.0
"""A stream stopped from elsewhere counts as ended once it has paused this long."""


class Authority:
    """Every order that would move something is asked about here first."""

    def __init__(self, mode: Mode = Mode.AUTO) -> None:
        self.latched = ""
        """Who pressed a stop that only a person releases; empty: nobody."""
        self.mode = mode
        self.controlled_by: Source | None = None
        self._panel: Source | None = None
        """Who switched to this mode: in MANUAL and JOG the only one who moves the antenna."""
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

    def switch(self, panel: Source, mode: Mode) -> None:
        """A person turns the mode switch."""
        self.mode, self._panel = mode, panel
        self.controlled_by = None

    def may_move(self, source: Source, now_s: float) -> bool:
        """Whether an order that moves, from `source` at this moment, has effect. Asking counts as being heard."""
        self._forget(now_s)
        self._last_heard_s[source] = now_s
        if self.latched or not self._in_mode(source):
            return False
        self.controlled_by = source
        return True

    def _in_mode(self, source: Source) -> bool:
        match self.mode:
            case Mode.AUTO:
                return source not in self._silenced
            case Mode.PARK:
                return False
            case Mode.MANUAL | Mode.JOG:
                # Whoever stands at the panel is never silenced by a stop that comes over a link.
                return source == self._panel

    def _forget(self, now_s: float) -> None:
        quiet = [source for source, heard_s in self._last_heard_s.items() if now_s - heard_s >= PAUSE_S]
        for source in quiet:
            del self._last_heard_s[source]
            self._silenced.discard(source)
