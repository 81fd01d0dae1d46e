"""`rotator stop` goes a short way: it loads next to nothing, and finds the box where the whole program would.

Anything unusual goes the long way, which says what is wrong.
"""

from __future__ import annotations

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
from rotator.cli.reach import monitors
from rotator.config.places import console_path
from rotator.orders import Stop
from rotator.protocols.console import encode, parse
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
    assert encode(Stop(latch=True)) == stop.STOP
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
    "arguments", [["--help"], ["now"], ["--config"], ["--config", "missing.toml"], ["--config", "a", "b"], ["-h"]]
)
def test_the_unusual_goes_the_long_way(arguments: list[str]) -> None:
    assert not stop.stop_at_once(arguments)


@pytest.mark.parametrize("text", ["[state", "state = 3", "[state]\npath = 3", "[monitor]\npath = []", "\x00"])
def test_a_damaged_file_goes_the_long_way(tmp_path: Path, text: str) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(text)
    assert not stop.stop_at_once(["--config", str(config)])


def test_a_refusal_goes_the_long_way_which_prints_it(tmp_path: Path) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    with console(tmp_path / "console", b"error not now\n"):
        assert not stop.stop_at_once(["--config", str(config)])


def test_no_box(rotator: Callable[..., Any], config: Path) -> None:
    done = rotator("stop", "--config", config)
    assert done.returncode == 1
    assert done.stderr.startswith("rotator: no box is running with a console at ")


def test_it_loads_neither_the_model_nor_the_command_line(tmp_path: Path) -> None:
    """Both take most of a second on a Pi."""
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    with console(tmp_path / "console", b"ok\n"):
        done = subprocess.run(
            [sys.executable, "-X", "importtime", "-m", "rotator", "stop", "--config", str(config)],
            capture_output=True,
            text=True,
            check=True,
        )
    assert done.stdout == f"{stop.STOPPED}\n"
    loaded = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines() if "import time:" in line}
    assert loaded & {"pydantic", "click", "asyncio", "rich", "rotator.config.model", "rotator.orders"} == set()
