"""A UDP socket: senders that share it, answers one port higher, reports, and datagrams that are not heard."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

import pytest

from rotator.exchange.sources import Source
from rotator.links.listening import Allowed
from rotator.links.udp import FORGOTTEN_AFTER_S, MOST_BYTES, MOST_SENDERS, Report, UdpLink
from rotator.links.wire import Wire
from rotator.protocols.pstrotator import PstRotatorSession
from rotator.runtime.client import Client
from tests.boxes import free_udp_ports

PATIENCE_S = 30.0
Running = Callable[[UdpLink], Any]


class Program:
    """A program on some address of this machine, with the port at which it hears answers."""

    def __init__(self, host: str, port: int, hears_at: int) -> None:
        self._to = (host, port)
        self._ears = self._bound(host, hears_at)
        self._mouth = self._bound(host, 0)

    @staticmethod
    def _bound(host: str, port: int) -> socket.socket:
        made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        made.bind((host, port))
        made.setblocking(False)
        return made

    def send(self, data: bytes, *, mouth: socket.socket | None = None) -> None:
        (mouth or self._mouth).sendto(data, ("127.0.0.1", self._to[1]))

    def send_from_a_new_port(self, data: bytes) -> None:
        with self._bound(self._to[0], 0) as mouth:
            self.send(data, mouth=mouth)

    async def hear(self) -> bytes:
        return await asyncio.wait_for(asyncio.get_running_loop().sock_recv(self._ears, 4096), PATIENCE_S)

    async def ask(self, data: bytes) -> bytes:
        self.send(data)
        return await self.hear()

    def close(self) -> None:
        self._ears.close()
        self._mouth.close()


@pytest.fixture
def port() -> int:
    return free_udp_ports()


class Sessions:
    """A PstRotator conversation for each sender, each a source of its own."""

    def __init__(self, bench: Any) -> None:
        self.made = 0
        self.bench = bench

    def __call__(self) -> PstRotatorSession:
        self.made += 1
        return PstRotatorSession(Client(self.bench.loop, self.bench.mount, Source("pst", self.made)))


@pytest.fixture
def sessions(bench: Any) -> Sessions:
    return Sessions(bench)


@pytest.fixture
def link(wire: Wire, port: int, sessions: Sessions) -> UdpLink:
    return UdpLink(wire, "127.0.0.1", port, sessions, answer_port=port + 1)


@asynccontextmanager
async def program(port: int, host: str = "127.0.0.1") -> AsyncIterator[Program]:
    each = Program(host, port, port + 1)
    try:
        yield each
    finally:
        each.close()


async def test_a_question_is_answered_one_port_higher(link: UdpLink, port: int, running: Running) -> None:
    async with running(link), program(port) as one:
        assert await one.ask(b"<PST>TGA?</PST>") == b"TGA:235\r"
        one.send(b"<PST>TGA?TGE?</PST>")
        assert [await one.hear(), await one.hear()] == [b"TGA:235\r", b"TGE:25\r"], "an answer is a datagram"
        assert link.wire.state == "1 sender"
    assert link.wire.state == "closed"


async def test_an_order_moves_and_a_stop_stops(link: UdpLink, port: int, running: Running, bench: Any) -> None:
    async with running(link), program(port) as one:
        one.send(b"<PST><AZIMUTH>300</AZIMUTH><ELEVATION>80</ELEVATION></PST>")
        assert await one.ask(b"<PST>TGA?</PST>") == b"TGA:235\r"
        assert bench.drives() == (1, 1)
        one.send(b"<PST><STOP>1</STOP></PST>")
        await one.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (0, 0)


async def test_an_address_is_one_sender_whatever_its_port(
    link: UdpLink, port: int, running: Running, sessions: Sessions
) -> None:
    """Some programs open a socket for each datagram: a stop from elsewhere must hold for the next one."""

    async with running(link), program(port) as one, program(port, "127.0.0.2") as other:
        one.send_from_a_new_port(b"<PST>TGA?</PST>")
        one.send_from_a_new_port(b"<PST>TGA?</PST>")
        assert [await one.hear(), await one.hear()] == [b"TGA:235\r"] * 2
        assert sessions.made == 1
        assert await other.ask(b"<PST>TGE?</PST>") == b"TGE:25\r"
        assert sessions.made == 2
        assert link.wire.state == "2 senders"


async def test_a_stop_silences_the_stream_from_another_address(
    link: UdpLink, port: int, running: Running, bench: Any
) -> None:
    async with running(link), program(port) as stream, program(port, "127.0.0.2") as hand:
        stream.send_from_a_new_port(b"<PST><AZIMUTH>300</AZIMUTH></PST>")
        await stream.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (1, 0)
        hand.send(b"<PST><STOP>1</STOP></PST>")
        await hand.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (0, 0)
        stream.send_from_a_new_port(b"<PST><AZIMUTH>301</AZIMUTH></PST>")
        await stream.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (0, 0)
        assert bench.loop.status.wanted_azimuth_deg is None
        hand.send(b"<PST><AZIMUTH>180</AZIMUTH></PST>")
        await hand.ask(b"<PST>TGA?</PST>")
        bench.loop.cycle()
        assert bench.loop.status.wanted_azimuth_deg == 180


def test_who_is_silent_is_forgotten_and_not_before(wire: Wire, port: int, sessions: Sessions) -> None:
    now_s = [0.0]
    link = UdpLink(wire, "127.0.0.1", port, sessions, clock=lambda: now_s[0])

    async def look() -> None:
        await link.open()
        task = asyncio.create_task(link.run())
        await asyncio.sleep(0)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    link.received(b"", ("192.0.2.1", 1))
    now_s[0] = FORGOTTEN_AFTER_S - 1
    link.received(b"", ("192.0.2.2", 1))
    asyncio.run(look())
    link.received(b"", ("192.0.2.1", 2))
    assert sessions.made == 2
    now_s[0] += FORGOTTEN_AFTER_S
    asyncio.run(look())
    link.received(b"", ("192.0.2.1", 3))
    assert sessions.made == 3


def test_too_many_senders_push_nobody_out(link: UdpLink, sessions: Sessions, log: Any) -> None:
    for number in range(MOST_SENDERS + 3):
        link.received(b"<PST></PST>", (f"192.0.2.{number}", 1))
    assert sessions.made == MOST_SENDERS
    link.received(b"<PST></PST>", ("192.0.2.0", 1))
    assert sessions.made == MOST_SENDERS
    assert log.count(f"link: {MOST_SENDERS} senders already") == 3


async def test_what_is_too_long_is_dropped_whole(
    link: UdpLink, port: int, running: Running, bench: Any, log: Any
) -> None:
    async with running(link), program(port) as one:
        order = b"<PST><AZIMUTH>300</AZIMUTH></PST>"
        one.send(order + b" " * (MOST_BYTES + 1 - len(order)))
        await one.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (0, 0)
        one.send(order + b" " * (MOST_BYTES - len(order)))
        await one.ask(b"<PST>TGA?</PST>")
        assert bench.drives() == (1, 0)
        await log.wait("127.0.0.1: a datagram of more than 4096 bytes is dropped")


async def test_who_is_not_allowed_is_not_heard(
    wire: Wire, port: int, sessions: Sessions, running: Running, log: Any
) -> None:
    link = UdpLink(wire, "127.0.0.1", port, sessions, answer_port=port + 1, allowed=Allowed(["127.0.0.2"]))

    async with running(link), program(port) as stranger, program(port, "127.0.0.2") as friend:
        stranger.send(b"<PST><AZIMUTH>300</AZIMUTH></PST>")
        assert await friend.ask(b"<PST>TGA?</PST>") == b"TGA:235\r"
        assert sessions.bench.drives() == (0, 0)
        await log.wait("127.0.0.1 is not in allow: not heard")


async def test_nobody_who_hears_answers_is_no_trouble(link: UdpLink, port: int, running: Running, log: Any) -> None:
    async with running(link), program(port, "127.0.0.2") as other:
        with socket.socket(type=socket.SOCK_DGRAM) as deaf:
            for _ in range(3):
                deaf.sendto(b"<PST>TGA?</PST>", ("127.0.0.1", port))
        assert await other.ask(b"<PST>TGA?</PST>") == b"TGA:235\r"
    assert log.said == []


# --- reports


async def test_a_report_goes_out_when_it_is_due(wire: Wire, port: int, sessions: Sessions, running: Running) -> None:
    waiting = [b"G-5500 @ 2350"]
    report = Report(("127.0.0.1", port + 1), lambda _now_s: waiting.pop() if waiting else None)
    link = UdpLink(wire, "127.0.0.1", port, sessions, report=report)

    async with program(port) as n1mm, running(link):
        assert await n1mm.hear() == b"G-5500 @ 2350"


async def test_a_report_that_cannot_be_sent_is_told_and_the_link_lives(
    wire: Wire, port: int, sessions: Sessions, running: Running, log: Any
) -> None:
    """A socket on loopback reaches nobody else."""
    report = Report(("192.0.2.1", 13010), lambda _now_s: b"G-5500 @ 2350")
    link = UdpLink(wire, "127.0.0.1", port, sessions, answer_port=port + 1, report=report)

    async with running(link), program(port) as one:
        await log.wait("link: cannot send: ")
        assert await one.ask(b"<PST>TGA?</PST>") == b"TGA:235\r"


# --- addresses


async def test_broadcasts_are_heard_on_all_addresses(wire: Wire, port: int, new_ear: Any, running: Running) -> None:
    ear = new_ear()
    link = UdpLink(wire, "0.0.0.0", port, lambda: ear)

    with socket.socket(type=socket.SOCK_DGRAM) as mac:
        mac.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        async with running(link):
            mac.sendto(b"[AzEl Rotor Report:...]", ("127.255.255.255", port))
            assert await ear.hears(23) == b"[AzEl Rotor Report:...]"


async def test_ipv6(wire: Wire, port: int, new_ear: Any, running: Running) -> None:
    ear = new_ear()
    link = UdpLink(wire, "::1", port, lambda: ear)

    with socket.socket(socket.AF_INET6, socket.SOCK_DGRAM) as other:
        try:
            other.bind(("::1", 0))
        except OSError:
            pytest.skip("this machine has no IPv6")
        async with running(link):
            other.sendto(b"hello", ("::1", port))
            assert await ear.hears(5) == b"hello"
