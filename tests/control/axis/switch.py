"""The relays of one axis by hand: each change of them reaches the watch as `SwitchedAxis` hands it on.

Knows the relays. Judges nothing.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayState


class Switch:
    def __init__(self, note_relays: Callable[[RelayState], None]) -> None:
        self._note_relays = note_relays
        self.relays = RelayState()

    def to(self, now_s: float, way: Direction) -> None:
        was, self.relays = self.relays, self.relays.changed(now_s, way)
        if self.relays != was:
            self._note_relays(self.relays)
