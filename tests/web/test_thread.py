"""The thread of the page: a page that has failed takes no connection any more, and says so."""

from __future__ import annotations

import errno
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from rotator.box.app import App
from rotator.config.load import parse
from rotator.runtime.event_watch import EventWatch
from rotator.store.paired import FILE_NAME
from rotator.web.build import build_pairings
from rotator.web.thread import PAGE_THREAD, PageThread
from tests.boxes import file_with_page, free_port
from tests.web.conftest import page_of

PATIENCE_S = 30.0


def test_its_event_loop_is_watched_from_its_start_to_its_end(tmp_path: Path) -> None:
    port = free_port()
    config = parse(file_with_page(tmp_path, port), "test")
    events = EventWatch(lambda: 0.0)
    page = page_of(App(config), events=events)
    assert events.stalled_s(100.0) == 0.0, "it has not begun"
    page.start()
    try:
        with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as browser:
            browser.sendall(b"GET /api/me HTTP/1.1\r\nHost: localhost\r\n\r\n")
            assert browser.recv(12) == b"HTTP/1.1 200"
        assert events.stalled_s(100.0) == 100.0
    finally:
        page.stop()
    assert events.stalled_s(100.0) == 0.0, "a page that has ended is not watched"


def test_a_box_that_ends_while_its_page_still_loads_has_nothing_to_say(caplog: pytest.LogCaptureFixture) -> None:
    """A small Pi loads its libraries for seconds: the end of the box does not wait for that."""
    loads, goes_on = threading.Event(), threading.Event()

    def build() -> Any:
        loads.set()
        goes_on.wait(PATIENCE_S)

    page = PageThread("127.0.0.1", free_port(), build, [], lambda: 0.0, events=EventWatch(lambda: 0.0))
    page.start()
    loads.wait(PATIENCE_S)
    (thread,) = [each for each in threading.enumerate() if each.name == PAGE_THREAD]
    page.stop()
    goes_on.set()
    thread.join(PATIENCE_S)
    assert not thread.is_alive()
    assert caplog.records == []


@pytest.mark.long
def test_a_page_that_has_failed_hangs_up_and_comes_back(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """As when the system has no file left for a moment: it is told once, however often it fails."""
    port, without_files = free_port(), threading.Semaphore(0)
    config = parse(file_with_page(tmp_path, port), "test")

    def clock() -> float:
        if without_files.acquire(blocking=False):
            raise OSError(errno.EMFILE, "Too many open files")
        return 0.0

    def ask(browser: socket.socket) -> bytes:
        browser.sendall(b"GET /api/me HTTP/1.1\r\nHost: localhost\r\n\r\n")
        return browser.recv(12)

    page = page_of(App(config), clock=clock)
    page.start()
    try:
        with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as browser:
            assert ask(browser) == b"HTTP/1.1 200"
            without_files.release(3)
            while browser.recv(4096):
                pass
        give_up_s = time.monotonic() + PATIENCE_S
        answer = b""
        while answer != b"HTTP/1.1 200":
            assert time.monotonic() < give_up_s
            with suppress(OSError), socket.create_connection(("127.0.0.1", port), PATIENCE_S) as browser:
                answer = ask(browser)
    finally:
        page.stop()
    assert [record.getMessage() for record in caplog.records] == [
        "page: it has failed, and begins anew; the box runs on without it"
    ]
    assert page.wire.state == "closed"


def test_who_is_revoked_while_the_card_refuses_is_written_at_the_end_of_the_page(tmp_path: Path) -> None:
    port = free_port()
    config = parse(file_with_page(tmp_path, port), "test")
    pairings = build_pairings(config, lambda: True)
    assert pairings is not None
    token = pairings.token("a lost phone")
    page = page_of(App(config), pairings)
    page.start()
    with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as browser:
        browser.sendall(b"GET /api/me HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert browser.recv(12) == b"HTTP/1.1 200"
    in_the_way = Path(config.state.path).with_name(f"{FILE_NAME}.new")
    in_the_way.mkdir()
    assert pairings.revoke(1) == ""
    in_the_way.rmdir()
    page.stop()
    page.stop()
    again = build_pairings(config, lambda: True)
    assert again is not None
    assert again.known(token) is None
