"""Stops the parts of a box one after the other, and logs each failure. A part that fails skips no other.

Knows names, calls and failures. The app supplies the parts and their order.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass

from hw.ports import HardwareError

log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Part:
    """`close` may be called twice, and also when the part has never started."""

    name: str
    close: Callable[[], Awaitable[None]]

    @classmethod
    def quick(cls, name: str, close: Callable[[], None]) -> Part:
        """A part whose `close` waits for nothing, and belongs on the event loop."""

        async def closed() -> None:
            close()

        return cls(name, closed)

    @classmethod
    def blocking(cls, name: str, close: Callable[[], None]) -> Part:
        """A part whose `close` blocks: it waits for a thread, a disk or hardware."""
        return cls(name, lambda: asyncio.to_thread(close))


class Failures:
    """The failures, in order. Each one is logged once."""

    def __init__(self) -> None:
        self.noted: list[Exception] = []

    def note(self, name: str, failure: Exception, *, traceback: bool = False) -> None:
        """`traceback`: log one with a HardwareError too; any other exception is a bug, and has one always."""
        if any(failure is each for each in self.noted):
            return
        self.noted.append(failure)
        traceback = traceback or not isinstance(failure, HardwareError)
        text = str(failure) or type(failure).__name__
        log.error("%s failed: %s", name, text, exc_info=failure if traceback else None)

    async def close(self, part: Part) -> None:
        try:
            await part.close()
        except Exception as failure:
            # A failure may have another one as its cause, which only the traceback shows.
            self.note(part.name, failure, traceback=True)


@asynccontextmanager
async def closing(parts: Sequence[Part]) -> AsyncIterator[Failures]:
    """Close all parts at the end, in this order. A part that fails is logged, and the next one is closed.

    What the body raises goes on to the caller. Else the first failure is raised once all parts are closed.
    """
    failures = Failures()
    async with AsyncExitStack() as stack:
        for part in reversed(parts):
            stack.push_async_callback(failures.close, part)
        yield failures
    if failures.noted:
        raise failures.noted[0]
