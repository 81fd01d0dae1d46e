"""One DC motor behind an H-bridge: its direction lines, its PWM, and the dead time of a reversal.

Knows that both directions are never on together, and that a motor is off when its duty is 0 and both lines are off.
Knows no angle, no other motor and no clock: moments are arguments, in seconds.
"""

from __future__ import annotations

from typing import Protocol

from hw.ports import Direction, HardwareError, OutputLines


class Duty(Protocol):
    """An output that is on for a share of the time."""

    def duty(self, share: float) -> None:
        """0 to 1. Raises HardwareError."""


class Bridge:
    """`plus` and `minus`: the names of its direction lines. `minus` None: `plus` alone says the direction, and is
    high for clockwise or up. `dead_time_s`: the pause before a reversal.
    """

    def __init__(self, lines: OutputLines, pwm: Duty, plus: str, minus: str | None, *, dead_time_s: float) -> None:
        self._lines = lines
        self._pwm = pwm
        self._plus = plus
        self._minus = minus
        self._dead_time_s = dead_time_s
        self.last = Direction.OFF
        """Which way it was fed last; OFF: never."""
        self.on = Direction.OFF
        """Which way the motor is fed, also where a line failed and it may be; OFF: it is off."""
        self.off_s = float("-inf")
        """Since when it is off."""

    @property
    def fed(self) -> bool:
        return self.on is not Direction.OFF

    def may_turn(self, direction: Direction, now_s: float) -> bool:
        """Whether it may be fed in this direction now: a reversal waits."""
        return direction in (self.on, self.last) or now_s >= self.off_s + self._dead_time_s

    def feed(self, direction: Direction, share: float) -> None:
        """Feed it in a direction that `may_turn`. Raises HardwareError; the motor is off then, or off as far as the
        lines can be switched."""
        if self.on is not direction:
            self._pwm.duty(0.0)
            self.on = self.last = direction  # a line that fails may have switched
            forward = direction is Direction.PLUS
            levels = {self._plus: forward} if self._minus is None else {self._plus: forward, self._minus: not forward}
            self._lines.set(levels)
        self._pwm.duty(share)

    def off(self, now_s: float) -> None:
        """Duty 0 and both lines off: each is done though the other fails. Raises HardwareError."""
        if self.on is Direction.OFF:
            return
        failure: HardwareError | None = None
        try:
            self._pwm.duty(0.0)
        except HardwareError as fault:
            failure = fault
        self._lines.set({name: False for name in (self._plus, self._minus) if name is not None})
        if failure and self._minus is None:
            raise failure  # with one line only the duty stops it
        self.on, self.off_s = Direction.OFF, now_s
        if failure:
            raise failure
