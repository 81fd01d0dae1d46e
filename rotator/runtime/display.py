"""The display's thread: keeps the rows of a character display up to date.

Knows when to write, when to reset the display, and when to try a missing display again. Knows neither what the rows
mean nor how the display works. It has a thread of its own because a slow or missing display must not delay other parts.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence

from hw.ports import CharacterDisplay, HardwareError
from rotator.runtime.own_thread import OwnThread

log = logging.getLogger(__name__)

DISPLAY_THREAD = "display"
"""The name of the thread."""
REFRESH_S = 0.2
"""Seconds between two comparisons of the rows."""
RESET_EVERY_S = 300.0
"""Seconds between two resets. Sparks of motor relays garble these displays, the program cannot read them back, and a
reset repairs them."""
JOIN_S = 2.0
RETRY_S = 5.0
"""The pause, in seconds, before a display that does not answer is tried again."""


class DisplayThread(OwnThread):
    """`rows` gives the text of each row at a time of `clock`, in seconds."""

    def __init__(
        self,
        display: CharacterDisplay,
        rows: Callable[[float], Sequence[str]],
        clock: Callable[[], float],
        *,
        retry_s: float = RETRY_S,
    ) -> None:
        """`retry_s`: the real pause before the next try with a display that does not answer."""
        super().__init__(DISPLAY_THREAD, JOIN_S)
        self._display = display
        self._rows = rows
        self._clock = clock
        self._retry_s = retry_s

    def _run(self) -> None:
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
                self._stopping.wait(self._retry_s)

    def _show_until(self, reset_s: float) -> None:
        shown: Sequence[str] = ()
        while self._clock() < reset_s and not self._stopping.is_set():
            rows = self._rows(self._clock())
            if rows != shown:
                self._display.show(rows)
                shown = rows
            self._stopping.wait(REFRESH_S)
