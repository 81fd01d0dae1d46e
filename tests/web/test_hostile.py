"""Foreign pages, forged names, endless bodies, crowds of half-open connections: refused, and nothing moves."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import re
import socket
import sys
from pathlib import Path
from typing import Any, cast

import aiohttp
import pytest

from rotator.web.connections import ANSWER_S, MOST, SILENT_S, Connections, machine
from rotator.web.live import EVERY_S, TAKES_S
from tests.search import examples
from tests.web.conftest import OFF, PATIENCE_S, Box, Start

POINT, AWAY = {"azimuth_deg": 200, "elevation_deg": 60}, {"azimuth_deg": 90, "elevation_deg": 30}
FILLED = 40
"""So many pictures at most fill the queues of a reader that takes none."""
UPGRADE = (
    "GET /api/live HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
)


FOREIGN: list[dict[str, str]] = [
    {"Origin": "http://evil.example"},
    {"Origin": "null"},
    {"Sec-Fetch-Site": "cross-site"},
    {"Host": "evil.example"},
    {"Host": "127.0.0.1.evil.example"},
    {"Host": ""},
]


async def test_a_foreign_page_moves_nothing_even_in_a_paired_browser(box: Box) -> None:
    await box.pair()
    for headers in FOREIGN:
        for path in ("point", "take", "stop", "pair/begin"):
            status, _ = await box.post(path, POINT if path == "point" else {}, headers=headers)
            assert status in (400, 403), headers
        with pytest.raises(aiohttp.WSServerHandshakeError):
            await box.http.ws_connect(f"{box.url}/api/live", headers=headers)
    assert box.status.wanted_azimuth_deg is None
    assert box.status.held_by == box.status.latched == ""
    assert box.app.lcd_rows(0.0)[0].startswith("SAT")


async def test_a_request_with_several_host_headers_is_refused(box: Box) -> None:
    """The one who stands between would read one of them, and the page another."""
    good = box.url.removeprefix("http://")
    pairs = ((good, "evil.example"), ("evil.example", good), (good, good))
    for path, hosts in itertools.product(("/api/status", "/api/live", "/api/stop"), pairs):
        reader, writer = await asyncio.open_connection(*_place(box))
        named = "".join(f"Host: {host}\r\n" for host in hosts)
        writer.write(f"POST {path} HTTP/1.1\r\n{named}Content-Length: 0\r\n\r\n".encode())
        assert (await reader.readline()).split()[1] == b"400"
        writer.close()
    assert box.status.latched == ""


async def test_no_request_hides_behind_the_upgrade_to_a_websocket(box: Box) -> None:
    """What follows an upgrade that is refused, or comes with it, is no second request."""
    host = box.url.removeprefix("http://")
    hidden = f"POST /api/stop HTTP/1.1\r\nHost: {host}\r\nContent-Length: 0\r\n\r\n"
    for upgrade in (UPGRADE, UPGRADE.replace("GET /api/live", "GET /api/status")):
        reader, writer = await asyncio.open_connection(*_place(box))
        body = f"Content-Length: {len(hidden)}\r\n\r\n"
        writer.write((upgrade.format(host=host).removesuffix("\r\n") + body + hidden).encode())
        assert (await reader.readline()).split()[1] in (b"101", b"200", b"400")
        writer.close()
    async with box.http.get(f"{box.url}/api/status"):
        assert box.status.latched == ""


async def test_the_code_goes_to_nobody_who_does_not_stand_at_the_box(box: Box) -> None:
    assert (await box.post("pair/begin"))[0] == 200
    code = box.app.lcd_rows(0.0)[0].removeprefix("PAIR CODE ")
    assert code.isdigit()
    told = [await box.post("pair/begin"), await box.post("pair", {"code": "x", "name": "thief"})]
    for path in ("status", "box", "past", "path", "me", "paired", "log", "passes", "openapi.json", "nothing"):
        told.append(await box.get(path))
    async with box.http.ws_connect(f"{box.url}/api/live") as live:
        pictures = [await live.receive_str()]
        async with asyncio.timeout(PATIENCE_S):
            # A fault, as of a busy computer, takes turns with it.
            while "PAIR CODE ******" not in pictures[-1]:
                pictures.append(await live.receive_str())
    assert code not in f"{told}{pictures}"


async def test_the_cookie_cannot_be_read_by_scripts_nor_sent_by_other_sites(box: Box) -> None:
    await box.post("pair/begin")
    code = box.app.lcd_rows(0.0)[0].removeprefix("PAIR CODE ")
    async with box.http.post(f"{box.url}/api/pair", json={"code": code, "name": "x"}) as answer:
        (cookie,) = answer.headers.getall("Set-Cookie")
        token = answer.cookies["rotator"].value
        assert "HttpOnly" in cookie
        assert "SameSite=Strict" in cookie
        assert token not in await answer.text()
    async with box.http.get(f"{box.url}/") as answer:
        assert answer.headers["Set-Cookie"] == cookie, "it lasts from the latest visit on"


async def test_every_answer_forbids_foreign_frames_and_foreign_scripts(box: Box) -> None:
    for path in ("/", "/app.js", "/api/status", "/nothing", "/api/nothing", "/../../etc/passwd", "/%2e%2e/x"):
        async with box.http.get(f"{box.url}{path}") as answer:
            policy = answer.headers["Content-Security-Policy"]
            assert "default-src 'none'" in policy
            assert "frame-ancestors 'none'" in policy
            assert "unsafe" not in policy
            assert "Access-Control-Allow-Origin" not in answer.headers
            async with box.http.head(f"{box.url}{path}") as head:
                asked = answer.status, answer.headers["Content-Type"]
                assert (head.status, head.headers["Content-Type"]) == asked


@pytest.mark.parametrize(
    "body",
    [b"Content-Length: 1000000000\r\n\r\n", b"Transfer-Encoding: chunked\r\n\r\n"],
    ids=["1 GB", "endless"],
)
@pytest.mark.parametrize("path", [b"point", b"stop", b"pair"])
async def test_a_body_without_end_is_cut_off(box: Box, path: bytes, body: bytes) -> None:
    host = box.url.removeprefix("http://").encode()
    reader, writer = await asyncio.open_connection(*_place(box))
    writer.write(b"POST /api/" + path + b" HTTP/1.1\r\nHost: " + host + b"\r\n" + body)
    sent = 0
    try:
        async with asyncio.timeout(PATIENCE_S):
            while not reader.at_eof():
                writer.write(b"1000\r\n" + b"x" * 4096 + b"\r\n")
                await writer.drain()
                sent += 4096
                if sent > 50_000_000:
                    break
                await asyncio.sleep(0)
                if reader._buffer:  # type: ignore[attr-defined]
                    await reader.read(4096)
    except ConnectionError:
        pass
    finally:
        writer.close()
    assert sent < 50_000_000
    assert box.status.wanted_azimuth_deg is None
    assert (await box.get("status"))[0] == 200


@pytest.mark.search
async def test_thousands_of_half_open_requests_keep_nobody_from_stop(box: Box) -> None:
    """As from 250 machines, ten thousand in all in `make test-search`. A person looks on, and presses STOP while they
    come and when all have come."""
    async with box.http.ws_connect(f"{box.url}/api/live") as live:
        await box.pair()
        pipe = asyncio.subprocess.PIPE
        command = (sys.executable, "-m", "tests.web.flood", str(_place(box)[1]), str(examples(10_000)))
        flood = await asyncio.create_subprocess_exec(*command, stdin=pipe, stdout=pipe)
        assert flood.stdout is not None
        try:
            for said, aim in ((b"under way\n", POINT), (b"all have come\n", AWAY)):
                async with asyncio.timeout(PATIENCE_S):
                    assert await flood.stdout.readline() == said
                await press(box, "resume")
                await press(box, "point", aim)
                await box.until(lambda: box.world.drives() != OFF)
                await press(box, "stop")
                await box.until(lambda: box.world.drives() == OFF)
        finally:
            await flood.communicate(b"")
        async with asyncio.timeout(PATIENCE_S):
            while "STOPPED" not in (await live.receive_json())["now"]["headline"]:
                pass


async def press(box: Box, path: str, values: object = None) -> None:
    """On a new connection, as a browser has one for each press under way."""
    async with aiohttp.ClientSession(cookie_jar=box.http.cookie_jar) as person:
        assert (await Box(box.app, box.world, box.url, person, box.anew).post(path, values))[0] == 200


@pytest.mark.quiet
async def test_a_reader_that_takes_nothing_is_dropped_and_the_others_see_on(box: Box) -> None:
    """Its own queue is as short as its system lets it be."""
    async with box.http.ws_connect(f"{box.url}/api/live") as looker:
        slow = socket.socket()
        slow.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1)
        slow.connect(_place(box))
        slow.sendall(UPGRADE.format(host=box.url.removeprefix("http://")).encode())
        made_s = [(await looker.receive_json())["now"]["utc_s"] for _ in range(FILLED + int(TAKES_S / EVERY_S))]
        longest_s = max(b - a for a, b in itertools.pairwise(made_s))
        assert longest_s < FILLED * EVERY_S, "no picture waits for the slow one"
        # One that is still served would get pictures for ever.
        reader, writer = await asyncio.open_connection(sock=slow)
        async with asyncio.timeout(PATIENCE_S):
            with contextlib.suppress(ConnectionError):
                await reader.read()
        writer.close()


class Transport:
    """A connection's transport, as far as the crowd needs it."""

    def __init__(self, host: str) -> None:
        self.host = host
        self.aborted = False

    def get_extra_info(self, _name: str) -> tuple[str, int]:
        return self.host, 1

    def set_write_buffer_limits(self, high: int) -> None:
        assert high > 0

    def abort(self) -> None:
        self.aborted = True


