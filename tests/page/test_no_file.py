"""What a person finds who follows the README: a box without a file, and from there to the ISS; each press is counted.

The elements come from a server of this machine, which the person names as another address.
"""

from __future__ import annotations

import re
import subprocess
import sys
import threading
import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from signal import SIGINT
from typing import TYPE_CHECKING

import pytest

from benchmarks.sky_now import as_json, satellite, sets_in
from rotator.config.load import shipped
from tests.boxes import free_port
from tests.page.conftest import START_S, STATIONS, Station, code_at_the_box, until_it_answers, violations
from tests.page.test_dashboard import PHONE
from tests.page.test_first_use import COMPUTED_MS, LOCATOR, SITE, Finger
from tests.page.test_setup import in_sight

if TYPE_CHECKING:
    from playwright.sync_api import Page, Response

Visit = Callable[..., "Page"]
MOST_PRESSES, MOST_FIELDS = 12, 3
UP_S = 600.0
ALONE = (
    "import sys; from pathlib import Path; from rotator.config import load; "
    "load.SIMULATED_FILE = Path(sys.argv.pop(1)); from rotator.cli.main import main; main()"
)
"""The program, with the shipped file of a box without one on free ports."""


@pytest.fixture
def bare(tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Station]:
    """`rotator run` in a folder without a file."""
    port, shipped_here = free_port(), tmp_path_factory.mktemp("shipped") / "simulated.toml"
    text = shipped().replace("127.0.0.1:4533", f"127.0.0.1:{free_port()}")
    shipped_here.write_text(f'{text}\n[page]\nlisten = "127.0.0.1:{port}"\n', encoding="utf-8")
    with (tmp_path / "log").open("wb") as log:
        command = (sys.executable, "-c", ALONE, str(shipped_here), "run", "--plain")
        process = subprocess.Popen(command, cwd=tmp_path, stdout=log, stderr=subprocess.STDOUT)
    url = f"http://127.0.0.1:{port}"
    station = STATIONS[url] = Station(tmp_path, url, process, named=())
    until_it_answers(station)
    yield station
    process.send_signal(SIGINT)
    assert process.wait(timeout=START_S) == 0


@contextmanager
def server_of(text: bytes) -> Iterator[str]:
    """The address of a file of elements."""

    class Answers(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(text)))
            self.end_headers()
            self.wfile.write(text)

        def log_message(self, *_: object) -> None: ...

    with ThreadingHTTPServer(("127.0.0.1", 0), Answers) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/stations.json"
        server.shutdown()


def test_from_a_box_without_a_file_to_the_iss(bare: Station, visit: Visit) -> None:
    page = visit(bare, **PHONE)
    finger, refused = Finger(bare, page), list[str]()

    def note(answer: Response) -> None:
        if "/api/" in answer.url and answer.status >= 400 and answer.request.method == "POST":
            refused.append(f"{answer.url}: {answer.status}")

    page.on("response", note)
    finger.press("Pair this browser")
    finger.fill("Code", code_at_the_box(page))
    finger.press("Pair", exact=True)
    finger.view("Setup")
    page.get_by_text("This box runs without a file").wait_for()
    now_s = time.time()
    made = as_json([satellite("ISS (ZARYA)", 25_544, now_s, SITE, sets_in(now_s, UP_S))]).encode()
    with server_of(made) as address:
        finger.fill("The place of the antenna", LOCATOR)
        finger.fill("Fetch the elements", address)
        finger.press("See what is written")
        assert violations(page) == []
        assert not (bare.folder / "rotator.toml").exists()
        finger.press("Write it and start anew")
        in_sight(page, page.get_by_text(f"Written to {bare.folder / 'rotator.toml'}. The box runs with it now."))
        page.get_by_text("What is up now is on").wait_for()  # the page has heard of the new box
        page.get_by_text("This box runs without a file").wait_for(state="detached")
        if page.get_by_role("button", name="The time of the box is right").count():
            finger.press("The time of the box is right")
            finger.press("It is right")
        finger.view("Plan")
        finger.press("Track ISS (ZARYA)")
        page.get_by_text("Tracks ISS (ZARYA)").wait_for(timeout=COMPUTED_MS)
    assert refused == [], "nothing was pressed that had to fail"
    assert (finger.presses <= MOST_PRESSES, finger.fields <= MOST_FIELDS) == (True, True), vars(finger)
    written = tomllib.loads((bare.folder / "rotator.toml").read_text(encoding="utf-8"))
    assert written["station"] == {"locator": LOCATOR}
    assert written["sky"] == {"fetch": [address]}


def test_each_step_of_a_box_without_a_file_can_be_used(bare: Station, visit: Visit) -> None:
    """No step waits for a file, and one press makes it."""
    page = visit(bare)
    finger = Finger(bare, page)
    finger.press("Pair this browser")
    finger.fill("Code", code_at_the_box(page))
    finger.press("Pair", exact=True)
    finger.view("Setup")
    for step in page.locator(".step > summary").all():
        step.click()
    page.get_by_label("Which rotor?").wait_for()
    page.get_by_label("Find a setting").wait_for()
    assert page.get_by_text(re.compile("…$")).count() == 0, "nothing is waited for"
    assert violations(page) == []
    finger.press("Make it now")
    page.get_by_text("This box runs without a file").wait_for(state="detached")
    page.get_by_text(f"All that {bare.folder / 'rotator.toml'} can say").wait_for()
    assert (bare.folder / "rotator.toml").exists()
