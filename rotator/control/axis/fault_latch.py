"""The fault that stops one axis: which one is kept, and when it ends.

Knows what is wrong now and what was wrong first. Does not know how a fault is found, nor how a motor is stopped.
"""

from __future__ import annotations

from rotator.faults import Fault


class FaultLatch:
    """Keeps the first fault until it is acknowledged; one that only cutting the supply ends replaces any other."""

    def __init__(self) -> None:
        self.fault: Fault | None = None
        self._cause: Fault | None = None
        """What acknowledging does not end, because it is there now."""

    def note(self, found: Fault | None, *, cause: Fault | None) -> bool:
        """What is wrong at this moment, and as much of it as acknowledging would not end. Returns whether it is new."""
        self._cause = cause
        if self.fault and self.fault.passing:
            self.fault = found
        return self.fail(found)

    def fail(self, fault: Fault | None) -> bool:
        """Keep this fault, if there is none yet or only this one asks for the supply to be cut. Returns whether."""
        if fault is None or (self.fault is not None and (self.fault.cut or not fault.cut)):
            return False
        self.fault = fault
        return True

    def acknowledge(self) -> None:
        """End the fault. While its cause is there, it comes back at once."""
        self.fault = self._cause
