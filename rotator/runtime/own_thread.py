"""Work in a thread of its own, for what waits for a disk, a chip or a network: until it is stopped, or one job.

Knows how such a thread starts, how its end is waited for, and what a mistake in one of them means. Does not know the
work.
"""

from __future__ import annotations

import asyncio
import logging
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, InvalidStateError
from contextlib import contextmanager, suppress
from typing import TypeVar

from hw.ports import HardwareError

log = logging.getLogger(__name__)

T = TypeVar("T")


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


async def aside(job: Callable[[], T], name: str, late: Callable[[T], object] = lambda _made: None) -> T:
    """Wait for a job in a thread of its own. Raises what the job raises. Cancelled, it leaves the job to its thread:
    then `late` gets what comes of it.

    `asyncio.to_thread` has threads that the interpreter waits for, also for one that a hanging card holds.
    """
    done: Future[T] = Future()

    def run() -> None:
        try:
            made = job()
        except Exception as fault:
            with suppress(InvalidStateError):  # nobody waits for it any more
                done.set_exception(fault)
            return
        try:
            done.set_result(made)
        except InvalidStateError:
            late(made)

    threading.Thread(target=run, name=name, daemon=True).start()
    return await asyncio.wrap_future(done)


@contextmanager
def dead_threads(tell: Callable[[HardwareError], None]) -> Iterator[None]:
    """Inside this context `tell` is called for each thread of this process that ends by an exception, in that thread.

    A dead thread is silent, and no other does its work. Without its reader a link would not even obey `S`; a stop would
    not survive a restart; a display would show old angles for days. So it ends the whole box, which the service manager
    starts again.

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
