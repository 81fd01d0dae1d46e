"""10,000 spellings of a number by Hamlib's own reader and by ours.

Debian's `rotctld -m 2` reads them, and passes what it has read to a server of this test in six decimals.
"""

from __future__ import annotations

import random
import socket
import subprocess
import threading
from collections.abc import Iterator
from contextlib import closing, suppress

import pytest

from rotator.protocols.rotctld import BadRequest, number
from tests.boxes import free_port
from tests.spelled import NO_NUMBERS, spelled

SPELLINGS = 10_000
AT_A_TIME = 100
FLOAT32 = 1e-4
"""Hamlib keeps an angle in four bytes: 24 bits of 450° are 0.00003°, and it prints six decimals."""
STATE = b"1\n2\nmin_az=-180.0\nmax_az=450.0\nmin_el=0.0\nmax_el=180.0\nsouth_zero=0\nrot_type=AzEl\ndone\n"


class Behind:
    """A server for Hamlib's NET rotctl: it notes where it is sent."""

    def __init__(self) -> None:
        self.sent: list[tuple[float, float]] = []
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        threading.Thread(target=self._serve, daemon=True).start()

    def _serve(self) -> None:
        with suppress(OSError), closing(self._listening), self._listening.accept()[0] as client:
            for line in client.makefile("rb"):
                match line.split():
                    case [b"\\dump_state"]:
                        client.sendall(STATE)
                        continue
                    case [b"P", azimuth, elevation]:
                        self.sent.append((float(azimuth), float(elevation)))
                client.sendall(b"RPRT 0\n")


@pytest.fixture
def hamlib() -> Iterator[tuple[Behind, socket.socket]]:
    behind, port = Behind(), free_port()
    words = ["rotctld", "-m", "2", "-r", f"127.0.0.1:{behind.port}", "-T", "127.0.0.1", "-t", str(port)]
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server:
        try:
            for _ in range(1000):
                with suppress(ConnectionRefusedError):
                    client = socket.create_connection(("127.0.0.1", port), timeout=10)
                    break
            with client:
                yield behind, client
        finally:
            server.kill()


def ask(client: socket.socket, lines: list[str]) -> list[bytes]:
    client.sendall("".join(f"{line}\n" for line in lines).encode())
    heard = b""
    while heard.count(b"\n") < len(lines):
        heard += client.recv(65536)
    return heard.splitlines()


def test_both_read_the_same(hamlib: tuple[Behind, socket.socket]) -> None:
    behind, client = hamlib
    seed = random.randrange(10**9)
    print(f"seed {seed}")  # noqa: T201
    rng = random.Random(seed)
    for _ in range(SPELLINGS // 2 // AT_A_TIME):
        pairs = [(spelled(rng, 449)[0], spelled(rng, 179)[0]) for _ in range(AT_A_TIME)]
        behind.sent.clear()
        comma = rng.choice(["", ","])
        assert ask(client, [f"P {az}{comma} {el}" for az, el in pairs]) == [b"RPRT 0"] * AT_A_TIME
        for (az, el), read in zip(pairs, behind.sent, strict=True):
            assert (number(az + comma), number(el)) == pytest.approx(read, abs=FLOAT32), (az, el)


def test_what_we_refuse_is_no_number_or_has_something_behind_it(hamlib: tuple[Behind, socket.socket]) -> None:
    """Hamlib takes the digits at the begin of `1x0` for a 1, and hexadecimal numbers: here a damaged digit never makes
    another order."""
    _, client = hamlib
    for text in NO_NUMBERS:
        with pytest.raises(BadRequest):
            number(text)
    taken = [text for text in NO_NUMBERS if ask(client, [f"P {text} 45"]) == [b"RPRT 0"]]
    assert set(taken) <= {"nan", "0x10", "1x0", "1O0", "1..5", "1.5.2", "1e", "1e+", "1_0"}