class Crowd:
    def __init__(self) -> None:
        self.now_s = 100.0
        self.connections = Connections(lambda host: host != "8.8.8.8", lambda: self.now_s)

    def come(self, host: str = "192.168.1.2") -> Any:
        transport = Transport(host)
        assert self.connections.admit(cast(asyncio.Transport, transport))
        return transport


def test_a_machine_of_the_internet_is_turned_away() -> None:
    assert not Crowd().connections.admit(cast(asyncio.Transport, Transport("8.8.8.8")))


def test_a_machine_is_one_however_many_addresses_it_gives_itself() -> None:
    assert machine("fe80::1%eth0") == machine("fe80::ffff:2") != machine("fd00::1")
    assert machine("::ffff:192.168.1.2") == machine("192.168.1.2") != machine("192.168.1.3")


def test_a_connection_that_asks_nothing_ends_and_a_live_one_stays() -> None:
    crowd = Crowd()
    silent, live = crowd.come(), crowd.come()
    crowd.connections.live(live)
    crowd.now_s += SILENT_S + 1.0
    crowd.connections.look()
    assert silent.aborted
    assert not live.aborted


def test_an_answer_that_its_reader_does_not_take_ends() -> None:
    crowd = Crowd()
    reader = crowd.come()
    crowd.connections.begin(reader)
    crowd.now_s += SILENT_S + 1.0
    crowd.connections.look()
    assert not reader.aborted
    crowd.connections.end(reader)
    crowd.connections.begin(reader)
    crowd.now_s += ANSWER_S + 1.0
    crowd.connections.look()
    assert reader.aborted


