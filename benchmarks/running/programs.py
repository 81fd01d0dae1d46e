"""The programs at the other ends of a running box's links: they ask, order, and hear.

Knows sockets, pseudo-terminals and files. Does not know what the bytes mean.
"""

from __future__ import annotations

import asyncio
import os
import socket
import tty
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress

from benchmarks.running.box import Box
from benchmarks.running.words import STOP, Words
from rotator.protocols.pstrotator import ANSWERS_ABOVE

MOST_HEARD = 65_536


class Program:
    """One program on one link: open it, talk, close it."""

    def __init__(self, box: Box, words: Words) -> None:
        self.words = words
        self._box = box
        self._heard = bytearray()
        self._news = asyncio.Event()

    async def open(self) -> None:
        """Raises OSError."""

    def send(self, data: bytes) -> None:
        raise NotImplementedError

    def close(self) -> None:
        """The program has gone."""

    async def hears(self, patience_s: float) -> bool:
        """Ask, where the protocol has a question, and wait for its answer. False: there is none, or a wrong one."""
        self._heard.clear()
        try:
            async with asyncio.timeout(patience_s):
                if self.words.question:
                    self.send(self.words.question)
                while self.words.has not in self._heard:
                    self._news.clear()
                    await self._news.wait()
        except (OSError, TimeoutError):
            return False
        return True

    def _take(self, data: bytes) -> None:
        self._heard += data
        del self._heard[:-MOST_HEARD]
        self._news.set()


class TcpProgram(Program):
    _writer: asyncio.StreamWriter | None = None
    _reading: asyncio.Task[None] | None = None

    async def open(self) -> None:
        reader, self._writer = await asyncio.open_connection("127.0.0.1", self._box.ports[self.words.protocol])
        self._reading = asyncio.create_task(self._read(reader))

    async def _read(self, reader: asyncio.StreamReader) -> None:
        with suppress(OSError):
            while data := await reader.read(4096):
                self._take(data)

    def send(self, data: bytes) -> None:
        assert self._writer is not None
        self._writer.write(data)

    def close(self) -> None:
        if self._writer is not None and self._reading is not None:
            self._reading.cancel()
            self._writer.close()


class TerminalProgram(Program):
    """On the pseudo-terminal, or at our end of the serial line, which stays open."""

    _fd = -1

    async def open(self) -> None:
        self._fd = self._box.serial
        if self.words.place == "pty":
            self._fd = os.open(self._box.place(self.words.protocol), os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
            tty.setraw(self._fd)
        asyncio.get_running_loop().add_reader(self._fd, self._read)

    def _read(self) -> None:
        with suppress(OSError):
            self._take(os.read(self._fd, 4096))

    def send(self, data: bytes) -> None:
        os.write(self._fd, data)

    def close(self) -> None:
        if self._fd >= 0:
            asyncio.get_running_loop().remove_reader(self._fd)
            if self.words.place == "pty":
                os.close(self._fd)


class DatagramProgram(Program):
    """Sends to the link's port, and hears what comes to the port above it."""

    _socket: socket.socket | None = None

    async def open(self) -> None:
        self._socket = socket.socket(type=socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._socket.bind(("127.0.0.1", self._box.ports[self.words.protocol] + ANSWERS_ABOVE))
        asyncio.get_running_loop().add_reader(self._socket, self._read)

    def _read(self) -> None:
        assert self._socket is not None
        with suppress(OSError):
            self._take(self._socket.recv(4096))

    def send(self, data: bytes) -> None:
        assert self._socket is not None
        self._socket.sendto(data, ("127.0.0.1", self._box.ports[self.words.protocol]))

    def close(self) -> None:
        if self._socket is not None:
            asyncio.get_running_loop().remove_reader(self._socket)
            self._socket.close()


class FileProgram(Program):
    def send(self, data: bytes) -> None:
        self._box.place(self.words.protocol).write_bytes(data)


class FollowedProgram(Program):
    """A rotctld that the box asks all along: what is sent is its position from then on."""

    _server: asyncio.Server | None = None
    _position = b"200.00\n0.00\n"

    def __init__(self, box: Box, words: Words) -> None:
        super().__init__(box, words)
        self._asking: set[asyncio.StreamWriter] = set()

    async def open(self) -> None:
        port = self._box.ports[self.words.protocol]
        self._server = await asyncio.start_server(self._answer, "127.0.0.1", port)

    async def _answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._asking.add(writer)
        with suppress(OSError):
            while question := await reader.readline():
                self._take(question)
                writer.write(self._position)
        self._asking.discard(writer)
        writer.close()

    def send(self, data: bytes) -> None:
        self._position = data

    def close(self) -> None:
        if self._server is not None:
            self._server.close()
        for writer in self._asking:
            writer.transport.abort()


PROGRAMS: dict[str, Callable[[Box, Words], Program]] = {
    "tcp": TcpProgram,
    "pty": TerminalProgram,
    "serial": TerminalProgram,
    "udp": DatagramProgram,
    "file": FileProgram,
    "connect": FollowedProgram,
}
"""By the place of a link."""


@asynccontextmanager
async def program(box: Box, protocol: str) -> AsyncIterator[Program]:
    """A program that comes, and leaves again. Raises OSError."""
    words = box.words[protocol]
    each = PROGRAMS[words.place](box, words)
    try:
        await each.open()
        yield each
    finally:
        each.close()


async def heard(box: Box, protocol: str, patience_s: float) -> bool:
    """By a program that comes for one question."""
    async with program(box, protocol) as each:
        return await each.hears(patience_s)


async def stop(box: Box, patience_s: float) -> None:
    async with program(box, "rotctld") as each:
        each.send(STOP)
        await each.hears(patience_s)
