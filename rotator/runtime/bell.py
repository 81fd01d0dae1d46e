"""Wakes a thread that waits: a lock that is free for as long as a ring has not been heard.

Knows one lock. Does not know why it rings. A `threading.Event` does the same in Python, with a new lock for each wait:
at twenty wakeups a second that was a tenth of what the control loop takes.
"""

from __future__ import annotations

import threading


class Bell:
    """Any thread may ring. One thread waits."""

    def __init__(self) -> None:
        self._silence = threading.Lock()
        self._silence.acquire()

    def ring(self) -> None:
        """Wake the thread that waits, or the next one that will. Rings that are not heard yet count as one."""
        try:
            self._silence.release()
        except RuntimeError:
            """It rings already."""

    def wait(self, most_s: float) -> bool:
        """Wait for a ring, `most_s` seconds at most. Returns whether it rang."""
        return self._silence.acquire(timeout=max(0.0, most_s))
