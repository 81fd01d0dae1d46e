"""A thread that does its work until it is stopped: for what waits for a disk, a chip or a network.

Knows how it starts and how long its end is waited for. Does not know the work: a subclass has it.
"""

from __future__ import annotations

import threading


class OwnThread:
    """`_run` ends soon after `_stopping` is set. `joined_s`: the longest wait for that; None: as long as it takes."""

    def __init__(self, name: str, joined_s: float | None = None) -> None:
        self._stopping = threading.Event()
        self._joined_s = joined_s
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Returns when the thread has ended. May be called twice, and without `start`."""
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join(self._joined_s)

    def _run(self) -> None:
        raise NotImplementedError
