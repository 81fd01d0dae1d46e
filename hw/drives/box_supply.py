"""The supply of both control boxes, and its relay if one is wired: whether it is on, and whether it may be on.

Knows the relay and the bar of a cut. Knows no box, chip or angle. Not safe to call from several threads: its caller
holds a lock.
"""

from __future__ import annotations

from hw.ports import OutputLines

ENABLE = "box_enable"
"""The relay of the boxes' supply. A chip starts in the middle, so a box with supply from power-on would turn there."""


class BoxSupply:
    """`relay`: the line `ENABLE`; None: no relay is wired, and the boxes always have their supply."""

    def __init__(self, relay: OutputLines | None) -> None:
        self._relay = relay
        self.on = False
        """Whether the boxes have had a step since the supply was switched on. Without a relay: since the start."""
        self.barred = False
        """The supply stays off until it is allowed again, even if aims come."""

    @property
    def wired(self) -> bool:
        return self._relay is not None

    def switch_on(self) -> None:
        """Raises HardwareError. A line that fails may have switched: the supply counts as on until it is cut."""
        self.on = True
        if self._relay:
            self._relay.set({ENABLE: True})

    def switch_off(self) -> None:
        """Only where the relay is wired. Raises HardwareError: the supply still counts as on then."""
        assert self._relay is not None
        self._relay.set({ENABLE: False})
        self.on = False
