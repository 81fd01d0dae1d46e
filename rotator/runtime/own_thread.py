"""Work in a thread of its own, for what waits for a disk, a chip or a network: until it is stopped, or one job.

Knows how such a thread starts, and how its end is waited for. Does not know the work.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError
from contextlib import suppress
from typing import TypeVar

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
