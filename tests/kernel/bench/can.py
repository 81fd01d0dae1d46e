"""A CAN bus inside the kernel (vcan) that carries CAN FD frames.

Knows how it is made and taken away. Two sockets on it hear each other as two nodes on a wire would.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager

CAN_FD_MTU = 72


@contextmanager
def can_bus(name: str = "vcan0") -> Iterator[str]:
    """The name of the interface while it is up."""
    _ip("link", "add", "dev", name, "mtu", str(CAN_FD_MTU), "type", "vcan")
    try:
        _ip("link", "set", name, "up")
        yield name
    finally:
        _ip("link", "delete", name)


def _ip(*words: str) -> None:
    subprocess.run(["ip", *words], check=True, capture_output=True, text=True)
