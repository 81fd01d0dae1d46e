"""The guard: a thread that opens relays whose commands have expired, and touches nothing else.

Knows one relay bank. Does not know the sensors, the bus or the program that gives the commands, so none of them can
hold a relay on by hanging.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from hw.ports import HardwareError
from hw.relays import RelayBank

log = logging.getLogger(__name__)

RETRY_S = 0.05
PATIENCE_S = 1.0
"""It looks again after so long even if nothing called it."""


class Guard:
    def __init__(self, bank: RelayBank, clock: Callable[[], float]) -> None:
        self._bank = bank
        self._clock = clock
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="relay-guard", daemon=True)

    def start(self) -> None:
        self._thread.start()

    def stop(self) -> None:
        """Everything off, then the thread ends. Raises HardwareError if a line cannot be switched."""
        self._stopping.set()
        try:
            self._bank.off()
        finally:
            if self._thread.is_alive():
                self._thread.join(timeout=2 * PATIENCE_S)

    def _watch(self) -> None:
        while not self._stopping.is_set():
            self._bank.wait_until_due(PATIENCE_S)
            try:
                self._bank.enforce(self._clock())
            except HardwareError:
                log.exception("the guard could not open a relay: CUT THE MOTOR POWER; trying again")
                self._stopping.wait(RETRY_S)