def test_where_all_places_are_taken_the_machine_that_has_most_loses_one() -> None:
    crowd = Crowd()
    person = crowd.come("192.168.1.9")
    crowd.connections.live(person)
    flood = [crowd.come("192.168.1.66") for _ in range(3 * MOST)]
    assert not person.aborted
    assert len(crowd.connections) == MOST
    assert crowd.come("192.168.1.10")
    assert sum(each.aborted for each in flood) == 2 * MOST + 2


def test_a_connection_whose_request_is_under_way_is_spared() -> None:
    """In a browser that has many connections open STOP comes on a new one, and asks nothing for a moment."""
    crowd = Crowd()
    old = [crowd.come() for _ in range(MOST - 1)]
    for each in old:
        crowd.connections.begin(each)
    crowd.now_s += 5.0
    stop = crowd.come()
    crowd.come()
    assert not stop.aborted
    assert sum(each.aborted for each in old) == 1


def test_a_crowd_of_machines_with_a_connection_each_pushes_out_no_person_who_has_two() -> None:
    crowd = Crowd()
    looks_on, idle = crowd.come("192.168.1.9"), crowd.come("192.168.1.9")
    crowd.connections.live(looks_on)
    for number in range(MOST):
        crowd.come(f"10.0.0.{number}")
    crowd.now_s += 5.0
    stop = crowd.come("192.168.1.9")
    for number in range(MOST - 2):
        crowd.come(f"10.0.1.{number}")
    assert not looks_on.aborted
    assert idle.aborted
    assert not stop.aborted


def _place(box: Box) -> tuple[str, int]:
    host, _, port = box.url.removeprefix("http://").partition(":")
    return host, int(port)


PLACE = "[station]\nlatitude_deg = 48.123456\nlongitude_deg = 11.654321\n"
EXACT = re.compile(r"48\.1234|11\.654|JN58td", re.IGNORECASE)


async def test_a_stranger_learns_the_place_of_the_station_to_a_degree_and_the_paired_see_it(
    page_box: Start, tmp_path: Path
) -> None:
    """Everything that a browser may read without pairing."""
    async with page_box(PLACE, file=tmp_path / "r.toml") as box:
        _, told = await box.get("openapi.json")
        paths = [path for path, does in told["paths"].items() if "get" in does]
        assert len(paths) > 15
        for path in (*paths, "/"):
            async with box.http.get(box.url + path) as answer:
                assert not EXACT.search(await answer.text(errors="replace")), path
        assert (await box.get("box"))[1]["where"] == [48, 12]
        async with box.http.ws_connect(f"{box.url}/api/live") as live:
            assert not EXACT.search(await live.receive_str())
        await box.pair()
        assert (await box.get("box"))[1]["where"] == [48.123456, 11.654321]
        async with box.http.ws_connect(f"{box.url}/api/live") as live:
            assert (await live.receive_json())["hello"]["box"]["where"] == [48.123456, 11.654321]
