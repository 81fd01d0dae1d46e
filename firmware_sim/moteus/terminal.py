"""The simulated adapter on a pseudo-terminal at its own path, in real time. It can be unplugged and plugged in.

Knows bytes, a path, and the moments when lines are due. Does not know what the lines mean. A late line is lost when the
adapter is unplugged.
"""

from __future__ import annotations

import contextlib
import heapq
import itertools
import os
import select
import threading
import tty
from collections.abc import Callable
from pathlib import Path

Receive = Callable[[bytes], list[tuple[float, bytes]]]
PATIENCE_S = 0.5
"""Longest wait of the thread for bytes."""


class SimAdapter:
    """`path` is a symlink to the terminal while plugged in. `receive` answers bytes with lines and their moments."""

    def __init__(self, path: Path, receive: Receive, clock: Callable[[], float]) -> None:
        self.path = path
        self._receive = receive
        self._clock = clock
        self._thread: threading.Thread | None = None
        self._bell = (-1, -1)

    def plug(self) -> None:
        """Plug the adapter in: its path appears, and a thread serves it."""
        if self._thread:
            return
        master, slave = os.openpty()
        tty.setraw(slave)
        self._bell = os.pipe()
        self.path.unlink(missing_ok=True)
        self.path.symlink_to(os.ttyname(slave))
        self._thread = threading.Thread(target=self._serve, args=(master, slave), name="moteus-adapter", daemon=True)
        self._thread.start()

    def unplug(self) -> None:
        """Unplug the adapter: its path disappears, and the terminal closes. A second call does nothing."""
        if not self._thread:
            return
        self.path.unlink(missing_ok=True)
        os.write(self._bell[1], b"!")
        self._thread.join()
        self._thread = None
        for end in self._bell:
            os.close(end)

    def _serve(self, master: int, slave: int) -> None:
        due: list[tuple[float, int, bytes]] = []
        order = itertools.count()
        try:
            while True:
                wait_s = min(PATIENCE_S, max(0.0, due[0][0] - self._clock())) if due else PATIENCE_S
                ready, _, _ = select.select([master, self._bell[0]], [], [], wait_s)
                if self._bell[0] in ready:
                    return
                if master in ready:
                    for due_s, line in self._receive(os.read(master, 4096)):
                        heapq.heappush(due, (due_s, next(order), line))
                while due and due[0][0] <= self._clock():
                    os.write(master, heapq.heappop(due)[2])
        finally:
            for end in (master, slave):
                with contextlib.suppress(OSError):
                    os.close(end)
