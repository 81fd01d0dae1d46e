"""`rotator stop` goes a short way: it loads next to nothing, and finds the box where the whole program would.

Anything unusual goes the long way, which says what is wrong.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from rotator.cli import stop
from rotator.cli.announced import announced
from rotator.cli.box import RunningBox
from rotator.cli.failed import CommandFailed
from rotator.cli.reach import monitors
from rotator.config.places import console_path
from rotator.exchange.orders import Stop
from rotator.protocols.console import parse
from rotator.protocols.console_session import OK


@contextmanager
def console(place: Path, answer: bytes) -> Iterator[list[bytes]]:
    """A box's console that gives one answer to one command."""
    heard: list[bytes] = []
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as server:
        server.bind(str(place))
        server.listen()

        def serve() -> None:
            user, _ = server.accept()
            with user:
                heard.append(user.recv(4096))
                user.sendall(answer)

        thread = threading.Thread(target=serve)
        thread.start()
        yield heard
        thread.join()


def test_it_says_what_the_console_understands() -> None:
    assert parse(stop.STOP.strip()) == Stop(latch=True)
    assert f"{OK}\n".encode() == stop.OK


@pytest.mark.parametrize(
    "text",
    [
        '[state]\npath = "{folder}/state.json"\n',
        '[monitor]\npath = "{folder}/north"\n[state]\npath = "elsewhere/state.json"\n',
        '[state]\npath = "{folder}/monitor"\n',
    ],
)
def test_it_looks_where_the_whole_program_looks(tmp_path: Path, text: str) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(text.format(folder=tmp_path))
    place = console_path(monitors(config)[0])
    with console(place, b"ok\n") as heard:
        assert stop.stop_at_once(["--config", str(config)])
    assert heard == [b"stop\n"]


@pytest.mark.parametrize(
    "arguments",
    [["--help"], ["now", "--help"], ["--config"], ["--config", "missing.toml"], ["--config", "a", "--yes"], ["-h"]],
)
def test_the_unusual_goes_the_long_way(arguments: list[str]) -> None:
    assert not stop.stop_at_once(arguments)


@pytest.mark.parametrize("words", [["now"], ["azimuth", "please"], ["!"]])
def test_a_stop_counts_whatever_words_follow_it(tmp_path: Path, words: list[str]) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    with console(tmp_path / "console", b"ok\n") as heard:
        assert stop.stop_at_once(["--config", str(config), *words])
    assert heard == [b"stop\n"]


@pytest.mark.parametrize("text", ["[state", "state = 3", "[state]\npath = 3", "[monitor]\npath = []", "\x00"])
def test_a_damaged_file_goes_the_long_way(tmp_path: Path, text: str) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(text)
    assert not stop.stop_at_once(["--config", str(config)])


@pytest.mark.parametrize(("answer", "told"), [(b"error: not now\n", "error: not now"), (b"", "it has ended")])
def test_a_box_that_does_not_obey_is_told_in_capitals(tmp_path: Path, answer: bytes, told: str) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    with console(tmp_path / "console", answer), pytest.raises(CommandFailed, match=f"NOT STOPPED: .*{told}"):
        stop.stop_at_once(["--config", str(config)])


def test_two_boxes_are_both_stopped(tmp_path: Path) -> None:
    places = [tmp_path / "own", tmp_path / "service"]
    with console(places[0], b"ok\n") as own, console(places[1], b"ok\n") as service:
        stop.stop_boxes(places, all_of_them=True)
    assert own == service == [b"stop\n"]


def test_two_boxes_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `rotator stop` answers where the service runs, and a box that was begun in another folder."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("rotator.config.places.MONITOR_OF_THE_SERVICE", tmp_path / "service" / "monitor")
    (tmp_path / "shack").mkdir()
    (tmp_path / "service").mkdir()
    monkeypatch.chdir(tmp_path / "shack")
    places = [tmp_path / "shack" / "console", tmp_path / "service" / "console"]
    with console(places[0], b"ok\n"), console(places[1], b"ok\n"), announced(tmp_path / "shack" / "monitor", None):
        said = stop.stop_boxes(places, all_of_them=True)
    assert said.splitlines() == [
        "Stopped. Nothing moves until `rotator resume`.",
        f"2 boxes: the box in {tmp_path / 'shack'}; the service (--config /etc/rotator/rotator.toml).",
    ]


def test_a_file_names_one_box(tmp_path: Path) -> None:
    with console(tmp_path / "own", b"ok\n") as heard:
        stop.stop_boxes([tmp_path / "own", tmp_path / "service"], all_of_them=False)
    assert heard == [b"stop\n"]


def test_an_order_for_one_antenna_is_not_given_where_two_boxes_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("rotator.config.places.MONITOR_OF_THE_SERVICE", tmp_path / "service" / "monitor")
    with socket.socket(socket.AF_UNIX) as own, socket.socket(socket.AF_UNIX) as service:
        for server, folder in ((own, "run"), (service, "service")):
            (tmp_path / folder).mkdir()
            server.bind(str(tmp_path / folder / "console"))
            server.listen()
        with pytest.raises(
            CommandFailed,
            match=r"2 boxes run: the box of this folder; the service \(--config /etc/rotator/rotator\.toml\)",
        ):
            RunningBox(None)


@pytest.mark.parametrize("command", ["stop", "where", "monitor"])
@pytest.mark.parametrize(
    ("text", "mistake"),
    [
        ('[monitor]\npath = "/"\n', 'monitor.path: "/" is a folder'),
        ("a = " + "[" * 20_000 + "]" * 20_000, "too many brackets"),
        ("[azimuth]\nmax_deg = " + "9" * 5000, "thousands of digits"),
    ],
)
def test_no_box_and_a_file_that_does_not_say_where_it_would_be(
    rotator_here: Callable[..., Any], tmp_path: Path, command: str, text: str, mistake: str
) -> None:
    (tmp_path / "r.toml").write_text(text)
    done = rotator_here(command, "--config", tmp_path / "r.toml")
    assert done.returncode == 2
    assert mistake in done.stderr


def test_a_reader_that_has_gone_is_no_traceback(tmp_path: Path) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    closed, full = os.pipe()
    os.close(closed)
    with console(tmp_path / "console", b"ok\n"):
        done = subprocess.run(
            [sys.executable, "-m", "rotator", "stop", "--config", str(config)],
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    os.close(full)
    assert (done.returncode, done.stderr) == (0, f"rotator: {stop.STOPPED}\n".encode()), "it has stopped, and says so"
