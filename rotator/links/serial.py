"""A serial port, or any URL that pyserial opens. A USB port may be unplugged and plugged in again at any time.

Knows how to open the port, how to notice that it is gone, and when to try again. Ignores DTR and RTS. Does not know
what the bytes mean. The only file that imports pyserial.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import serial

from rotator.links.fd import converse, writer
from rotator.links.wire import Conversation, Waiting, Wire
from rotator.protocols.session import Session
from rotator.runtime.own_thread import aside

log = logging.getLogger(__name__)

RETRY_S = 1.0
URL_POLL_S = 0.1


@dataclass(eq=False)
class SerialLink(Waiting):
    """`session` makes the protocol's side of the link. `retry_s`: the time between two attempts to open the port, by
    `opens`, which is pyserial's."""

    wire: Wire
    port: str
    baud: int
    session: Callable[[], Session]
    _: KW_ONLY
    retry_s: float = RETRY_S
    opens: Callable[..., Any] = serial.serial_for_url
    _logged: str = field(default="", init=False)
    """The trouble in the last warning; empty while the port is open."""

    async def run(self) -> None:
        while True:
            try:
                port = await self._opened()
            except Exception as fault:  # pyserial's URLs raise what their options run into: KeyError, re.error
                self._tell(f"cannot be opened: {_why(fault)}")
            else:
                self.wire.state = "open"
                self._logged = ""
                log.info("%s: %s open at %d baud", self.wire.name, self.port, self.baud)
                try:
                    why = await self._converse(port)
                finally:
                    port.close()
                    self.wire.state = "closed"
                self._tell(f"lost: {why}")
            await asyncio.sleep(self.retry_s)

    async def _opened(self) -> Any:
        """Open it in a thread of its own: a URL whose machine is off takes seconds, and holds up no end of the box."""
        return await aside(
            lambda: self.opens(self.port, self.baud, timeout=0), self.wire.name, lambda port: port.close()
        )

    async def _converse(self, port: Any) -> str:
        """Carry bytes until the port fails. Returns the reason."""
        try:
            fd = port.fileno()
        except (AttributeError, NotImplementedError, OSError):
            return await self._converse_by_thread(port)
        os.set_blocking(fd, False)
        return await converse(fd, Conversation(self.session(), self.wire, writer(fd)))

    async def _converse_by_thread(self, port: Any) -> str:
        """As `_converse`, for URLs without a file descriptor (rfc2217://, loop://): a thread waits for the bytes."""
        loop = asyncio.get_running_loop()
        arrivals: asyncio.Queue[bytes | str] = asyncio.Queue()
        leaving = threading.Event()

        # Set only once: over rfc2217:// every change of a setting is a negotiation with the other end.
        port.timeout = URL_POLL_S

        def arrive(arrival: bytes | str) -> None:
            with suppress(RuntimeError):  # the event loop has ended meanwhile
                loop.call_soon_threadsafe(arrivals.put_nowait, arrival)

        def listen() -> None:
            while not leaving.is_set():
                try:
                    data = port.read(1)
                    # `in_waiting` bytes can be read at once. A timeout of None would make `read` wait for ever.
                    data += port.read(port.in_waiting) if data else b""
                except (serial.SerialException, OSError, TypeError, ValueError) as fault:  # TypeError: closed meanwhile
                    arrive(str(fault))
                    return
                if data:
                    arrive(data)

        conversation = Conversation(self.session(), self.wire, lambda reply: _write(port, reply))
        thread = threading.Thread(target=listen, name=self.wire.name, daemon=True)
        thread.start()
        try:
            while True:
                match await arrivals.get():
                    case bytes() as data:
                        conversation.received(data)
                    case str() as why:
                        return why
        finally:
            leaving.set()
            conversation.close()

    def _tell(self, text: str) -> None:
        """Log a trouble once when it begins."""
        if text != self._logged:
            log.warning("%s: %s %s; waiting for it", self.wire.name, self.port, text)
            self._logged = text
        self.wire.state = "waiting for it"


def _why(fault: Exception) -> str:
    """In the system's words instead of pyserial's, which say everything twice."""
    match fault:
        case OSError(errno=errno.ENOENT):
            return f"{os.strerror(errno.ENOENT)}: is it plugged in? `ls /dev/serial/by-id` shows what is"
        case OSError(errno=errno.EACCES):
            return f"{os.strerror(errno.EACCES)}: `sudo usermod -aG dialout $USER`, then log in again"
        case OSError(errno=int() as number):
            return os.strerror(number)
        case ValueError():
            return str(fault)
        case _:
            return f"what stands behind :// is wrong: {fault}"


def _write(port: Any, data: bytes) -> None:
    try:
        port.write(data)
    except (serial.SerialException, OSError):
        return
