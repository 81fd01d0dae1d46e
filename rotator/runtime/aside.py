"""Does a job in a thread of its own, for an event loop that goes on meanwhile; the end of the program waits for none.

`asyncio.to_thread` has threads that the interpreter waits for, also for one that a hanging card holds. Does not know
what a job does.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from contextlib import suppress


async def aside(job: Callable[[], object], name: str) -> None:
    """Wait for the job. Raises what the job raises. Cancelled, it leaves the job to its thread."""
    events = asyncio.get_running_loop()
    done: asyncio.Future[None] = events.create_future()

    def ended(failure: Exception | None) -> None:
        if done.done():
            return
        if failure is None:
            done.set_result(None)
        else:
            done.set_exception(failure)

    def run() -> None:
        failure: Exception | None = None
        try:
            job()
        except Exception as fault:
            failure = fault
        with suppress(RuntimeError):  # the event loop has closed
            events.call_soon_threadsafe(ended, failure)

    threading.Thread(target=run, name=name, daemon=True).start()
    await done
