"""Edge events of simulated GPIO lines, as Linux makes them (drivers/gpio/gpiolib-cdev.c).

Knows debouncing, sequence numbers, and the buffer that drops its oldest event when it is full. Knows no pins: the
caller reports each change of a level.
"""

from __future__ import annotations

import math
import os
from collections import deque
from dataclasses import dataclass
from enum import Enum

EVENTS_PER_LINE = 16
"""Size of the kernel's default buffer, in events for each line."""
LARGEST_BUFFER = 64 * EVENTS_PER_LINE
"""The kernel's limit, in events: a request has at most 64 lines."""


@dataclass(frozen=True, slots=True)
class EdgeEvent:
    """In the shape of `gpiod.EdgeEvent`. The moment is on CLOCK_MONOTONIC, here the simulation's clock."""

    class Type(Enum):
        RISING_EDGE = 1
        FALLING_EDGE = 2

    event_type: Type
    timestamp_ns: int
    line_offset: int
    global_seqno: int
    line_seqno: int


class EventQueue:
    """The unread events of a request. `size`: the requested buffer, in events; None or 0: the kernel's default."""

    def __init__(self, lines: int, size: int | None) -> None:
        wanted = min(size or lines * EVENTS_PER_LINE, LARGEST_BUFFER)
        self._events: deque[EdgeEvent] = deque(maxlen=1 << (wanted - 1).bit_length())  # a kfifo is a power of two
        self._line_seqnos: dict[int, int] = {}
        self._seqno = 0
        self._fd: int | None = None

    def __len__(self) -> int:
        return len(self._events)

    def put(self, offset: int, at_s: float, *, rising: bool) -> None:
        """Add an event. A full buffer drops its oldest event."""
        self._seqno += 1
        line_seqno = self._line_seqnos[offset] = self._line_seqnos.get(offset, 0) + 1
        kind = EdgeEvent.Type.RISING_EDGE if rising else EdgeEvent.Type.FALLING_EDGE
        self._events.append(EdgeEvent(kind, round(at_s * 1e9), offset, self._seqno, line_seqno))
        self._signal()

    def take(self, most: int) -> list[EdgeEvent]:
        """Remove and return the oldest events, `most` at most."""
        taken = [self._events.popleft() for _ in range(min(most, len(self._events)))]
        if self._fd is not None and not self._events and taken:
            os.eventfd_read(self._fd)
        return taken

    @property
    def fd(self) -> int:
        """A file descriptor that is readable while there are events. Opened at the first use."""
        if self._fd is None:
            self._fd = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
            if self._events:
                self._signal()
        return self._fd

    def close(self) -> None:
        if self._fd is not None:
            os.close(self._fd)
            self._fd = None

    def _signal(self) -> None:
        if self._fd is not None:
            os.eventfd_write(self._fd, 1)


class EdgeDetector:
    """One line of a request. `edges`: NONE, RISING, FALLING or BOTH, of the logical value.

    With a debounce period, each change of the pin starts the period again. When it ends, the line takes the pin's
    level, and the event carries that moment, not the moment of the first contact.
    """

    def __init__(
        self, offset: int, level: bool, queue: EventQueue, *, edges: str, active_low: bool, debounce_s: float
    ) -> None:
        self.level = level
        """The pin's level after debouncing."""
        self.due_s = math.inf
        """End of the running debounce period; infinite while none runs."""
        self._offset = offset
        self._pin = level
        self._queue = queue
        self._edges = edges
        self._active_low = active_low
        self._debounce_s = debounce_s

    def change(self, at_s: float, level: bool) -> None:
        """Take a change of the pin: its new level, and the moment."""
        self._pin = level
        if self._debounce_s > 0:
            self.due_s = at_s + self._debounce_s
        else:
            self._take(at_s)

    def settle(self) -> None:
        """End the debounce period, at the moment `due_s`."""
        at_s, self.due_s = self.due_s, math.inf
        self._take(at_s)

    def _take(self, at_s: float) -> None:
        if self._pin == self.level:
            return
        self.level = self._pin
        rising = self.level != self._active_low
        if self._edges in ("BOTH", "RISING" if rising else "FALLING"):
            self._queue.put(self._offset, at_s, rising=rising)
