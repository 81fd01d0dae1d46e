"""A TCP connection from the box to another program's server: the box sends a question at a fixed rate.

Knows how to connect, when to ask, and how long to wait before it connects again: longer after each failure. Does not
know the questions and the answers: an `Inquiry` does.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field

from rotator.links.wire import Waiting, Wire, reason
from rotator.protocols.session import Inquiry, NotUnderstood

log = logging.getLogger(__name__)

READ_BYTES = 4096
SILENCE_S = 3.0
"""Longest time to connect, or to answer a question. A rotctld itself gives up on a slow controller after 1.8 s."""
FIRST_RETRY_S = 1.0
LONGEST_RETRY_S = 10.0


@dataclass(eq=False)
class AskingLink(Waiting):
    """`inquiry` makes the protocol's side of a new connection. `every_s`: seconds between two questions."""

    wire: Wire
    host: str
    port: int
    inquiry: Callable[[], Inquiry]
    _: KW_ONLY
    every_s: float
    silence_s: float = SILENCE_S
    retry_s: float = FIRST_RETRY_S
    _asks: Inquiry | None = field(default=None, init=False)
    """What is asked; None: begin anew. It outlasts a connection that this side has cut for a bad answer, or for
        none: the server has gone on meanwhile, and what it said before still counts."""
    _wait_s: float = field(init=False)
    """Before it connects again."""
    _logged: str | None = field(default=None, init=False)
    """The trouble in the last log line; empty: that line said that the server answers."""

    def __post_init__(self) -> None:
        self._wait_s = self.retry_s

    async def run(self) -> None:
        clock = asyncio.get_running_loop().time
        try:
            while True:
                begun_s = clock()
                why, detail = await self._connect()
                self._tell(why, detail)
                self.wire.state = "waiting for it"
                if clock() - begun_s > LONGEST_RETRY_S:
                    self._wait_s = self.retry_s
                await asyncio.sleep(self._wait_s)
                self._wait_s = min(2 * self._wait_s, LONGEST_RETRY_S)
        finally:
            self.wire.state = "closed"

    async def _connect(self) -> tuple[str, str]:
        """Connect and ask until the connection ends. Returns the reason, and a detail for the log."""
        try:
            async with asyncio.timeout(self.silence_s):
                reader, writer = await asyncio.open_connection(self.host, self.port)
        except TimeoutError:
            self._asks = None  # it may have been started anew
            return "cannot be reached", f": no answer within {self.silence_s:g} s"
        except (OSError, UnicodeError) as fault:
            self._asks = None
            return "cannot be reached", f": {reason(fault)}"
        try:
            return await self._keep_asking(reader, writer)
        finally:
            writer.transport.abort()

    async def _keep_asking(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> tuple[str, str]:
        """Ask until the connection ends. Returns the reason, and a detail for the log."""
        inquiry, self._asks = self._asks or self.inquiry(), None
        clock = asyncio.get_running_loop().time
        while True:
            asked_s = clock()
            question = inquiry.ask()
            try:
                async with asyncio.timeout(self.silence_s):
                    writer.write(question)
                    await self._read_answer(inquiry, reader)
            except TimeoutError:
                self._asks = inquiry
                return f"gives no answer within {self.silence_s:g} s", ""
            except EOFError:
                return "has closed the connection", ""
            except NotUnderstood as fault:
                self._asks = inquiry
                return "does not speak the protocol", f": {fault}"
            except OSError as fault:
                return "is gone", f": {reason(fault)}"
            self.wire.state = "open"
            self._tell(inquiry.trouble, "")
            await asyncio.sleep(max(0.0, asked_s + self.every_s - clock()))

    async def _read_answer(self, inquiry: Inquiry, reader: asyncio.StreamReader) -> None:
        """Read until the answer is complete. Raises EOFError, OSError, NotUnderstood."""
        complete = False
        while not complete:
            data = await reader.read(READ_BYTES)
            if not data:
                raise EOFError
            complete = inquiry.receive(data)

    def _tell(self, trouble: str, detail: str) -> None:
        """Log a trouble once when it begins, and its end once. `trouble` empty: the server answers."""
        if trouble == self._logged:
            return
        self._logged = trouble
        if trouble:
            log.warning("%s: %s:%d %s%s", self.wire.name, self.host, self.port, trouble, detail)
        else:
            log.info("%s: %s:%d answers", self.wire.name, self.host, self.port)
