"""A terminal that takes nothing (Ctrl-S, a stalled ssh, a full pipe) holds up no order, and no end of the program."""

from __future__ import annotations

import os
import pty
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from rotator.cli.output import LINES, Output
from tests.boxes import free_port

PATIENCE_S = 20.0
FULL_POLLS = 400
"""Questions, one after the other, while the picture fills the terminal."""


class Client:
    """rotctld's client: a question, and its answer."""

    def __init__(self, port: int) -> None:
        for _ in range(int(PATIENCE_S / 0.1)):
            try:
                self._socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)
                break
            except ConnectionRefusedError:
                threading.Event().wait(0.1)
        self._lines = self._socket.makefile("r", encoding="ascii")

    def ask(self, words: str, lines: int = 1) -> list[str]:
        self._socket.sendall(f"{words}\n".encode())
        return [self._lines.readline().strip() for _ in range(lines)]

    def azimuth_deg(self) -> float:
        """Asks again where the sensors have not given a reading yet: then the answer is one line."""
        while (first := self.ask("p")[0]).startswith("RPRT"):
            threading.Event().wait(0.05)
        self._lines.readline()
        return float(first)

    def close(self) -> None:
        self._lines.close()
        self._socket.close()


@pytest.fixture
def unread(tmp_path: Path) -> Iterator[tuple[subprocess.Popen[bytes], Client]]:
    """A box whose terminal is never read."""
    port = free_port()
    config = tmp_path / "rotator.toml"
    config.write_text(
        f'[state]\npath = "{tmp_path / "state.json"}"\n[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{port}"\n',
        encoding="utf-8",
    )
    master, slave = pty.openpty()
    command = [sys.executable, "-m", "rotator", "run", "--config", str(config)]
    box = subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave)
    os.close(slave)
    client = Client(port)
    try:
        yield box, client
    finally:
        client.close()
        box.kill()
        box.wait(PATIENCE_S)
        os.close(master)


def test_a_stop_stops_and_sigterm_ends_while_the_terminal_is_not_read(
    unread: tuple[subprocess.Popen[bytes], Client],
) -> None:
    box, client = unread
    assert client.ask("P 400 30") == ["RPRT 0"]
    began_deg = client.azimuth_deg()
    for _ in range(FULL_POLLS):
        # Every answer comes, however full the terminal is; each cycle of the picture is a fifth of a second.
        client.azimuth_deg()
        threading.Event().wait(0.02)
    assert client.azimuth_deg() > began_deg + 10.0, "it turns"
    assert client.ask("S") == ["RPRT 0"]
    threading.Event().wait(1.0)
    stood_deg = client.azimuth_deg()
    threading.Event().wait(1.0)
    assert client.azimuth_deg() == pytest.approx(stood_deg, abs=0.7), "a stop stops"
    box.send_signal(signal.SIGTERM)
    assert box.wait(PATIENCE_S) == 0


def test_a_writer_is_never_held_up_by_a_pipe_that_is_full() -> None:
    reader, writer = os.pipe()
    with os.fdopen(writer, "w", encoding="utf-8") as stream:
        output = Output(stream)

        def write() -> None:
            for _ in range(3 * LINES):
                output.write("x" * 10_000)
            output.close()
            output.close()

        work = threading.Thread(target=write, daemon=True)
        work.start()
        work.join(PATIENCE_S)
        assert not work.is_alive(), "it waits for the reader"
        # Without a reader every further write fails at once, and the stream's own thread ends.
        os.close(reader)
        output.close()
        assert output.ended


def test_what_is_written_arrives_in_order() -> None:
    reader, writer = os.pipe()
    with os.fdopen(writer, "w", encoding="utf-8") as stream:
        output = Output(stream)
        for number in range(100):
            output.write(f"{number}\n")
        output.close()
    with os.fdopen(reader, encoding="utf-8") as end:
        assert end.read().split() == [str(number) for number in range(100)]
