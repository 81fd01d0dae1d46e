"""A bug that ends one thread ends the whole box, because no other thread does its work.

A dead thread is silent. Without its reader a link would not even obey `S`; a stop would not survive a restart; a
display would show old angles for days. The service manager starts the box again. Does not know what the threads do.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from hw.ports import HardwareError

log = logging.getLogger(__name__)


@contextmanager
def dead_threads(tell: Callable[[HardwareError], None]) -> Iterator[None]:
    """Inside this context `tell` is called for each thread of this process that ends by an exception, in that thread.

    The exception goes into the log, also when the thread dies while the box ends.
    """

    def died(death: threading.ExceptHookArgs) -> None:
        name = death.thread.name if death.thread else "unknown"
        dead = HardwareError(f"the thread {name!r} has ended by a mistake of the program")
        log.error("%s; please report it", dead, exc_info=death.exc_value)
        tell(dead)

    before, threading.excepthook = threading.excepthook, died
    try:
        yield
    finally:
        threading.excepthook = before
