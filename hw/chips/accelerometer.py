"""What the accelerometers share: a chip that is set up before its first result, and anew after each failure.

Knows no register, and not how the board is mounted.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.ports import BoardAxes, HardwareError, I2CBus


class AccelerometerChip:
    """One chip as a `hw.ports.Accelerometer`. `sleep` waits while it wakes up."""

    def __init__(self, name: str, bus: I2CBus, sleep: Callable[[float], None], address: int) -> None:
        self.name = f"{name} at 0x{address:02x}"
        self._bus = bus
        self._sleep = sleep
        self._address = address
        self._measures = False

    def restart(self) -> None:
        self._measures = False

    def gravity_g(self) -> BoardAxes:
        try:
            if not self._measures:
                self._begin()
                self._measures = True
            return self._result()
        except HardwareError:
            self._measures = False
            raise

    def _begin(self) -> None:
        """Set it up. Raises HardwareError."""
        raise NotImplementedError

    def _result(self) -> BoardAxes:
        """Its latest result in g, all of one moment. Raises HardwareError."""
        raise NotImplementedError
