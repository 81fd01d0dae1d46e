"""A thread that a mistake of the program has ended ends the box: what that thread did, nothing else does.

A dead thread makes no noise. Without its reader a link would answer nothing, also no `S`; a stop would not outlast a
restart; a display would show old angles for days. The service manager starts the box again. Knows nothing of what the
threads do.
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
    """Meanwhile `tell` hears of each thread of this process that an exception has ended. It is called in that thread.

    The exception goes into the log, also of a thread that dies while the box ends.
    """

    def died(what: threading.ExceptHookArgs) -> None:
        name = what.thread.name if what.thread else "unknown"
        dead = HardwareError(f"the thread {name!r} has ended by a mistake of the program")
        log.error("%s; please report it", dead, exc_info=what.exc_value)
        tell(dead)

    before, threading.excepthook = threading.excepthook, died
    try:
        yield
    finally:
        threading.excepthook = before
