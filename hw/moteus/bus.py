"""The thread that talks to the moteus controllers, and connects again after a fault of the cable or the library.

Knows three faults of the library. A closed connection leaves its port registered: each connection gets its own event
loop. Some calls never return: all have a time limit. An unplugged port raises again and again in a callback: the first
such error ends the connection. Does not decide which order is sent: `hw.moteus.drive` does.
"""

from __future__ import annotations

import asyncio
import contextlib
import errno
import logging
import math
import threading
import time
from collections.abc import Awaitable, Callable
from typing import Any

from hw.moteus.drive import MoteusDrive
from hw.moteus.library import CanChannel, SerialPort, library
from hw.moteus.wire import Wire
from hw.ports import Axis, HardwareError
from hw.urgent import hurry

log = logging.getLogger(__name__)

MOTEUS_THREAD = "moteus"
"""The name of the thread."""
EXCHANGE_S = 0.15
"""Longest time for one request and its answer, in seconds."""
SILENCE_S = 2.0
"""Seconds without any answer, after which the connection is opened again."""
BACK_OFF_S = (0.03, 2.0)
"""The shortest and the longest pause before the next attempt to connect, in seconds."""
FIRST_ANSWER_S = 0.7
"""Seconds that `start` waits for the first answers at most. A healthy bus needs a tenth of that."""
LOGGED_EVERY_S = 10.0
"""Seconds between two log lines about a bad cable."""
COMING_TO_REST_S = 2.0
"""The longest time, in seconds, for the motors to stop when the program ends."""


class MoteusBus:
    """Serves a drive in a thread of its own from `start` to `close`, and connects again when the cable fails."""

    def __init__(
        self, drive: MoteusDrive, port: SerialPort | CanChannel, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """`clock`: seconds, for the log. Raises HardwareError where the library is missing."""
        self._moteus = library()
        self._drive = drive
        self._port = port
        self._clock = clock
        self._closing = threading.Event()
        self._met = threading.Event()
        """Set when both controllers have answered, or when the first try has failed."""
        self._lively: bool
        """Whether a controller has answered on the present connection."""
        self._logged_s, self._unsaid = -math.inf, 0
        self._lock = threading.Lock()
        self._waker: tuple[asyncio.AbstractEventLoop, asyncio.Event] | None = None
        self._thread = threading.Thread(target=self._run, name=MOTEUS_THREAD, daemon=True)
        drive.on_news = self._wake
        drive.on_return = self._log_return

    def start(self) -> None:
        """Returns when both controllers have answered, so that a start begins without a fault; or after a moment."""
        self._drive.lost(f"moteus: {self._port}: not connected yet")
        self._thread.start()
        self._met.wait(FIRST_ANSWER_S)

    def close(self) -> None:
        """Let both axes come to rest and hold, then end the thread. After that the controllers' watchdogs guard them.

        May be called twice, and without `start`.
        """
        self._drive.off()
        self._closing.set()
        self._wake()
        if self._thread.is_alive():
            self._thread.join(timeout=COMING_TO_REST_S + 1.0)

    def _wake(self) -> None:
        """Wake the thread: there is something to send. From any thread."""
        with self._lock, contextlib.suppress(RuntimeError):  # the event loop may have just ended
            if self._waker:
                self._waker[0].call_soon_threadsafe(self._waker[1].set)

    def _log_return(self, axis: Axis, gap_s: float) -> None:
        now_s = self._clock()
        if now_s - self._logged_s < LOGGED_EVERY_S:
            self._unsaid += 1
            return
        more = f"; {self._unsaid} more since the last such line" if self._unsaid else ""
        log.warning("%s: moteus answers again, after %.2f s of silence%s", axis.value, gap_s, more)
        self._logged_s, self._unsaid = now_s, 0

    def _run(self) -> None:
        hurry()
        wait_s = BACK_OFF_S[0]
        while not self._closing.is_set():
            self._lively = False
            try:
                asyncio.run(self._connection())
                reason = "no controller answers: check their supply and the CAN wires"
            except (Exception, SystemExit) as failure:  # the library calls sys.exit when one of its handlers fails
                reason = _explain(failure)
            if self._closing.is_set():
                return
            wait_s = BACK_OFF_S[0] if self._lively else min(2 * wait_s, BACK_OFF_S[1])
            log.debug("moteus: %s: %s; next try in %.1f s", self._port, reason, wait_s)
            self._drive.lost(f"moteus: {self._port}: {reason}")
            self._met.set()
            self._closing.wait(wait_s)

    async def _connection(self) -> None:
        """Exchange orders and answers until the line fails (raises), all are silent, or `close` is called."""
        loop, news, broken = asyncio.get_running_loop(), asyncio.Event(), asyncio.Event()
        me = asyncio.current_task()
        failures: list[BaseException] = []

        def fail(_loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
            failures.append(context.get("exception") or OSError(context["message"]))
            if not broken.is_set() and me:
                broken.set()
                me.cancel()

        loop.set_exception_handler(fail)
        transport = self._port(self._moteus)
        with self._lock:
            self._waker = (loop, news)
        try:
            await self._talk(Wire(self._moteus, transport, self._drive), news)
        except asyncio.CancelledError:
            raise failures[0] if failures else OSError("the connection was cut") from None
        finally:
            with self._lock:
                self._waker = None
            transport.close()

    async def _talk(self, wire: Wire, news: asyncio.Event) -> None:
        loop = asyncio.get_running_loop()
        heard_s, rested_by_s = loop.time(), None
        while loop.time() - heard_s < SILENCE_S:
            if self._closing.is_set():
                rested_by_s = rested_by_s or loop.time() + COMING_TO_REST_S
                if loop.time() > rested_by_s or self._drive.at_rest:
                    break
            news.clear()
            if await wire.serve(_patiently):
                heard_s, self._lively = loop.time(), True
                if not self._met.is_set() and all(self._drive.answer(axis) for axis in self._drive.specs):
                    self._met.set()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(news.wait(), self._drive.next_order_in_s())


async def _patiently(call: Awaitable[Any]) -> Any:
    try:
        return await asyncio.wait_for(call, EXCHANGE_S)
    except RuntimeError as failure:  # the library's error for a lost or garbled line
        raise TimeoutError from failure


def _explain(failure: BaseException) -> str:
    match failure:
        case HardwareError():
            return str(failure)
        case OSError() if failure.errno == errno.ENOENT:
            return "there is no such port: plug the adapter in, or correct moteus.port"
        case OSError() if failure.errno in (errno.EACCES, errno.EPERM):
            return "no permission: add the user to the group dialout"
        case OSError() if failure.errno == errno.ENODEV:
            return "there is no such CAN interface: bring it up with ip link set can0 up type can ... fd on"
        case OSError() if failure.errno == errno.ENETDOWN:
            return "the CAN interface is down: ip link set can0 up"
        case _:
            return f"the adapter has gone ({failure}): check its plug and its cable"
