"""The relay of both motors' supply, the master, if one is wired: until when it is on, and whether it may be on.

Knows that it stays on for a while after a motor, that it may be on without one to show a relay that did not open, and
that a cut bars it. Does not know which motor runs. Not safe to call from several threads: its caller holds a lock.
"""

from __future__ import annotations

from hw.ports import OutputLines

MASTER = "master"
MASTER_LINGER_S = 10.0
"""Seconds that the motors' supply stays on after the last motor stopped, so that its relay switches less often."""
NEVER_S = float("-inf")


class MotorSupply:
    """`wired`: there is such a relay. Without it the motors always have their supply."""

    def __init__(self, lines: OutputLines, *, wired: bool) -> None:
        self.wired = wired
        self.barred = False
        """The supply stays off, even if a motor is to run."""
        self.until_s: float | None = None
        """When the supply may be switched off; None: it is off."""
        self.fed_until_s = NEVER_S
        """End of the present feed, in which it is on only to show a relay that did not open. It is a lease, as for a
        motor: it ends unless it is renewed."""
        self._lines = lines

    @property
    def on(self) -> bool:
        return not self.wired or self.until_s is not None

    def for_a_motor(self, now_s: float) -> dict[str, bool]:
        """A motor starts: the level of the line, to be set in one step with the motor's relays."""
        self.linger(now_s)
        return {MASTER: True} if self.wired else {}

    def linger(self, now_s: float) -> None:
        """A motor starts or stops: stay on for a while."""
        if self.wired:
            self.until_s = now_s + MASTER_LINGER_S

    def feed(self, until_s: float) -> None:
        """Be on without a motor until then. Raises HardwareError."""
        self._lines.set({MASTER: True})
        self.fed_until_s = max(self.fed_until_s, until_s)
        self.until_s = max(self.until_s or NEVER_S, self.fed_until_s)

    def lingered(self, now_s: float) -> bool:
        """Whether the supply is on, and its time is over."""
        return self.until_s is not None and self.until_s <= now_s

    def off(self) -> None:
        """Raises HardwareError."""
        if self.wired:
            self._lines.set({MASTER: False})
        self.note_off()

    def note_off(self) -> None:
        """The supply's line has been switched off in one step with others."""
        self.until_s, self.fed_until_s = None, NEVER_S
