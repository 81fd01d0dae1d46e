"""The page has `rotator run` start anew: with the new file, or with the last good one where that cannot be used."""

from __future__ import annotations

import json
import re
import socket
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from rotator.cli.anew import start_anew
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import LinkError
from rotator.runtime.anew import Anew
from tests.boxes import free_port

Start = Callable[..., Any]
Rotator = Callable[..., Any]


@pytest.fixture
def port() -> int:
    return free_port()


@pytest.fixture
def taken() -> Iterator[int]:
    """A port on which another program listens."""
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        yield other.getsockname()[1]


class Page:
    """A program with a token, and the page of the box."""

    def __init__(self, port: int, token: str) -> None:
        self._url, self._headers = f"http://127.0.0.1:{port}/api/", {"Authorization": f"Bearer {token}"}

    def ask(self, path: str, values: object = None) -> Any:
        data = None if values is None else json.dumps(values).encode()
        with urllib.request.urlopen(
            urllib.request.Request(self._url + path, data, self._headers), timeout=30
        ) as answer:
            return json.load(answer)

    def change(self, place: list[Any], value: object) -> None:
        digest = self.ask("settings")["digest"]
        self.ask("settings/write", {"digest": digest, "changes": [{"place": place, "value": value}], "stop": True})


@pytest.fixture
def box(start: Start, rotator: Rotator, config: Path, port: int) -> tuple[Any, Page]:
    config.write_text(f'{config.read_text()}\n[page]\nlisten = "127.0.0.1:{port}"  # mine\n', encoding="utf-8")
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    token = rotator("pair", "--config", config, "--token", "test").stdout.split()[-1]
    return box, Page(port, token)


def test_it_runs_on_with_the_new_file(box: tuple[Any, Page], config: Path) -> None:
    running, page = box
    page.change(["azimuth", "max_deg"], 400)
    running.until(r"The page starts the box anew\.\n(.|\n)*elevation 0°\n")
    assert page.ask("box")["azimuth"]["max_deg"] == 400
    assert page.ask("settings")["refused"] == ""
    assert "# mine" in config.read_text()
    assert running.stop() == 0


@pytest.mark.parametrize("what", ["link", "page"])
def test_a_port_that_is_taken_brings_the_last_good_file_back(
    box: tuple[Any, Page], config: Path, taken: int, what: str
) -> None:
    running, page = box
    before = config.read_text()
    place = f"127.0.0.1:{taken}"
    if what == "page":
        page.change(["page", "listen"], place)
    else:
        page.change(["link", 1], {"protocol": "rotctld", "tcp": place})
    running.until(r"The page starts the box anew\.\n(.|\n)*elevation 0°\n")
    assert config.read_text() == before
    assert re.search(rf"{place}: (cannot|the page cannot) listen there", page.ask("settings")["refused"])
    page.change(["azimuth", "max_deg"], 400)
    running.until(r"The page starts the box anew\.\n(.|\n)*elevation 0°\n")
    assert page.ask("settings")["refused"] == ""
    assert running.stop() == 0


def test_a_stop_stays_in_force(box: tuple[Any, Page], send: Callable[[bytes], None], config: Path) -> None:
    running, page = box
    page.ask("stop", {})
    page.change(["azimuth", "max_deg"], 400)
    running.until(r"The page starts the box anew\.\n(.|\n)*elevation 0°")
    send(b"W100 045\r")
    assert page.ask("status")["stopped_by"]
    assert not page.ask("status")["moving"]
    assert running.stop() == 0


def test_where_a_file_that_the_page_has_made_cannot_be_used_the_box_goes_on_without_one(tmp_path: Path) -> None:
    """Its page's port is taken: the person is not left without a box."""
    made, anew = tmp_path / "rotator.toml", Anew()
    made.write_text("mine\n")
    ran: list[Path | None] = []

    def run(_app: object) -> None:
        ran.append(anew.file)
        if anew.file is not None:
            raise LinkError("127.0.0.1:8232: the page cannot listen there")

    anew.ask(Status(0.0, AxisStatus(0.0, 450.0, 0.0), AxisStatus(0.0, 180.0, 0.0)))
    anew.file = made
    box: Any = SimpleNamespace(is_ready=False)
    start_anew(None, anew, lambda: box, run, None)
    assert ran == [made, None]
    assert anew.refused == "127.0.0.1:8232: the page cannot listen there"
    assert made.read_text() == "mine\n"
