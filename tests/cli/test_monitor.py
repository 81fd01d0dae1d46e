"""`rotator monitor` as a user meets it: live, to a file, and what it says when it cannot."""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rotator.monitor.transcript import Piece, Way, parse
from tests.boxes import free_port

Start = Callable[..., Any]
Rotator = Callable[..., Any]
Send = Callable[[bytes], None]


@pytest.fixture
def box(start: Start, config: Path) -> Any:
    """A running box with a second link, and its file."""
    port = free_port()
    with config.open("a") as file:
        file.write(f'[[link]]\nname = "shack"\nprotocol = "rotctld"\ntcp = "127.0.0.1:{port}"\n')
    running = start("run", "--config", config)
    running.until("elevation 0°\n")
    running.port = port
    return running


def ask_rotctld(port: int) -> None:
    with socket.create_connection(("127.0.0.1", port)) as client:
        client.sendall(b"p\n")
        assert client.recv(64).count(b"\n") == 2


def pieces(text: str) -> list[tuple[str, Way, bytes]]:
    entries = [parse(line) for line in text.splitlines()]
    return [(str(each.source), each.way, each.data) for each in entries if isinstance(each, Piece)]


def test_live(box: Any, start: Start, config: Path, send: Send) -> None:
    monitor = start("monitor", "--config", config)
    greeting = monitor.until(r"# at [-0-9][^\n]*\n")
    assert '# link gs232b {"protocol": "gs232b", "pty": "gs232"}\n' in greeting
    assert "# `at`: azimuth and elevation, degrees on the rotor's own scale\n" in greeting
    assert "# h:m:s here  link#connection  > received, < sent  bytes\n" in greeting
    send(b"C2\r")
    heard = monitor.until(r"gs232b#1 < [^\n]*\n")
    assert pieces(heard) == [
        ("gs232b#1", Way.IN, b"C2\r"),
        ("gs232b#1", Way.OUT, b"AZ=000  EL=000\r\n"),
    ]
    assert monitor.stop() == 0
    assert "Traceback" not in monitor.errors
    assert box.stop() == 0


def test_one_link_of_several(box: Any, start: Start, config: Path, send: Send) -> None:
    monitor = start("monitor", "--config", config, "--link", "shack")
    monitor.until(r"# at [-0-9][^\n]*\n")
    send(b"C2\r")
    ask_rotctld(box.port)
    heard = monitor.until(r"< [^\n]*\n")
    assert {source for source, _, _ in pieces(heard)} == {"shack#1"}
    assert monitor.stop() == 0


def test_it_ends_with_the_box(box: Any, start: Start, config: Path) -> None:
    monitor = start("monitor", "--config", config)
    monitor.until(r"# at [-0-9][^\n]*\n")
    assert box.stop() == 0
    assert monitor.ends() == 0
    assert monitor.errors == "the box has ended\n"


def test_to_a_file(box: Any, start: Start, config: Path, send: Send, tmp_path: Path) -> None:
    recording = tmp_path / "record.txt"
    recorder = start("monitor", "--config", config, "--to", recording.name)
    while not recording.exists() or "# at" not in recording.read_text():
        assert recorder.process.poll() is None
    send(b"C2\r")
    while "AZ=" not in recording.read_text():
        assert recorder.process.poll() is None
    assert recorder.stop() == 0
    text = recording.read_text()
    assert pieces(text) == [("gs232b#1", Way.IN, b"C2\r"), ("gs232b#1", Way.OUT, b"AZ=000  EL=000\r\n")]
    assert text.endswith("# stopped\n")


def test_a_file_that_is_full_says_so(box: Any, start: Start, config: Path, send: Send, tmp_path: Path) -> None:
    recorder = start("monitor", "--config", config, "--to", "record.txt", "--limit-mb", "0.001")
    while not (tmp_path / "record.txt").exists() or "# at" not in (tmp_path / "record.txt").read_text():
        assert recorder.process.poll() is None
    for _ in range(40):
        send(b"C2\r")
    assert recorder.ends() == 0
    text = (tmp_path / "record.txt").read_text()
    assert text.splitlines()[-1] == "# the file is full: 0.001 MB"
    assert 900 < len(text) < 1100
    assert recorder.errors.endswith("in record.txt: the file is full: 0.001 MB\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--link gs232c", "no link is called gs232c; there are: gs232b, shack"),
        ("--to mine.txt", "mine.txt is there already: give another name"),
        ("--to nowhere/x.txt", "nowhere/x.txt cannot be written to: No such file or directory"),
    ],
)
def test_what_it_cannot_do(box: Any, rotator: Rotator, config: Path, tmp_path: Path, *, words: str, said: str) -> None:
    (tmp_path / "mine.txt").write_text("mine\n")
    done = rotator("monitor", "--config", config, *words.split())
    assert (done.returncode, done.stderr) == (1, f"rotator: {said}\n")
    assert (tmp_path / "mine.txt").read_text() == "mine\n"
