"""A connection to another program's server, which the box asks again and again.

Knows how to connect, how to ask at the right rate, and how to wait for a server that is not there: longer each time.
Knows no protocol and decides nothing.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable

from rotator.links.wire import Wire, reason
from rotator.protocols.session import Inquiry, NotUnderstood

log = logging.getLogger(__name__)

READ_BYTES = 4096
SILENCE_S = 3.0
"""The longest time, in seconds, to connect or to answer: a rotctld gives up a slow controller after 1.8 s."""
FIRST_RETRY_S = 1.0
LONGEST_RETRY_S = 10.0


class AskingLink:
    """`inquiry` makes the conversation of one connection. `every_s`: the time between two questions."""

    def __init__(
        self,
        wire: Wire,
        host: str,
        port: int,
        inquiry: Callable[[], Inquiry],
        *,
        every_s: float,
        silence_s: float = SILENCE_S,
        retry_s: float = FIRST_RETRY_S,
    ) -> None:
        self.wire = wire
        self._host = host
        self._port = port
        self._inquiry = inquiry
        self._every_s = every_s
        self._silence_s = silence_s
        self._first_retry_s = self._retry_s = retry_s
        self._told: str | None = None

    async def open(self) -> None:
        """Nothing to do: `run` waits for the server."""

    async def run(self) -> None:
        clock = asyncio.get_running_loop().time
        try:
            while True:
                begun_s = clock()
                why, detail = await self._connect()
                self._tell(why, detail)
                self.wire.state = "waiting for it"
                if clock() - begun_s > LONGEST_RETRY_S:
                    self._retry_s = self._first_retry_s
                await asyncio.sleep(self._retry_s)
                self._retry_s = min(2 * self._retry_s, LONGEST_RETRY_S)
        finally:
            self.wire.state = "closed"

    def close(self) -> None:
        """Nothing to do: `run` closes what it has opened."""

    async def _connect(self) -> tuple[str, str]:
        """Connect and ask until the connection ends. Returns why it ended, and a detail for the log."""
        try:
            async with asyncio.timeout(self._silence_s):
                reader, writer = await asyncio.open_connection(self._host, self._port)
        except TimeoutError:
            return "cannot be reached", ": nobody answers there"
        except (OSError, UnicodeError) as fault:
            return "cannot be reached", f": {reason(fault)}"
        try:
            return await self._keep_asking(reader, writer)
        finally:
            writer.transport.abort()

    async def _keep_asking(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> tuple[str, str]:
        inquiry = self._inquiry()
        clock = asyncio.get_running_loop().time
        while True:
            asked_s = clock()
            question = inquiry.ask()
            try:
                async with asyncio.timeout(self._silence_s):
                    writer.write(question)
                    await self._hear_out(inquiry, reader)
            except TimeoutError:
                return f"gives no answer within {self._silence_s:g} s", ""
            except EOFError:
                return "has closed the connection", ""
            except NotUnderstood as fault:
                return "does not speak the protocol", f": {fault}"
            except OSError as fault:
                return "is gone", f": {reason(fault)}"
            self.wire.state = "open"
            self._tell(inquiry.trouble, "")
            await asyncio.sleep(max(0.0, asked_s + self._every_s - clock()))

    async def _hear_out(self, inquiry: Inquiry, reader: asyncio.StreamReader) -> None:
        """Raises EOFError, OSError, NotUnderstood."""
        whole = False
        while not whole:
            data = await reader.read(READ_BYTES)
            if not data:
                raise EOFError
            whole = inquiry.receive(data)

    def _tell(self, trouble: str, detail: str) -> None:
        """Log a trouble once when it begins, and once when it is over (empty text)."""
        if trouble == self._told:
            return
        self._told = trouble
        if trouble:
            log.warning("%s: %s:%d %s%s", self.wire.name, self._host, self._port, trouble, detail)
        else:
            log.info("%s: %s:%d answers", self.wire.name, self._host, self._port)
