"""What all links share: the state that the terminal shows, the conversation with a protocol, and the error texts.

Knows when a line has been silent long enough, and the system's text for a failed address. Does not know any device or
protocol.
"""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import socket
from collections.abc import Callable
from dataclasses import dataclass

from rotator.protocols.session import ClockedSession, Ending, Session

log = logging.getLogger(__name__)

KEPT_BYTES = 64
"""How many of the last bytes in each direction a Wire keeps."""


class LinkError(Exception):
    """A link cannot be opened. The text names the link's address and the reason."""


def reason(fault: OSError | UnicodeError) -> str:
    """The system's text for an address at which the box cannot listen, or which it cannot reach."""
    match fault:
        case socket.gaierror():
            return fault.strerror or str(fault)
        case OSError(errno=errno.EADDRINUSE):
            what_to_do = "end the program that uses it (another box?), or write another address into the file"
            return f"{os.strerror(errno.EADDRINUSE)}: {what_to_do}"
        case OSError(errno=int() as number):
            # asyncio's own text is much longer than the system's.
            return os.strerror(number)
        case OSError():
            return str(fault)
        case _:
            return "no machine can have that name"


@dataclass(slots=True)
class Wire:
    """One link as the terminal shows it. The link sets `state`; the tap adds the bytes."""

    name: str
    protocol: str
    where: str
    state: str = "closed"
    last_in: bytes = b""
    last_out: bytes = b""
    count_in: int = 0
    """The number of bytes received since the start. It grows also where the same line comes again."""

    def came(self, data: bytes) -> None:
        self.count_in += len(data)
        self.last_in = (self.last_in + data)[-KEPT_BYTES:]

    def went(self, data: bytes) -> None:
        self.last_out = (self.last_out + data)[-KEPT_BYTES:]


class Waiting:
    """A link whose `run` waits for its other end, and closes what it has opened. Nothing is done before and after."""

    async def open(self) -> None:
        """The other end may come later."""

    def close(self) -> None:
        """`run` has ended by now."""


class Conversation:
    """One connection: passes bytes to `session` and the replies to `write`, one call for each reply.

    `hang_up` is called when the client has asked to end the connection. Links without connections leave it out.
    """

    def __init__(
        self,
        session: Session,
        wire: Wire,
        write: Callable[[bytes], None],
        hang_up: Callable[[], None] = lambda: None,
    ) -> None:
        self._session = session
        self._wire = wire
        self._write = write
        self._hang_up = hang_up
        self._silence: asyncio.TimerHandle | None = None
        self._over = False
        self._beating: asyncio.TimerHandle | None = None
        self._wait_for_beat()

    def received(self, data: bytes) -> None:
        """Take bytes as they arrive, in any pieces. Raises nothing: an exception in the protocol is logged."""
        self._reply(lambda: self._session.receive(data))
        if self._session.idle_s is not None:
            self._cancel()
            self._silence = asyncio.get_running_loop().call_later(self._session.idle_s, self._silent)

    def finish(self) -> None:
        """The program has ended the connection: what it has sent last is whole, also without a line end."""
        self._reply(self._session.finish)

    def close(self) -> None:
        """End the conversation and its timers, and tell the session. May be called twice."""
        self._cancel()
        if self._beating is not None:
            self._beating.cancel()
        if not self._over:
            self._over = True
            if isinstance(self._session, Ending):
                self._session.ended()

    def _silent(self) -> None:
        self._silence = None
        self._reply(self._session.idle)

    def _wait_for_beat(self) -> None:
        if isinstance(self._session, ClockedSession) and self._session.every_s is not None:
            self._beating = asyncio.get_running_loop().call_later(self._session.every_s, self._beat, self._session)

    def _beat(self, session: ClockedSession) -> None:
        # The next beat first: the reply may end the conversation.
        self._wait_for_beat()
        self._reply(session.beat)

    def _cancel(self) -> None:
        if self._silence is not None:
            self._silence.cancel()
            self._silence = None

    def _reply(self, ask: Callable[[], list[bytes]]) -> None:
        try:
            replies = ask()
        except Exception:
            # An error in one protocol must not end this link or the other links.
            log.exception("%s: the protocol failed; the bytes are dropped", self._wire.name)
            return
        for reply in replies:
            self._write(reply)
        if self._session.closed:
            self._hang_up()
