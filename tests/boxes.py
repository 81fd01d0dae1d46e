"""What the files of boxes under test share: a fast rotor, a free port, a page.

Knows the text of such a file. Knows nothing of how a box is started, or of what a test asks of it.
"""

from __future__ import annotations

import socket
from itertools import islice
from pathlib import Path
from typing import IO

FAST_ROTOR = (Path(__file__).parent / "fast_rotor.toml").read_text(encoding="utf-8")
GREETING_LINES = 2


_GIVEN: set[int] = set()
"""Ports that a test of this process has got: the kernel may name one again before its box listens."""


def free_port() -> int:
    """A TCP port of this machine that nothing listens on, never the same one twice."""
    while True:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = int(probe.getsockname()[1])
        if port not in _GIVEN:
            _GIVEN.add(port)
            return port


def free_udp_ports() -> int:
    """A UDP port whose neighbour is free too."""
    while True:
        with socket.socket(type=socket.SOCK_DGRAM) as one, socket.socket(type=socket.SOCK_DGRAM) as neighbour:
            one.bind(("127.0.0.1", 0))
            port = int(one.getsockname()[1])
            try:
                neighbour.bind(("127.0.0.1", port + 1))
            except (OSError, OverflowError):
                continue
            return port


def file_with_page(folder: Path, port: int, more: str = "", page: str = "") -> str:
    """The file of a box with its page on `port`. `more`: text for its end; `page`: further keys of [page]."""
    return f"""
[rotor]
hardware = "sim"
[state]
path = "{folder}/state.json"
[page]
listen = "127.0.0.1:{port}"
{page}
[[link]]
protocol = "gs232b"
pty = "{folder}/gs232"
{FAST_ROTOR}
{more}
"""


def greets(said: IO[bytes] | IO[str]) -> bool:
    """Whether the first lines of `rotator run --plain` say that the rotor is simulated. It waits for them."""
    return any("SIMULATED" in str(line) for line in islice(said, GREETING_LINES))
