"""What one link carries, for whoever watches it; and the shell between a stream of bytes and a protocol.

Knows when bytes came and went, and when a line has fallen silent. Knows no device and no protocol.
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
    """A link cannot be opened; the text says which, and what to do."""


def reason(fault: OSError | UnicodeError) -> str:
    """Why an address cannot be listened at or reached, in the system's words."""
    match fault:
        case socket.gaierror():
            return fault.strerror or str(fault)
        case OSError(errno=int() as number):
            # asyncio wraps the system's words in many of its own.
            return os.strerror(number)
        case OSError():
            return str(fault)
        case _:
            return "no machine can have that name"


@dataclass(slots=True)
class Wire:
    """One link as a person sees it. The view reads it; the link writes it."""

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
    """One connection: bytes in, replies out through `write`, which sends each in one go or not at all.

    `hang_up` is called when the client has asked to end the connection; a line that cannot hang up does nothing.
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
        self._wire.came(data)
        self._reply(lambda: self._session.receive(data))
        if self._session.idle_s is not None:
            self._cancel()
            self._silence = asyncio.get_running_loop().call_later(self._session.idle_s, self._silent)

    def close(self) -> None:
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
            # A mistake of ours in one protocol must not take the link, or the other links, down with it.
            log.exception("%s: the protocol failed; the bytes are dropped", self._wire.name)
            return
        for reply in replies:
            self._wire.went(reply)
            self._write(reply)
        if self._session.closed:
            self._hang_up()
