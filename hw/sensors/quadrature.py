"""The angle of an axis by counting the edges of a quadrature encoder: two channels, a quarter of a period apart. Or of
one hall channel, which says how far, and not which way: that the drive says.

Knows the order in which the channels change, and that an edge was lost where both have changed at once. Does not know
where the axis stands when the program starts: `place` says it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Protocol

from hw.ports import AngleSource, Direction

TURN = {(0, 0): 0, (1, 0): 1, (1, 1): 2, (0, 1): 3}
"""Where in its period the encoder is, by both channels: A leads on the way clockwise or up."""
RESTS_S = 0.7
"""An axis stands when its motor has been off for so long and the encoder has not counted since."""


class Channels(Protocol):
    """Two lines whose changes the kernel records in their order."""

    def levels(self) -> tuple[int, ...]:
        """A and B now, or A alone. Raises HardwareError."""

    def changes(self) -> list[tuple[int, int, int]]:
        """Since the last call: the channel (0: A, 1: B), its level, and how many changes before were not recorded.
        Never waits. Raises HardwareError."""


class EncoderCounter:
    """One axis as a `hw.ports.AngleSensor`, in degrees, by whatever counts. Safe to call from any thread.

    `counts_per_deg`: four counts a period; negative: B leads. `fed` says how the motor is fed, and since when it is
    off; `clock` gives seconds.
    """

    source = AngleSource.COUNTED
    # What `rotator.rotors.counted` asks of a cam's contact, and an encoder has not.
    turning = quiet = in_closure = closed = False
    ahead: frozenset[Direction] = frozenset()
    travelled_deg, error_deg, worn = 0.0, None, False

    def __init__(self, counts_per_deg: float, clock: Callable[[], float]) -> None:
        self._per_deg = counts_per_deg
        self._clock = clock
        self._lock = threading.Lock()
        self._count = 0
        self._zero_deg = 0.0
        self._counted_s = clock()
        self.fed: Callable[[], tuple[bool, float]] = lambda: (False, float("-inf"))
        self.way: Callable[[], Direction] = lambda: Direction.PLUS
        """Which way the motor is fed, or was last: of one channel, an axis that coasts still goes on that way."""
        self.changes = 0
        """The counts since the start, either way."""
        self.trouble = "it has not been placed yet"
        """Why the count may be wrong; empty: it is right."""

    def read(self) -> float:
        """Degrees on the rotor's own scale; before the first `place`, from an arbitrary angle. Raises HardwareError."""
        with self._lock:
            self._take()
            return self._zero_deg + self.turned_deg

    @property
    def turned_deg(self) -> float:
        """How far it has turned since the start, as of the last `read`; `place` does not change it."""
        return self._count / self._per_deg

    def place(self, angle_deg: float, _within_deg: float = 0.0) -> bool:
        """The axis stands at that angle. Forgets the former count. Raises HardwareError."""
        with self._lock:
            self._take()
            self._settle(angle_deg)
            self._zero_deg, self.trouble = angle_deg - self.turned_deg, ""
            return True

    def reaches(self, _angle_deg: float) -> bool:
        """An encoder has no end."""
        return True

    @property
    def at_rest(self) -> bool:
        fed, off_s = self.fed()
        return not fed and self._clock() - max(off_s, self._counted_s) >= RESTS_S

    def _take(self) -> None:
        """Ask what was counted since the last call, and tell `_counted`. Raises HardwareError."""
        raise NotImplementedError

    def _settle(self, angle_deg: float) -> None:
        """The axis stands at that angle now. Raises HardwareError."""
        raise NotImplementedError

    def _counted(self, turned: int, changes: int) -> None:
        self._count += turned
        self.changes += changes
        if changes:
            self._counted_s = self._clock()


class QuadratureCounter(EncoderCounter):
    """It counts the edges that the kernel has recorded."""

    def __init__(self, channels: Channels, counts_per_deg: float, clock: Callable[[], float]) -> None:
        super().__init__(counts_per_deg, clock)
        self._channels = channels
        self._levels = list(channels.levels())

    def _settle(self, angle_deg: float) -> None:
        self._levels = list(self._channels.levels())

    def _take(self) -> None:
        for channel, level, lost in self._channels.changes():
            step = self._step(channel, level)
            if lost or not step:
                # The same level twice: an edge between was lost, and with it the direction.
                self.trouble = "edges of its encoder were lost: too many for this computer, or a spark"
            self._counted(step, 1)

    def _step(self, channel: int, level: int) -> int:
        """This level of the channel as a count of 1 or -1; 0: it is as it was."""
        changed, before = level != self._levels[channel], tuple(self._levels)
        self._levels[channel] = level
        if len(before) == 1:
            return changed * self.way()
        return changed * (1 if (TURN[self._levels[0], self._levels[1]] - TURN[before[0], before[1]]) % 4 == 1 else -1)
