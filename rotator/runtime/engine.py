"""Starts and stops the two threads that move the antenna: the control loop, and the rotor's guard.

Knows in which order they start and stop. Knows neither what is controlled nor the links.
"""

from __future__ import annotations

import asyncio
import logging
import os
import threading
from contextlib import suppress
from typing import Protocol

from hw.ports import HardwareError
from hw.urgent import hurry
from rotator.rotors.port import Rotor
from rotator.runtime.loop import COAST_S, ControlLoop

log = logging.getLogger(__name__)

CONTROL_THREAD = "control"
"""The name of the thread."""
JOIN_S = 2.0 + COAST_S
ANSWER_EVERY_S = 0.5
MOST_MISSED = 6
"""So many looks in a row without the sentinel's answer, 3 s: a Pi that compiles beside the box delays it by less than a
tenth of that."""


class Sentinel(Protocol):
    """The process that opens the relays if this program dies."""

    @property
    def pid(self) -> int: ...

    def is_awake(self) -> bool:
        """Whether it has answered the question of the call before."""


async def sentinel_fails(sentinel: Sentinel) -> None:
    """Wait until the sentinel process ends or answers no more, then raise HardwareError: it should outlive the program.

    Its silence counts in looks, and not in time: where the whole machine has stood still, it has missed one.
    """
    ended, missed, failed = asyncio.Event(), 0, "does not answer"
    handle = os.pidfd_open(sentinel.pid)
    asyncio.get_running_loop().add_reader(handle, ended.set)
    try:
        while missed < MOST_MISSED:
            missed = 0 if sentinel.is_awake() else missed + 1
            with suppress(TimeoutError):
                await asyncio.wait_for(ended.wait(), ANSWER_EVERY_S)
                failed = "has ended"
                break
    finally:
        asyncio.get_running_loop().remove_reader(handle)
        os.close(handle)
    raise HardwareError(
        f"the sentinel (process {sentinel.pid}) {failed}: nothing would open the relays if this program died"
    )


class ControlThread:
    """Runs the control loop in a thread. `ended` is done when the loop has ended: its failure, or None."""

    def __init__(self, loop: ControlLoop) -> None:
        self._loop = loop
        self._events = asyncio.get_running_loop()
        self.ended: asyncio.Future[Exception | None] = self._events.create_future()
        self._thread = threading.Thread(target=self._run, name=CONTROL_THREAD, daemon=True)

    def start(self) -> None:
        self._thread.start()

    async def join(self) -> Exception | None:
        """Wait for the end. Returns the failure that ended the loop, None for a proper end.

        A thread that hangs on a dead bus is left behind: the guard has opened the relays.
        """
        if not self.ended.done():
            await asyncio.wait([self.ended], timeout=JOIN_S)
        if self.ended.done():
            return self.ended.result()
        self._loop.leave()
        log.error("the control thread does not end; the relays are off")
        return None

    def _run(self) -> None:
        failure: Exception | None = None
        hurry()
        try:
            self._loop.run()
        except Exception as fault:
            # The loop has already switched everything off. `join` returns the failure.
            failure = fault
        with suppress(RuntimeError):  # this thread was left behind, and the event loop has closed
            self._events.call_soon_threadsafe(self._end, failure)

    def _end(self, failure: Exception | None) -> None:
        if not self.ended.done():
            self.ended.set_result(failure)


class Engine:
    """The control loop and the rotor. After `halt` every relay is off and both threads have ended."""

    def __init__(self, loop: ControlLoop, rotor: Rotor) -> None:
        self.loop = loop
        self._rotor = rotor
        self._thread: ControlThread | None = None
        self._closed = False

    def start(self) -> asyncio.Future[Exception | None]:
        """Start both, in an event loop. Returns the future that is done when the control loop has ended."""
        thread = ControlThread(self.loop)
        self._rotor.start()
        thread.start()
        self._thread = thread  # only now: `halt` waits for a thread that runs
        return thread.ended

    async def halt(self) -> Exception | None:
        """Switch everything off. May be called twice. Returns what ended the control loop, None for a proper end.

        The guard ends last, because it is needed until the loop has ended. Raises HardwareError if a line fails and
        the loop had ended properly.
        """
        self.loop.stop()
        failure = await self._thread.join() if self._thread else None
        if self._closed:
            return failure
        try:
            await asyncio.to_thread(self._rotor.close)
            self._closed = True
        except Exception as fault:
            if failure is None:
                raise
            log.error("the rotor cannot be closed: %s", fault)
        return failure
