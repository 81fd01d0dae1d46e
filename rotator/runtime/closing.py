"""Stops the parts of a box one after the other, and logs each failure. A failure of one part does not skip the next.

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
        """A part whose `close` never waits. It runs on the event loop."""

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
        """`traceback`: log the traceback of a HardwareError too. Any other exception is a bug and always has one."""
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
            # Only the traceback shows an earlier failure that caused this one.
            self.note(part.name, failure, traceback=True)


@asynccontextmanager
async def closing(parts: Sequence[Part]) -> AsyncIterator[Failures]:
    """Close all parts at the end, in this order. A part that fails is logged, and the next one is closed.

    An exception of the body goes on to the caller. If the body raised none, the first failure of a part is raised after
    all parts are closed.
    """
    failures = Failures()
    async with AsyncExitStack() as stack:
        for part in reversed(parts):
            stack.push_async_callback(failures.close, part)
        yield failures
    if failures.noted:
        raise failures.noted[0]
