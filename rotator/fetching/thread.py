"""The thread that fetches elements: it checks again and again whether an address is due, and waits for its answer.

Knows real time. No other part waits for this thread. The download runs in a process that it can end.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from rotator.fetching.fetcher import Fetcher
from rotator.fetching.manners import Moment
from rotator.runtime.own_process import OwnProcess

LOOK_S = 5.0


class FetchThread:
    """`process`: in which the fetcher downloads. `tell` is called when a file is new."""

    def __init__(self, fetcher: Fetcher, process: OwnProcess, tell: Callable[[], None]) -> None:
        self._fetcher = fetcher
        self._process = process
        self._tell = tell
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="fetching", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Returns when the thread has ended. A present download is given up."""
        self._stopping.set()
        self._process.close()
        if self._thread.is_alive():
            self._thread.join()

    def _run(self) -> None:
        while not self._stopping.is_set():
            if self._fetcher.step(Moment(time.time(), time.monotonic())):
                self._tell()
            self._stopping.wait(LOOK_S)
