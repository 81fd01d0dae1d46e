"""A program that may have few files open, with more clients than that: it says so once, and serves those it has."""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import resource
import select
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import ExitStack, suppress
from pathlib import Path

import pytest

from rotator.runtime.open_files import ENOUGH_FILES, NO_MORE, allow_enough, say_it_once
from tests.boxes import file_with_page, free_port, greets

PATIENCE_S = 60.0
FEW, MANY = 60, 90
LIMITED = f"""
import os, resource, sys
resource.setrlimit(resource.RLIMIT_NOFILE, ({FEW}, {FEW}))
os.execv(sys.argv[1], sys.argv[1:])
"""


def ask(client: socket.socket, line: bytes) -> bytes:
    client.sendall(line)
    return client.recv(4096)


@pytest.mark.quiet
@pytest.mark.parametrize("crowded", ["link", "page"])
def test_a_crowd_larger_than_the_limit_fills_no_log_and_keeps_no_client_from_a_stop(
    tmp_path: Path, crowded: str
) -> None:
    link, page = free_port(), free_port()
    file = tmp_path / "r.toml"
    file.write_text(file_with_page(tmp_path, page, f'[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{link}"\n'))
    command = (sys.executable, "-m", "rotator", "run", "--plain", "--config", str(file))
    errors = tmp_path / "errors"
    with errors.open("wb") as said, ExitStack() as crowd:
        box = subprocess.Popen(
            [sys.executable, "-c", LIMITED, *command], stdout=subprocess.PIPE, stderr=said, cwd=tmp_path
        )
        crowd.enter_context(box)
        crowd.callback(box.terminate)
        assert box.stdout is not None
        assert greets(box.stdout)
        program = crowd.enter_context(socket.create_connection(("127.0.0.1", link), PATIENCE_S))
        assert ask(program, b"P 300 80\n") == b"RPRT 0\n"
        # The page loads its modules, which are files too, behind its open port.
        with urllib.request.urlopen(f"http://127.0.0.1:{page}/api/me", timeout=PATIENCE_S) as loaded:
            assert loaded.status == 200
        for _ in range(MANY):
            crowd.enter_context(
                socket.create_connection(("127.0.0.1", link if crowded == "link" else page), PATIENCE_S)
            )
        give_up_s = time.monotonic() + PATIENCE_S
        while "has to wait" not in errors.read_text():
            assert time.monotonic() < give_up_s, errors.read_text()
            assert ask(program, b"p\n")
        assert ask(program, b"S\n") == b"RPRT 0\n"
    assert box.returncode == 0
    assert "a new connection has to wait: Too many open files" in errors.read_text()
    assert "Traceback" not in errors.read_text()
    assert len(errors.read_text().splitlines()) < 10


@pytest.mark.quiet
def test_what_finds_no_file_for_a_moment_comes_back(tmp_path: Path) -> None:
    """The limit sinks below what is open, and rises again. Meanwhile the program that is connected is served; what
    ended for lack of a file, the page and the terminal that its program has left, works as before."""
    link, page = free_port(), free_port()
    file = tmp_path / "r.toml"
    links = f'[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{link}"\n[[link]]\nprotocol = "gs232b"\npty = "gs"\n'
    file.write_text(file_with_page(tmp_path, page, links))
    errors = tmp_path / "errors"
    with errors.open("wb") as said, ExitStack() as opened:
        box = opened.enter_context(
            subprocess.Popen(
                [sys.executable, "-m", "rotator", "run", "--plain", "--config", str(file)],
                stdout=subprocess.PIPE,
                stderr=said,
                cwd=tmp_path,
            )
        )
        opened.callback(box.terminate)
        assert box.stdout is not None
        assert greets(box.stdout)
        program = opened.enter_context(socket.create_connection(("127.0.0.1", link), PATIENCE_S))
        with urllib.request.urlopen(f"http://127.0.0.1:{page}/api/me", timeout=PATIENCE_S) as loaded:
            assert loaded.status == 200
        limit = resource.prlimit(box.pid, resource.RLIMIT_NOFILE)
        resource.prlimit(box.pid, resource.RLIMIT_NOFILE, (3, limit[1]))
        # A program that leaves with an answer unread: the terminal is made anew.
        terminal = os.open(tmp_path / "gs", os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        os.write(terminal, b"C2\r" * 10)
        assert select.select([terminal], [], [], PATIENCE_S)[0]
        os.close(terminal)
        give_up_s = time.monotonic() + PATIENCE_S
        while not ("gs has to wait" in errors.read_text() and "page: it has failed" in errors.read_text()):
            assert time.monotonic() < give_up_s, errors.read_text()
            assert ask(program, b"p\n")
        resource.prlimit(box.pid, resource.RLIMIT_NOFILE, limit)
        answers: set[str] = set()
        while answers != {"page", "link", "pty"}:
            assert time.monotonic() < give_up_s, answers
            with suppress(OSError), urllib.request.urlopen(f"http://127.0.0.1:{page}/api/me", timeout=PATIENCE_S):
                answers.add("page")
            with suppress(OSError), socket.create_connection(("127.0.0.1", link), PATIENCE_S) as another:
                answers |= {"link"} if ask(another, b"p\n") else set()
            if (tmp_path / "gs").exists():
                answers.add("pty")
        assert ask(program, b"S\n") == b"RPRT 0\n"
    assert box.returncode == 0
    assert len([row for row in errors.read_text().splitlines() if " E " in row or " W " in row]) < 10


@pytest.mark.parametrize("number", NO_MORE)
def test_it_is_said_once_a_minute(number: int, caplog: pytest.LogCaptureFixture) -> None:
    now_s = [0.0]

    async def meet() -> None:
        events = asyncio.get_running_loop()
        say_it_once(events, lambda: now_s[0])
        for now_s[0] in (1.0, 2.0, 3.0, 70.0):
            events.call_exception_handler({"message": "socket.accept()", "exception": OSError(number, "no more")})

    asyncio.run(meet())
    assert ["has to wait" in record.message for record in caplog.records] == [True, True]
    assert caplog.records[-1].message.endswith("(2 similar lines before this one are not shown)")


@pytest.mark.parametrize("fault", [ValueError("a bug"), OSError(errno.EIO, "broken")])
def test_another_failure_keeps_its_traceback(fault: Exception, caplog: pytest.LogCaptureFixture) -> None:
    async def meet() -> None:
        say_it_once(asyncio.get_running_loop())
        asyncio.get_running_loop().call_exception_handler({"message": "in a callback", "exception": fault})

    with caplog.at_level(logging.ERROR):
        asyncio.run(meet())
    (record,) = caplog.records
    assert record.exc_info


def test_it_allows_itself_enough() -> None:
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (256, before[1]))
        allow_enough()
        assert resource.getrlimit(resource.RLIMIT_NOFILE)[0] == min(ENOUGH_FILES, before[1])
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)
