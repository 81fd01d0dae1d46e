"""A web site in the browser of a PC that reaches the box: it can let the browser send anything to any port."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING

import pytest

from tests.boxes import free_port
from tests.page.conftest import LOOK_MS, PATIENCE_MS, Station

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

LINK = '[[link]]\nname = "{name}"\nprotocol = "{name}"\ntcp = "127.0.0.1:{port}"\n'
ORDERS = {"rotctld": "P 90 40\n", "gs232a": "W090 040\r", "easycomm2": "AZ90.0 EL40.0\n", "rc2800": "A90\rE40\r"}
SEND = "([url, body]) => { fetch(url, {method: 'POST', mode: 'no-cors', body}).catch(() => {}) }"
"""It does not wait: where the box listened, the browser would wait for an answer for ever."""
FORM = """([url, body]) => {
    const form = document.createElement('form')
    Object.assign(form, {method: 'post', action: url, enctype: 'text/plain', target: 'elsewhere'})
    const field = document.createElement('input')
    Object.assign(field, {name: '\\n' + body, value: ''})
    form.append(field); document.body.append(form); form.submit()
}"""


class Site(BaseHTTPRequestHandler):
    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<iframe name=elsewhere></iframe>")

    def log_message(self, *_: object) -> None:
        """Keeps quiet."""


@pytest.fixture
def site(browser: Browser) -> Iterator[Page]:
    """A page of another web site, open in the browser."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), Site)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    context = browser.new_context()
    page = context.new_page()
    page.goto(f"http://localhost:{server.server_port}/")
    yield page
    context.close()
    server.shutdown()
    server.server_close()


def test_it_turns_nothing_over_any_link(start: Callable[..., Station], site: Page) -> None:
    ports = {name: free_port() for name in ORDERS}
    station = start("".join(LINK.format(name=name, port=port) for name, port in ports.items()))
    for name, order in ORDERS.items():
        url = f"http://127.0.0.1:{ports[name]}/"
        site.evaluate(SEND, [url, order])
        site.evaluate(FORM, [url, order])
    for _ in range(PATIENCE_MS // LOOK_MS):
        if all(f"{name}: a browser" in (station.folder / "log").read_text() for name in ORDERS):
            break
        site.wait_for_timeout(LOOK_MS)
    else:
        pytest.fail((station.folder / "log").read_text())
    assert "moved by: nobody" in station.tell("status")
    assert station.world().relay_starts == 0
