"""Which source may move the antenna: latched stops, the panel's mode switch, and streams that a stop has silenced.

Knows sources and moments. Of an order it knows whether it stops, releases or moves.
"""

from __future__ import annotations

from rotator.orders import Mode, Source

PAUSE_S = 10.0
"""A stream that another source stopped has an effect again once it has paused for so long."""


class Authority:
    """Every order that would move an axis asks here first."""

    def __init__(self, mode: Mode = Mode.AUTO) -> None:
        self.latched = ""
        """The source of a stop that only a person releases; empty: there is none."""
        self.mode = mode
        self.controlled_by: Source | None = None
        self._panel: Source | None = None
        """The panel that switched to this mode. In MANUAL and JOG it alone moves the antenna."""
        self._last_heard_s: dict[Source, float] = {}
        self._silenced: set[Source] = set()

    def stopped(self, source: Source, now_s: float, *, latch: bool) -> None:
        """`source` stopped the antenna. Other sources that send have no effect until they pause or reconnect."""
        self._forget(now_s)
        self._silenced |= set(self._last_heard_s) - {source}
        self._silenced.discard(source)
        self.controlled_by = None
        if latch:
            self.latched = str(source)

    def take(self, source: Source, why: str) -> None:
        """A person takes the antenna; no order interrupts that until a person releases it."""
        self.latched = f"{source}: {why}"
        self.controlled_by = source

    def released(self) -> None:
        """A person lets the box move again. No source stays silenced."""
        self.latched = ""
        self._silenced.clear()

    def switch(self, panel: Source, mode: Mode) -> None:
        """A person turns the mode switch."""
        self.mode, self._panel = mode, panel
        self.controlled_by = None

    def may_move(self, source: Source, now_s: float) -> bool:
        """Whether an order from `source` that moves an axis has an effect now. The source counts as sending."""
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
                # A stop that comes over a link never silences the person at the panel.
                return source == self._panel

    def _forget(self, now_s: float) -> None:
        quiet = [source for source, heard_s in self._last_heard_s.items() if now_s - heard_s >= PAUSE_S]
        for source in quiet:
            del self._last_heard_s[source]
            self._silenced.discard(source)
