"""Programs that go away without a word, on a running box: what they began without an end, ends."""

from __future__ import annotations

import os
import select
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.foreign.conftest import RunningBox

Start = Callable[..., "RunningBox"]
PATIENCE_S = 60.0
SLOW = "[sim.azimuth]\nspeed_dps = 6.0\n"
"""75 s from end to end: long enough to see that it stands before the end."""


class Listener:
    """A connection of its own, that only asks."""

    def __init__(self, port: int) -> None:
        self._socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)
        self._answers = self._socket.makefile("rb")

    def azimuth_deg(self) -> float:
        self._socket.sendall(b"p\n")
        azimuth, _ = self._answers.readline(), self._answers.readline()
        return float(azimuth)

    def until(self, done: Callable[[float], bool], why: str) -> float:
        give_up_s = time.monotonic() + PATIENCE_S
        while not done(angle_deg := self.azimuth_deg()):
            assert time.monotonic() < give_up_s, f"{why}: {angle_deg}"
            time.sleep(0.05)
        return angle_deg

    def stands(self, why: str) -> float:
        """Wait until the antenna stands."""
        seen = [(time.monotonic(), self.azimuth_deg())]

        def still(angle_deg: float) -> bool:
            now_s = time.monotonic()
            if abs(angle_deg - seen[-1][1]) > 1.0:
                seen.append((now_s, angle_deg))
            return now_s - seen[-1][0] > 2.0

        return self.until(still, why)

    def close(self) -> None:
        self._answers.close()
        self._socket.close()


@pytest.mark.parametrize("model", [2, 603])
def test_the_jog_of_a_killed_program_ends(
    start_box: Start, need_program: Callable[[str, str], str], model: int
) -> None:
    """`rotctl` with its prompt open, killed while the antenna turns."""
    box = start_box(extra=SLOW)
    where = f"127.0.0.1:{box.rotctld_port}" if model == 2 else str(box.pty)
    rotctl = subprocess.Popen(
        [need_program("rotctl", "libhamlib-utils"), "-m", str(model), "-r", where],
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
    )
    ear = Listener(box.rotctld_port)
    try:
        assert rotctl.stdin is not None
        rotctl.stdin.write(b"M 16 -1\n")
        rotctl.stdin.flush()
        ear.until(lambda angle_deg: angle_deg > 10.0, "it does not turn")
    finally:
        rotctl.kill()
        rotctl.wait()
        if rotctl.stdin is not None:
            rotctl.stdin.close()
    assert ear.stands("it turns on") < 440.0
    ear.close()
    assert box.stop(signal.SIGTERM) == 0


CHILD = """
import os, sys
port = os.open(sys.argv[1], os.O_RDWR | os.O_NOCTTY)
for count in range(2000):
    os.write(port, b"C2\\r")
for count in range(20):
    os.write(port, b"W%03d 030\\r" % (100 + count))
print("ready", flush=True)
sys.stdin.read()
"""


def test_a_program_started_after_another_link_s_stop_is_heard_and_hears_only_its_own(start_box: Start) -> None:
    box = start_box(extra=SLOW)
    first = subprocess.Popen([sys.executable, "-c", CHILD, str(box.pty)], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    ear = Listener(box.rotctld_port)
    try:
        assert first.stdout is not None
        assert first.stdout.readline() == b"ready\n"
        ear.until(lambda angle_deg: angle_deg > 5.0, "it does not turn")
        with socket.create_connection(("127.0.0.1", box.rotctld_port), timeout=PATIENCE_S) as other:
            other.sendall(b"S\n")
            assert other.recv(64) == b"RPRT 0\n"
    finally:
        first.kill()
        first.wait()
        for pipe in (first.stdin, first.stdout):
            if pipe is not None:
                pipe.close()
    stood_deg = ear.stands("it is not stopped")
    port = _open(box.pty)
    try:
        os.write(port, b"!\r")
        assert _read(port) == b"?>\r\n", "an answer to the last program"
        os.write(port, b"W200 030\r")
        ear.until(lambda angle_deg: angle_deg > stood_deg + 10.0, "its order has no effect")
    finally:
        os.close(port)
    ear.close()
    assert box.stop() == 0


def _open(path: Path) -> int:
    return os.open(path, os.O_RDWR | os.O_NOCTTY)


def _read(port: int) -> bytes:
    ready, _, _ = select.select([port], [], [], PATIENCE_S)
    assert ready, "no answer"
    return os.read(port, 65_536)
