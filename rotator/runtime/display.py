"""The display's thread: keeps a character display showing what it should.

Knows when to write. Knows neither what the rows mean nor what the display is made of. It has a thread of its own
because a slow or missing display may hold up nothing else.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Sequence

from hw.ports import CharacterDisplay, HardwareError

log = logging.getLogger(__name__)

DISPLAY_THREAD = "display"
"""The name of the thread."""
REFRESH_S = 0.2
RESET_EVERY_S = 300.0
"""Sparks from motor relays upset these displays; a fresh start now and then repairs what nobody sees happen."""
RETRY_S = 5.0


class DisplayThread:
    def __init__(
        self, display: CharacterDisplay, rows: Callable[[float], Sequence[str]], clock: Callable[[], float]
    ) -> None:
        self._display = display
        self._rows = rows
        self._clock = clock
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._keep, name=DISPLAY_THREAD, daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        self._stopping.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)

    def _keep(self) -> None:
        answered = True
        while not self._stopping.is_set():
            try:
                self._display.reset()
                if not answered:
                    log.warning("display: answers again")
                answered = True
                self._show_until(self._clock() + RESET_EVERY_S)
            except HardwareError as fault:
                if answered:
                    log.error("display: %s", fault)
                answered = False
                self._stopping.wait(RETRY_S)

    def _show_until(self, reset_s: float) -> None:
        shown: Sequence[str] = ()
        while self._clock() < reset_s and not self._stopping.is_set():
            rows = self._rows(self._clock())
            if rows != shown:
                self._display.show(rows)
                shown = rows
            self._stopping.wait(REFRESH_S)
