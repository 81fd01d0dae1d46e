"""What goes wrong between the page and the box: the cable is pulled, a STOP gets a wrong answer, a view is left.

The cable is real sockets between Chromium and the program. Pulled, it carries nothing, and tells neither end.
"""

from __future__ import annotations

import contextlib
import re
import select
import socket
import threading
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import pytest

from tests.page.conftest import Station, headline, pair
from tests.page.test_dashboard import Start, Visit, waits_for

if TYPE_CHECKING:
    from playwright.sync_api import Page, Route

BYTES = 65_536
PRESSES = 10


class Cable:
    """Between the browser and the box at `port`. Connections that were open when it was pulled never work again."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._plugged = threading.Event()
        self._plugged.set()
        self._pulls = 0
        self._door = socket.create_server(("127.0.0.1", 0))
        self.port = self._door.getsockname()[1]
        self._ends: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    def pull(self) -> None:
        self._plugged.clear()
        self._pulls += 1

    def plug(self) -> None:
        self._plugged.set()

    def close(self) -> None:
        self._door.close()
        for end in self._ends:
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def _accept(self) -> None:
        while True:
            try:
                browser, _ = self._door.accept()
            except OSError:
                return
            self._ends.append(browser)
            threading.Thread(target=self._carry, args=(browser,), daemon=True).start()

    def _carry(self, browser: socket.socket) -> None:
        self._plugged.wait()
        pulls = self._pulls
        box = socket.create_connection(("127.0.0.1", self._port))
        self._ends.append(box)
        other = {browser: box, box: browser}
        with browser, box, contextlib.suppress(OSError):
            while True:
                for end in select.select([browser, box], [], [])[0]:
                    data = end.recv(BYTES)
                    if self._pulls != pulls:
                        threading.Event().wait()
                    if not data:
                        return
                    other[end].sendall(data)


@pytest.fixture
def lay(start: Start, visit: Visit) -> Iterator[Callable[[], tuple[Station, Cable, Page]]]:
    """A box, a cable, and a paired browser at its other end."""
    laid: list[Cable] = []

    def to_the_page() -> tuple[Station, Cable, Page]:
        station = start()
        page = visit(station)
        pair(page)
        port = urlsplit(station.url).port
        assert port is not None
        laid.append(Cable(port))
        # A cookie belongs to the machine, whatever the port.
        page.goto(f"http://127.0.0.1:{laid[-1].port}")
        page.get_by_role("button", name="Point there").wait_for()
        return station, laid[-1], page

    yield to_the_page
    for cable in laid:
        cable.close()


def hold(page: Page, name: str) -> None:
    button = page.get_by_role("button", name=f"Hold to turn {name}", exact=True)
    button.scroll_into_view_if_needed()
    button.hover()
    page.mouse.down()


def turns(station: Station) -> bool:
    return station.world().drives != (0, 0)


def hold_until_it_turns(page: Page, name: str, station: Station) -> None:
    """Where the machine is so busy that the box refuses a sign as too late, a person presses again."""
    for _ in range(PRESSES):
        hold(page, name)
        waits_for(page, lambda: turns(station) or page.locator(".jog.held").count() == 0)
        if turns(station):
            return
        page.mouse.up()
    pytest.fail(f"nothing turns: {page.locator('main').inner_text()}")


def test_a_pulled_cable_stops_the_antenna_and_the_page_comes_back_when_it_is_plugged(
    lay: Callable[[], tuple[Station, Cable, Page]],
) -> None:
    station, cable, page = lay()
    hold_until_it_turns(page, "CW", station)
    cable.pull()
    waits_for(page, lambda: not turns(station))
    page.get_by_text("the connection was lost: the antenna has stopped").wait_for()
    assert page.locator(".jog.held").count() == 0
    page.mouse.up()
    hold(page, "CW")
    page.get_by_text("there is no connection to the box: nothing turns").wait_for()
    assert page.locator(".jog.held").count() == 0
    page.mouse.up()
    cable.plug()
    page.locator(".connection.lost").wait_for(state="detached")
    hold_until_it_turns(page, "CW", station)


@pytest.mark.parametrize(
    ("status", "body", "language", "says"),
    [
        (502, "<h1>Bad Gateway</h1>", "en", "not heard yet: trying again"),
        (200, "<h1>Please log in</h1>", "de", "noch nicht gehört: neuer Versuch"),
        (403, '{"error": "the box has another name"}', "en", "the box has another name: trying again"),
    ],
)
def test_a_stop_that_the_box_has_not_confirmed_is_sent_again(
    start: Start, visit: Visit, *, status: int, body: str, language: str, says: str
) -> None:
    page = visit(start(), locale=language)
    wrong, confirmed = [True], []

    def answer(route: Route) -> None:
        if wrong:
            route.fulfill(status=status, body=body)
            return
        confirmed.append(route.request.url)
        route.continue_()

    page.route("**/api/stop", answer)
    page.locator("#stop").click()
    page.locator("#stop", has_text=says).wait_for()
    page.get_by_role("status").filter(has_text=says).wait_for()
    wrong.clear()
    page.locator("#stop-note:empty").wait_for(state="attached")
    assert len(confirmed) == 1
    headline(page, {"en": "STOPPED by", "de": "ANGEHALTEN"}[language])


def test_stop_needs_no_other_script(start: Start, visit: Visit) -> None:
    station = start()
    page, onlooker = visit(station), visit(station)
    page.route(
        re.compile(r"\.m?js$"), lambda route: route.continue_() if "stop.js" in route.request.url else route.abort()
    )
    page.reload()
    page.locator("#stop").click()
    headline(onlooker, "STOPPED by")
    assert page.locator(".headline").count() == 0


def signs_of(page: Page) -> list[str | bytes]:
    """What the page sends over its live connection from now on. It is loaded anew for that."""
    sent: list[str | bytes] = []

    def note(sign: str | bytes) -> None:
        sent.append(sign)

    page.on("websocket", lambda socket: socket.on("framesent", note))
    page.reload()
    page.locator(".headline").wait_for()
    return sent


@pytest.mark.parametrize("key", ["", "Space"], ids=["by mouse", "by key"])
def test_a_held_button_whose_view_is_left_is_let_go(start: Start, visit: Visit, key: str) -> None:
    page = visit(start())
    pair(page)
    sent = signs_of(page)
    page.evaluate("location.hash = 'log'")
    page.get_by_role("link", name="Antenna").click()
    if key:
        page.get_by_role("button", name="Hold to turn CW", exact=True).focus()
        page.keyboard.down(key)
    else:
        hold(page, "CW")
    waits_for(page, lambda: any('"hold":"cw"' in str(sign) for sign in sent))
    page.evaluate("history.back()")
    page.get_by_role("heading", name="Log").wait_for()
    waits_for(page, lambda: sent[-1] == '{"let_go":true}')
    page.get_by_role("link", name="Antenna").click()
    page.get_by_role("button", name="Point there").wait_for()
    assert page.locator(".jog.held").count() == 0
    assert sent[-1] == '{"let_go":true}'


def test_passes_that_are_still_computed_are_asked_for_again(start: Start, visit: Visit) -> None:
    page = visit(start())
    rises, sets = datetime.now(UTC) + timedelta(hours=1), datetime.now(UTC) + timedelta(hours=2)
    made = {
        "name": "AO-91",
        "aos": rises.isoformat(),
        "los": sets.isoformat(),
        "max_el_deg": 60,
        "expected_error_deg": 0.4,
    }
    asked: list[str] = []

    def answer(route: Route) -> None:
        asked.append(route.request.url)
        if len(asked) == 1:
            route.fulfill(status=202, json={"computing": True})
        else:
            route.fulfill(json={"passes": [{**made, "tca": made["aos"], "aos_az_deg": 10, "los_az_deg": 200}]})

    page.route("**/api/passes", answer)
    page.get_by_role("link", name="Plan").click()
    page.get_by_text("The box computes passes and plan").wait_for()
    page.get_by_role("cell", name="AO-91").wait_for()
    assert len(asked) == 2


def test_an_answer_that_is_cut_off_changes_nothing(start: Start, visit: Visit) -> None:
    """As when the box starts anew while it answers."""
    page, cut = visit(start()), list[str]()

    def within(route: Route) -> None:
        cut.append(route.request.url)
        route.fulfill(status=200, content_type="application/json", body='{"rows": [[0')

    page.locator(".plot .turned").wait_for(state="attached")
    page.route("**/api/past", within)
    waits_for(page, lambda: len(cut) > 1)
    page.locator(".plot .turned").wait_for(state="attached")
    headline(page, "AT REST")
