"""The live connection: pictures come, and a held button turns the antenna for as long as the browser is heard."""

from __future__ import annotations

import asyncio
import itertools
import json
import os
import socket
import sys
from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from typing import Any, cast

import aiohttp
import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from rotator.web.live import MOST_SIGNS_PER_S, MOST_WATCHERS, Live
from tests.web.conftest import OFF, PATIENCE_S, Box, with_box

pytestmark = pytest.mark.quiet

SURE_S = 1.5
"""Far longer than a lease: nothing on this machine is as late as this."""


class Browser:
    """The live connection of a browser, and the latest picture that it has seen."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self.socket = socket
        self.told: dict[str, Any] = {}
        self.refused: list[str] = []

    async def look(self) -> None:
        """The next picture, or the next answer."""
        told = json.loads(await asyncio.wait_for(self.socket.receive_str(), PATIENCE_S))
        if "refused" in told:
            self.refused.append(told["refused"])
        else:
            self.told |= told

    async def hold(self, turn: str, press: int = 1) -> None:
        await self.socket.send_str(json.dumps({"hold": turn, "press": press, "n": self.told["n"]}))

    async def holds(self, turn: str, meets: Callable[[], bool], press: int = 1) -> None:
        """Hold the button until something has come, at every picture."""
        async with asyncio.timeout(PATIENCE_S):
            while not meets():
                await self.look()
                await self.hold(turn, press)


@asynccontextmanager
async def live(box: Box) -> AsyncIterator[Browser]:
    async with box.http.ws_connect(f"{box.url}/api/live") as socket:
        browser = Browser(socket)
        await browser.look()
        yield browser


class Edges:
    """When the relays of the simulated station opened, on the box's own clock."""

    def __init__(self, world: SimRelayPotRotor) -> None:
        self.opened_s: list[float] = []
        self._world = world
        self._drives = world.drives()
        world.gpio.on_edges.append(self._see)

    def _see(self, now_s: float, _changes: Mapping[int, bool]) -> None:
        before, self._drives = self._drives, self._world.drives()
        if self._drives == OFF != before:
            self.opened_s.append(now_s)


async def test_pictures_are_numbered_and_hold_what_the_page_shows(box: Box) -> None:
    async with live(box) as browser:
        first = browser.told["n"]
        assert browser.told["hello"]["paired"] is False
        await browser.look()
        assert browser.told["n"] != first
        now = browser.told["now"]
        assert now["lcd"] == ["SAT A:--- E:--- ", "SIM A:000 E:000 "]
        assert now["lamps"] == {"cw": "off", "ccw": "off", "up": "off", "down": "off"}
        assert now["links"][0]["name"] == "gs232b"
        assert now["headline"] == "AT REST"


@pytest.mark.parametrize("leaves", ["lets go", "is silent", "is lost"])
async def test_the_antenna_stops_when_the_finger_leaves_or_the_browser_is_heard_no_more(box: Box, leaves: str) -> None:
    await box.pair()
    edges = Edges(box.world)
    async with live(box) as browser:
        await browser.holds("cw", lambda: box.world.drives() == (1, 0))
        edges.opened_s.clear()
        await browser.hold("cw")
        last_s = asyncio.get_running_loop().time()
        match leaves:
            case "lets go":
                await browser.socket.send_str('{"let_go": true}')
            case "is lost":
                connection = browser.socket.get_extra_info("socket")
                assert connection is not None
                with socket.socket(fileno=os.dup(connection.fileno())) as wire:
                    wire.shutdown(socket.SHUT_RDWR)
        await box.until(lambda: box.world.drives() == OFF)
        assert edges.opened_s[-1] - last_s < SURE_S
        sys.stdout.write(f"{leaves}: the relay opened {1000 * (edges.opened_s[-1] - last_s):.0f} ms later\n")


async def test_who_is_not_paired_turns_nothing(box: Box) -> None:
    async with live(box) as browser:
        edges = Edges(box.world)
        await browser.holds("cw", lambda: bool(browser.refused))
        assert browser.refused[0] == "this browser is not paired"
        assert box.world.drives() == OFF
        assert edges.opened_s == []


