"""A wire between a tracking program and the box that writes down what the program says, and when.

Knows TCP and lines. Knows no protocol, and changes nothing.
"""

from __future__ import annotations

import contextlib
import select
import socket
import socketserver
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

PIECE = 4096


@dataclass(frozen=True, slots=True)
class Said:
    at_s: float
    """On the clock of time.monotonic."""
    text: str


@dataclass(slots=True)
class Call:
    """One connection of the program's."""

    said: list[Said] = field(default_factory=list)
    """One entry for each of its writes."""
    ended: bool = False
    """The program has closed it."""


@dataclass(slots=True)
class Tap:
    port: int
    calls: list[Call] = field(default_factory=list)

    def said(self, command: str, since_s: float = 0.0) -> list[Said]:
        """What it said on all its connections that begins with `command`."""
        return [
            said for call in self.calls for said in call.said if said.text.startswith(command) and said.at_s > since_s
        ]


@contextmanager
def tapped(box_port: int) -> Iterator[Tap]:
    """Listens on a port of its own while it lasts; whoever connects there talks to the box."""

    class Wire(socketserver.BaseRequestHandler):
        def handle(self) -> None:
            call = Call()
            tap.calls.append(call)
            with socket.create_connection(("127.0.0.1", box_port)) as box, contextlib.suppress(ConnectionError):
                _carry(self.request, box, call, over)
            call.ended = True

    over = threading.Event()
    with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Wire) as server:
        tap = Tap(server.server_address[1])
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
        thread.start()
        try:
            yield tap
        finally:
            over.set()
            server.shutdown()
            thread.join()


def _carry(program: socket.socket, box: socket.socket, call: Call, over: threading.Event) -> None:
    while not over.is_set():
        ready, _, _ = select.select([program, box], [], [], 0.05)
        for end in ready:
            data = end.recv(PIECE)
            if not data:
                return
            if end is program:
                call.said.append(Said(time.monotonic(), data.decode("latin-1")))
            (box if end is program else program).sendall(data)
