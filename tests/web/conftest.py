"""A whole box with its page, in real time on a simulated rotor, and a browser's side of HTTP."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, TypeVar

import aiohttp
import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from rotator.assembly.kept_files import build_state
from rotator.assembly.tracking import build_tracking
from rotator.box.app import App
from rotator.config.load import parse
from rotator.monitor.tap import Tap
from rotator.runtime.anew import Anew
from rotator.web.build import build_page, build_pairings
from rotator.web.pairing import Pairings
from rotator.web.thread import PageThread
from tests.boxes import file_with_page, free_port

Start = Callable[..., AbstractAsyncContextManager["Box"]]
Test = TypeVar("Test", bound=Callable[..., Any])
PATIENCE_S = 60.0
OFF = (0, 0)


def page_of(app: App, pairings: Pairings | None = None, **more: Any) -> PageThread:
    """One more page of this box, not started. `more`: as in `build_page`."""
    pairings = pairings or build_pairings(app.config, lambda: True)
    assert pairings is not None
    tap = Tap(datetime.now, lambda: app.loop.status)
    tracking = build_tracking(app.config, app.loop, app.mount, build_state(app.config))
    return build_page(
        app.config, app.loop, app.mount, pairings, anew=Anew(), lcd=list, wires=[], tap=tap, tracking=tracking, **more
    )


@dataclass
class Box:
    """The running box, its simulated rotor, and where its page is."""

    app: App
    world: SimRelayPotRotor
    url: str
    http: aiohttp.ClientSession
    anew: Anew

    async def post(self, path: str, values: object = None, **more: Any) -> tuple[int, dict[str, Any]]:
        async with self.http.post(f"{self.url}/api/{path}", json=values or {}, **more) as answer:
            return answer.status, await answer.json()

    async def get(self, path: str, **more: Any) -> tuple[int, dict[str, Any]]:
        async with self.http.get(f"{self.url}/api/{path}", **more) as answer:
            return answer.status, await answer.json()

    async def pair(self, name: str = "a browser") -> dict[str, Any]:
        """Pair this browser by the code on the display, as a person does."""
        assert (await self.post("pair/begin"))[0] == 200
        code = self.app.lcd_rows(0.0)[0].removeprefix("PAIR CODE ")
        status, told = await self.post("pair", {"code": code, "name": name})
        assert status == 200, told
        return told

    async def until(self, meets: Callable[[], bool]) -> None:
        async with asyncio.timeout(PATIENCE_S):
            while not meets():
                await asyncio.sleep(0.005)

    @property
    def status(self) -> Any:
        return self.app.loop.status


def with_box(more: str = "", *, page: str = "", file: bool = False) -> Callable[[Test], Test]:
    """The fixture `box` of this test has these texts in its file. `file`: it has a file, and may change it."""

    def mark(test: Test) -> Test:
        test.__dict__["box"] = more, page, file
        return test

    return mark


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "r.toml"


@pytest.fixture
def box(request: pytest.FixtureRequest, page_box: Start, file: Path) -> AbstractAsyncContextManager[Box]:
    """A running box: see `with_box`."""
    more, page, has_file = getattr(request.function, "box", ("", "", False))
    return page_box(more, page, file if has_file else None)


@pytest.fixture
def page_box(tmp_path: Path) -> Start:
    """Starts a box. `more`: text for the end of its file. `file`: it has that text in this file, too."""

    @asynccontextmanager
    async def start(more: str = "", page: str = "", file: Path | None = None) -> AsyncIterator[Box]:
        port = free_port()
        text = file_with_page(tmp_path, port, more, page)
        if file is not None:
            file.write_text(text, encoding="utf-8")
        anew = Anew()
        app = App(parse(text, "a test's file"), file, anew=anew)
        world = app.station.world
        assert isinstance(world, SimRelayPotRotor)
        stop = asyncio.Event()
        task = asyncio.create_task(app.run(stop))
        # As a browser does: a cookie of a number as well.
        jar = aiohttp.CookieJar(unsafe=True)
        url = f"http://127.0.0.1:{port}"
        try:
            async with aiohttp.ClientSession(cookie_jar=jar) as http:
                async with asyncio.timeout(PATIENCE_S):
                    while not task.done() and app.loop.status.azimuth.angle_deg is None:
                        await asyncio.sleep(0.01)
                yield Box(app, world, url, http, anew)
        finally:
            stop.set()
            await asyncio.wait_for(task, PATIENCE_S)
            assert world.drives() == OFF

    return start