async def test_who_is_revoked_while_a_button_is_held_turns_nothing_more(box: Box) -> None:
    me = await box.pair()
    async with live(box) as browser:
        await browser.holds("up", lambda: box.world.drives() == (0, 1))
        assert (await box.post("revoke", {"number": me["number"]}))[0] == 200
        with pytest.raises(aiohttp.WSMessageTypeError):  # the box ends the connection
            await browser.holds("up", lambda: False)
        await box.until(lambda: box.world.drives() == OFF)
    async with live(box) as browser:
        assert browser.told["hello"]["paired"] is False
        await browser.holds("up", lambda: bool(browser.refused))
        assert browser.refused == ["this browser is not paired"]
        assert box.world.drives() == OFF


async def test_a_stop_ends_what_is_held_and_the_held_button_starts_nothing(box: Box) -> None:
    await box.pair()
    async with live(box) as browser:
        await browser.holds("cw", lambda: box.world.drives() == (1, 0))
        assert (await box.post("stop"))[0] == 200
        await box.until(lambda: box.world.drives() == OFF)
        edges = Edges(box.world)
        await browser.holds("cw", lambda: bool(browser.refused))
        assert edges.opened_s == []
        assert browser.refused[0].startswith("stopped by a browser")


async def test_a_stop_on_the_live_connection_needs_no_pairing_and_no_patience(box: Box) -> None:
    await box.pair()
    await box.post("point", {"azimuth_deg": 300, "elevation_deg": 60})
    await box.until(lambda: box.world.drives() != OFF)
    async with aiohttp.ClientSession() as stranger, stranger.ws_connect(f"{box.url}/api/live") as socket:
        for _ in range(MOST_SIGNS_PER_S):
            await socket.send_str('{"let_go": true}')
        await socket.send_str('{"stop": true}')
        await box.until(lambda: box.world.drives() == OFF and box.status.latched == "page")


async def test_where_all_places_are_taken_the_machine_that_has_most_watchers_loses_one() -> None:
    class Socket:
        """As much of a socket as a watcher needs."""

        closed = False

        async def close(self, **_how: object) -> None:
            self.closed = True

        async def send_str(self, _text: str) -> None:
            pass

        def __aiter__(self) -> Socket:
            return self

        async def __anext__(self) -> None:
            await asyncio.Event().wait()

    watched = Live(dict, lambda: None, lambda: 0.0)
    sockets = [Socket() for _ in range(MOST_WATCHERS + 1)]
    tasks = []
    for number, each in enumerate(sockets):
        host = "192.168.1.66" if number else "192.168.1.2"
        serving = watched.serve(cast(Any, each), {}, None, lambda: True, stop=lambda _: "", host=host)
        tasks.append(asyncio.create_task(serving))
        await asyncio.sleep(0)
    assert [number for number, each in enumerate(sockets) if each.closed] == [1]
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)


async def test_other_words_turn_nothing(box: Box) -> None:
    await box.pair()
    async with live(box) as browser:
        for text in ("", "{", "[]", '{"hold": "cw"}', '{"hold": "left", "press": 1, "n": 1}', "null", "9" * 250):
            browser.refused.clear()
            await browser.socket.send_str(text)
            while not browser.refused:
                await browser.look()
            assert box.world.drives() == OFF, text


async def test_one_bad_picture_is_told_and_the_next_ones_come(caplog: pytest.LogCaptureFixture) -> None:
    noted = asyncio.Event()
    notes: list[float] = []

    def note() -> None:
        notes.append(0.0)
        if len(notes) < 3:
            raise ZeroDivisionError("a bad picture")
        noted.set()

    seconds = itertools.count()
    task = asyncio.create_task(Live(dict, note, lambda: float(next(seconds))).run())
    await asyncio.wait_for(noted.wait(), PATIENCE_S)
    task.cancel()
    assert [record.getMessage() for record in caplog.records] == ["page: a picture cannot be made"]


@with_box(page='reading = "paired"')
async def test_where_reading_is_closed_the_pictures_end_with_the_pairing(box: Box) -> None:
    me = await box.pair()
    async with live(box) as browser:
        assert (await box.post("revoke", {"number": me["number"]}))[0] == 200
        async with asyncio.timeout(PATIENCE_S):
            while (await browser.socket.receive()).type is aiohttp.WSMsgType.TEXT:
                pass
