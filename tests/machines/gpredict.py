"""Gpredict's bytes, and the rotctld that it sends them to: Hamlib's dummy rotor, whose position the box follows.

Knows two lines of rotctld's protocol and a process. The dummy turns at 6°/s and stops at once: ramps with corners.
"""

from __future__ import annotations

import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager

PATIENCE_S = 30.0


class Gpredict:
    """`send` as its rotator window does: `P`, with two decimals, and an answer before the next line."""

    def __init__(self, port: int) -> None:
        self._socket = _connect(port)
        self._lines = self._socket.makefile("r", encoding="ascii", newline="\n")

    def send(self, azimuth_deg: float, elevation_deg: float) -> None:
        self._ask(f"P {azimuth_deg:.2f} {elevation_deg:.2f}\n")
        assert self._lines.readline().strip() == "RPRT 0"

    def stop(self) -> None:
        self._ask("S\n")
        assert self._lines.readline().strip() == "RPRT 0"

    def park(self) -> None:
        """Not Gpredict's: `rotctl` has it."""
        self._ask("K\n")
        assert self._lines.readline().strip() == "RPRT 0"

    def read(self) -> tuple[float, float]:
        self._ask("p\n")
        return float(self._lines.readline()), float(self._lines.readline())

    def close(self) -> None:
        self._lines.close()
        self._socket.close()

    def _ask(self, line: str) -> None:
        self._socket.sendall(line.encode("ascii"))


@contextmanager
def dummy_rotor(rotctld: str, port: int) -> Iterator[Gpredict]:
    """Debian's `rotctld -m 1` on that port, and Gpredict connected to it."""
    server = subprocess.Popen(
        [rotctld, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        client = Gpredict(port)
        try:
            yield client
        finally:
            client.close()
    finally:
        server.kill()
        server.wait()


def _connect(port: int) -> socket.socket:
    give_up_s = time.monotonic() + PATIENCE_S
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)
        except ConnectionRefusedError:
            assert time.monotonic() < give_up_s, "rotctld does not listen"
            time.sleep(0.05)
