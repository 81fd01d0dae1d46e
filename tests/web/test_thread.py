"""The thread of the page: a page that has failed takes no connection any more, and says so."""

from __future__ import annotations

import socket
import threading
from pathlib import Path

import pytest

from rotator.box.app import App
from rotator.config.load import parse
from rotator.runtime.event_watch import EventWatch
from rotator.store.paired import FILE_NAME
from rotator.web.build import build_pairings
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


def test_a_page_that_has_failed_hangs_up_and_is_closed(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    port, broken = free_port(), threading.Event()
    config = parse(file_with_page(tmp_path, port), "test")

    def clock() -> float:
        if broken.is_set():
            raise OverflowError("no time")
        return 0.0

    page = page_of(App(config), clock=clock)
    page.start()
    try:
        with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as browser:
            browser.sendall(b"GET /api/me HTTP/1.1\r\nHost: localhost\r\n\r\n")
            assert browser.recv(12) == b"HTTP/1.1 200"
            broken.set()
            while browser.recv(4096):
                pass
        with pytest.raises(ConnectionRefusedError):
            socket.create_connection(("127.0.0.1", port), PATIENCE_S)
    finally:
        page.stop()
    assert [record.getMessage() for record in caplog.records] == ["page: it has failed; the box runs on without it"]


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
