"""Which source may move the antenna: latched stops, the panel's mode switch, and streams that have lost the antenna.

Knows sources and moments. Of an order it knows whether it stops, releases or moves, and where it points.
"""

from __future__ import annotations

from rotator.control.senders import PAUSE_S, Pair, Senders
from rotator.orders import Mode, Source

AGREE_DEG = 4.0
MOST_SHOWN = 4
"""So many ignored sources are named at a time, the latest first."""


class Authority:
    """Every order that would move an axis asks here first. `agree_deg`: so far apart, two directions are the same."""

    def __init__(self, mode: Mode = Mode.AUTO, agree_deg: float = AGREE_DEG) -> None:
        self.latched = ""
        """The source of a stop that only a person releases; empty: there is none."""
        self.mode = mode
        self.controlled_by: Source | None = None
        self._panel: Source | None = None
        """The panel that switched to this mode. In MANUAL and JOG it alone moves the antenna."""
        self._senders = Senders(agree_deg)
        self._ignored: dict[str, tuple[str, float]] = {}
        """By the name of a source: why its latest order had no effect, and when that was. The latest is the last."""

    def stopped(self, source: Source, now_s: float, *, latch: bool) -> None:
        """`source` stopped the antenna. Other sources that send have no effect until they pause or reconnect."""
        self._senders.stop(source, now_s)
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
        self._senders.free_all()
        self._ignored.clear()

    def switch(self, panel: Source, mode: Mode) -> None:
        """A person turns the mode switch."""
        self.mode, self._panel = mode, panel
        self.controlled_by = None

    def left(self, source: Source, now_s: float) -> bool:
        """The connection of `source` has ended. Returns whether the stream that moved the antenna ended with it."""
        streamed = source == self.controlled_by and self._senders.streams(source)
        self._senders.left(source, now_s)
        if (ignored := self._ignored.pop(str(source), None)) is not None:
            # The next connection of a program that connects for every order has another number.
            self._ignored[source.link] = ignored
        return streamed

    def may_move(self, source: Source, now_s: float, aims: Pair | None = None, *, held: str = "") -> bool:
        """Whether an order from `source` that moves an axis has an effect now. The source counts as sending.

        `aims`: where the order points; None: it is no order for a direction. When it has an effect, the streams of
        other sources that point elsewhere lose the antenna. `held`: what goes on that the order may not interrupt.
        """
        self._senders.note(source, now_s, aims)
        self._ignored.pop(str(source), None)
        if why := self._obstacle(source) or held:
            self._ignored.pop(source.link, None)
            self._ignored[str(source)] = (why, now_s)
            return False
        self._senders.take(source, now_s)
        self.controlled_by = source
        return True

    def ignored(self, now_s: float) -> tuple[str, ...]:
        """A sentence for each source whose orders have had no effect lately: which source, why, and what ends that."""
        lately = [(name, why) for name, (why, at_s) in self._ignored.items() if now_s - at_s < PAUSE_S]
        self._ignored = {name: self._ignored[name] for name, _ in lately}
        return tuple(f"orders from {name} are ignored: {why}" for name, why in reversed(lately[-MOST_SHOWN:]))

    def _obstacle(self, source: Source) -> str:
        """Why an order of `source` has no effect; empty: it has."""
        if self.latched:
            return f"stopped by {self.latched} until released"
        match self.mode:
            case Mode.AUTO:
                return self._senders.silence(source)
            case Mode.MANUAL | Mode.JOG if source == self._panel:
                # A stop that comes over a link never silences the person at the panel.
                return ""
            case mode:
                return f"the panel's switch is at {mode.name}"
