"""What the files of boxes under test share: a fast rotor, a free port, a page.

Knows the text of such a file. Knows nothing of how a box is started, or of what a test asks of it.
"""

from __future__ import annotations

import random
import socket
from itertools import islice
from pathlib import Path
from typing import IO

FAST_ROTOR = (Path(__file__).parent / "fast_rotor.toml").read_text(encoding="utf-8")
GREETING_LINES = 2

PORTS = range(20_000, 32_000)
"""Below those that the kernel gives to whoever connects: such a one may be taken before its box listens."""
_CHANCE = random.SystemRandom()
"""No two workers draw the same ones, whatever their seed."""
_GIVEN: set[int] = set()
"""Ports that a test of this process has got: its box may not listen yet."""


def free_port() -> int:
    """A TCP port of this machine that nothing listens on, never the same one twice."""
    while True:
        port = _CHANCE.choice(PORTS)
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
        if port not in _GIVEN:
            _GIVEN.add(port)
            return port


def free_udp_ports() -> int:
    """A UDP port whose neighbour is free too."""
    while True:
        with socket.socket(type=socket.SOCK_DGRAM) as one, socket.socket(type=socket.SOCK_DGRAM) as neighbour:
            port = _CHANCE.choice(PORTS)
            try:
                one.bind(("127.0.0.1", port))
                neighbour.bind(("127.0.0.1", port + 1))
            except OSError:
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
