"""The control loop and the rotor with its guard, each with a thread, as one thing to start and to stop.

Knows in which order they come and go. Knows nothing of what is controlled, and of no link.
"""

from __future__ import annotations

import asyncio
import logging
import os
import threading

from hw.ports import HardwareError
from rotator.rotors.port import Rotor
from rotator.runtime.loop import ControlLoop

log = logging.getLogger(__name__)

JOIN_S = 2.0


async def process_end(pid: int) -> None:
    """Wait for a child process that should never end. Raises HardwareError when it does."""
    ended = asyncio.Event()
    handle = os.pidfd_open(pid)
    asyncio.get_running_loop().add_reader(handle, ended.set)
    try:
        await ended.wait()
    finally:
        asyncio.get_running_loop().remove_reader(handle)
        os.close(handle)
    raise HardwareError(f"the sentinel (process {pid}) has ended: nobody would open the relays if this program died")


class ControlThread:
    """The control loop in its thread, and its end as something asyncio can wait for."""

    def __init__(self, loop: ControlLoop) -> None:
        self._loop = loop
        self._events = asyncio.get_running_loop()
        self.ended: asyncio.Future[Exception | None] = self._events.create_future()
        self._thread = threading.Thread(target=self._run, name="control", daemon=True)

    def start(self) -> None:
        self._thread.start()

    async def join(self) -> Exception | None:
        """What stopped the loop, if something did. A thread that hangs on a dead bus is left behind: relays are off."""
        try:
            return await asyncio.wait_for(self.ended, JOIN_S)
        except TimeoutError:
            log.error("the control thread does not end; the relays are off")
            return None

    def _run(self) -> None:
        failure: Exception | None = None
        try:
            self._loop.run()
        except Exception as fault:
            # It travels to whoever waits for the box; the loop has switched everything off on its way out.
            log.exception("the control thread failed")
            failure = fault
        self._events.call_soon_threadsafe(self._end, failure)

    def _end(self, failure: Exception | None) -> None:
        if not self.ended.done():
            self.ended.set_result(failure)


class Engine:
    """`start` it in an event loop; after `halt` every relay is off, and it tells what went wrong, if something did."""

    def __init__(self, loop: ControlLoop, rotor: Rotor) -> None:
        self.loop = loop
        self._rotor = rotor
        self._thread: ControlThread | None = None

    def start(self) -> asyncio.Future[Exception | None]:
        """The future that is done when the loop has ended."""
        self._thread = ControlThread(self.loop)
        self._rotor.start()
        self._thread.start()
        return self._thread.ended

    async def halt(self) -> Exception | None:
        """Everything off. The rotor's guard goes last: until the loop has ended it may still be needed."""
        self.loop.stop()
        try:
            return await self._thread.join() if self._thread else None
        finally:
            await asyncio.to_thread(self._rotor.close)
