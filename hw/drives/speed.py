"""The speed input of one motor: an output whose voltage says how fast the motor turns while a relay feeds it.

Knows the output's level at the lowest speed and at full speed, that it is at the lowest whenever the motor is off, and
that each order expires. Does not know the relays: these alone stop the motor, whatever the voltage is.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.drives.bridge import Duty
from hw.ports import AngleSensor, HardwareError

REFRESH_S = 1.0
"""An unchanged level is written again after this time: a chip that had no supply for a moment has lost it."""


class SpeedOutput:
    """`lowest` and `full`: the output's share, from 0 to 1, at the lowest speed and at full speed; it begins, and ends,
    at the lowest. `slowest`: the lowest speed as a share of full speed. `clock` gives seconds. Raises HardwareError.

    `want` never waits. `write` may, on a bus that hangs: the thread that reads the sensors calls it, so that a motor
    whose speed cannot be set any more is also one without readings, and is stopped.
    """

    def __init__(self, output: Duty, lowest: float, full: float, slowest: float, clock: Callable[[], float]) -> None:
        self._output = output
        self._lowest = lowest
        self._full = full
        self._slowest = slowest
        self._clock = clock
        self._wanted = 0.0, -REFRESH_S
        """The speed as a share of full speed, and until when."""
        self._level: float | None = None
        """What the output has; None: nobody knows."""
        self._written_s = -REFRESH_S
        self.failure: str | None = None
        """Why the output could not be set; None: it is as wanted."""
        self._output.duty(lowest)

    def want(self, pace: float, until_s: float) -> None:
        """This share of full speed, until that moment at the latest; then the lowest."""
        self._wanted = pace, until_s

    def write(self) -> None:
        """Set the output as it is wanted now. Raises nothing: `failure` tells."""
        now_s, (pace, until_s) = self._clock(), self._wanted
        share = (pace - self._slowest) / (1.0 - self._slowest) if now_s < until_s else 0.0
        level = self._lowest + (self._full - self._lowest) * min(max(share, 0.0), 1.0)
        if level == self._level and now_s < self._written_s + REFRESH_S:
            return
        self._level = None
        try:
            self._output.duty(level)
        except HardwareError as fault:
            self.failure = str(fault)
        else:
            self._level, self._written_s, self.failure = level, now_s, None

    def close(self) -> None:
        """To its lowest. The output keeps that after the program has ended. Raises HardwareError."""
        self._wanted = 0.0, -REFRESH_S
        self._output.duty(self._lowest)


class Paced:
    """The sensor of an axis with a speed output: whoever reads it has written the speed."""

    def __init__(self, sensor: AngleSensor, speed: SpeedOutput) -> None:
        self.source = sensor.source
        self._sensor = sensor
        self._speed = speed

    def read(self) -> float:
        self._speed.write()
        return self._sensor.read()
