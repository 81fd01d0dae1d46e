"""One link as the terminal picture shows it, and the shell between a stream of bytes and a protocol.

Knows when a line has fallen silent, and the words for what is wrong with an address. Knows no device and no protocol.
"""

from __future__ import annotations

import asyncio
import logging
import os
import socket
from collections.abc import Callable
from dataclasses import dataclass

from rotator.protocols.session import Session

log = logging.getLogger(__name__)

KEPT_BYTES = 64


class LinkError(Exception):
    """A link cannot be opened. The text says which one, and what to do."""


def reason(fault: OSError | UnicodeError) -> str:
    """Why the box cannot listen at an address, or cannot reach it, in the system's words."""
    match fault:
        case socket.gaierror():
            return fault.strerror or str(fault)
        case OSError(errno=int() as number):
            # asyncio adds many words of its own to the system's.
            return os.strerror(number)
        case OSError():
            return str(fault)
        case _:
            return "no machine can have that name"


@dataclass(slots=True)
class Wire:
    """One link as the terminal picture shows it: `state` is the link's to write, the last bytes are the tap's."""

    name: str
    protocol: str
    where: str
    state: str = "closed"
    last_in: bytes = b""
    last_out: bytes = b""

    def came(self, data: bytes) -> None:
        self.last_in = (self.last_in + data)[-KEPT_BYTES:]

    def went(self, data: bytes) -> None:
        self.last_out = (self.last_out + data)[-KEPT_BYTES:]


class Conversation:
    """One connection: bytes in, replies out through `write`, which sends a reply in one go or not at all.

    `hang_up` is called when the client has asked to end the connection. A line that cannot hang up does nothing.
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

    def received(self, data: bytes) -> None:
        """Take what has come, in any pieces. Raises nothing: a bug in the protocol is logged."""
        self._reply(lambda: self._session.receive(data))
        if self._session.idle_s is not None:
            self._cancel()
            self._silence = asyncio.get_running_loop().call_later(self._session.idle_s, self._silent)

    def close(self) -> None:
        """End it: silence is no longer waited for. May be called twice."""
        self._cancel()

    def _silent(self) -> None:
        self._silence = None
        self._reply(self._session.idle)

    def _cancel(self) -> None:
        if self._silence is not None:
            self._silence.cancel()
            self._silence = None

    def _reply(self, ask: Callable[[], list[bytes]]) -> None:
        try:
            replies = ask()
        except Exception:
            # A bug in one protocol must not end this link, nor the other links.
            log.exception("%s: the protocol failed; the bytes are dropped", self._wire.name)
            return
        for reply in replies:
            self._write(reply)
        if self._session.closed:
            self._hang_up()
