"""A simulated MCP41010: a shift register behind three pins, and the wiper it sets.

Knows the edges of its pins, its frames and commands (Microchip DS11195), and two faults: a broken select line, and an
interruption of the supply. Does not know what the wiper is wired to. Not simulated: the wiper's resistance, the load on
the wiper, and the timing of the pins.
"""

from __future__ import annotations

from collections.abc import Callable

FRAME_BITS = 16
POWER_ON_STEP = 0x80
WRITE, SHUTDOWN = 0b01, 0b10


class Mcp41010:
    """The chip. It calls `before_change` before the wiper moves: the parts behind it first use the old step."""

    so = None
    """The chip has no data output."""

    def __init__(self) -> None:
        self.before_change: list[Callable[[], None]] = []
        self.deaf = False
        """Fault: its select line is broken."""
        self.frames = 0
        """Number of commands carried out."""
        self.step = POWER_ON_STEP
        self.shut_down = False
        self._cs, self._sck = True, False
        self._shifted, self._count = 0, 0

    def share(self) -> float:
        """Position of the wiper between B (0) and A (1), without a load."""
        return 0.0 if self.shut_down else self.step / 256

    def power_on(self) -> None:
        """Fault: the supply is interrupted. Afterwards the wiper is in the middle."""
        self._catch_up()
        self.step, self.shut_down = POWER_ON_STEP, False
        self._shifted, self._count = 0, 0

    def pins(self, *, cs: bool, sck: bool, si: bool) -> None:
        """Take the levels of the pins from now on."""
        cs = cs or self.deaf
        if self._cs and not cs:
            self._shifted, self._count = 0, 0
        elif not cs and sck and not self._sck:
            self._shifted = (self._shifted << 1 | si) & 0xFFFF
            self._count += 1
        elif cs and not self._cs and self._count and self._count % FRAME_BITS == 0:
            self._obey(self._shifted >> 8, self._shifted & 0xFF)
        self._cs, self._sck = cs, sck

    def _obey(self, command: int, data: int) -> None:
        if not command & 0b01:  # the second pot of another chip of the family
            return
        self._catch_up()
        match command >> 4 & 0b11:
            case 0b01:
                self.step, self.shut_down = data, False
            case 0b10:
                self.shut_down = True
            case _:
                return
        self.frames += 1

    def _catch_up(self) -> None:
        for catch_up in self.before_change:
            catch_up()
