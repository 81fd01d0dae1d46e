"""From the `[[link]]` tables of the configuration to running links. Part of the composition root.

Knows which class carries the bytes of which kind of port or socket, and what the connections of a link share.
`sessions` knows the protocols. Carries no bytes itself.
"""

# ruff: noqa: PLC0415 - a box loads the links that it has

from __future__ import annotations

import itertools
import logging
import math
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from hw.ports import Axis
from rotator.assembly.sessions import BINARY, HTTP, session_maker
from rotator.config.links import FOLLOW, Link, address
from rotator.control.sky.mount import Mount
from rotator.exchange.sources import Source
from rotator.links.listening import Allowed
from rotator.links.pty import PtyLink
from rotator.links.tcp import TcpLink
from rotator.links.wire import Wire
from rotator.monitor.tap import Tap, TappedInquiry, TappedSession
from rotator.monitor.transcript import Way
from rotator.protocols.move_report import MoveReport
from rotator.protocols.one_axis import OneAxis
from rotator.protocols.rotctld_follow import RotctldFollower
from rotator.protocols.session import Box, Inquiry, Session
from rotator.runtime.client import Client, Rights
from rotator.runtime.log_limit import LogLimit
from rotator.runtime.loop import ControlLoop

if TYPE_CHECKING:
    from rotator.links.udp import Report
    from rotator.orbits.celestial import Sky

log = logging.getLogger(__name__)

MOST_REMARKS = 20
"""On one link, so many different remarks on what a program asks for and the box does not have are logged, each once."""


class RunningLink(Protocol):
    wire: Wire

    async def open(self) -> None:
        """Take the port or address, where there is one to take. Raises LinkError."""

    async def run(self) -> None:
        """Carry bytes until cancelled."""

    def close(self) -> None:
        """Give back what `open` took. May be called twice, and without `open`."""


def build_links(
    links: Sequence[Link], loop: ControlLoop, mount: Mount, tap: Tap, sky: Sky | None = None
) -> list[RunningLink]:
    """The links, each with a name of its own, because the name identifies a source: the second gs232b is gs232b-2."""
    built: list[RunningLink] = []
    configured = {link.name for link in links}
    taken: set[str] = set()
    for link in links:
        plain = link.name or link.protocol
        names = (plain if number == 1 else f"{plain}-{number}" for number in itertools.count(1))
        name = next(name for name in names if name not in taken and (name == link.name or name not in configured))
        taken.add(name)
        wire = Wire(name, link.protocol, link.where)
        tap.link(wire, link.model_dump(exclude_unset=True))
        built.append(_build(link, wire, _Connections(link, name, loop, mount, tap=tap, sky=sky)))
    return built


class _Connections:
    """Makes the conversation of each connection of one link, and what the link sends unasked. The connections share
    their rights and log limits."""

    def __init__(self, link: Link, name: str, loop: ControlLoop, mount: Mount, *, tap: Tap, sky: Sky | None) -> None:
        self._link = link
        self._name = name
        self._loop = loop
        self._mount = mount
        self._tap = tap
        self._numbers = itertools.count(1)
        self._rights = Rights(link.read_only, link.most_per_s)
        self._complaints = LogLimit(time.monotonic)
        self._ranges = LogLimit(time.monotonic, most=1)
        remark = partial(self._log, LogLimit(time.monotonic, every_s=math.inf, most=MOST_REMARKS))
        notice = partial(self._log, LogLimit(time.monotonic))
        self._make = None if link.protocol == FOLLOW else session_maker(link, remark, sky=sky, notice=notice)
        """None: on this link the box asks."""

    def session(self) -> Session:
        assert self._make is not None
        source, client = self._client()
        session = self._make(_seen_by(self._link, client))
        if self._link.report_moves:
            session = MoveReport(session, client)
        text = self._link.protocol not in BINARY
        return TappedSession(session, self._tap, source, text=text, ended=client.left, came=client.comes_from)

    def follower(self) -> Inquiry:
        source, client = self._client()
        return TappedInquiry(RotctldFollower(client, self._link.poll_s), self._tap, source)

    def report(self) -> Report | None:
        """What the link sends unasked; None: nothing."""
        link, source = self._link, Source(self._name)
        if link.status_to is None or link.rotor_name is None:
            return None
        from rotator.links.udp import Report
        from rotator.protocols.n1mm import N1mmReport

        reporter = N1mmReport(_seen_by(link, Client(self._loop, self._mount, source)), link.rotor_name)

        def due(now_s: float) -> bytes | None:
            datagram = reporter.due(now_s)
            self._tap.note(source, Way.OUT, datagram or b"", text=True)
            return datagram

        return Report(address(link.status_to), due)

    def _client(self) -> tuple[Source, Client]:
        source = Source(self._name, next(self._numbers))
        rights, complaints, ranges = self._rights, self._complaints, self._ranges
        return source, Client(self._loop, self._mount, source, rights=rights, complaints=complaints, ranges=ranges)

    def _log(self, limit: LogLimit, text: str) -> None:
        if line := limit.admit(text):
            log.info("%s: %s", self._name, line)


def _build(link: Link, wire: Wire, connections: _Connections) -> RunningLink:
    if link.pty is not None:
        return PtyLink(wire, Path(link.pty), connections.session)
    if link.serial is not None:
        from rotator.links.serial import SerialLink

        return SerialLink(wire, link.serial, link.serial_baud, connections.session)
    if link.file is not None:
        from rotator.links.file import FileLink

        return FileLink(wire, Path(link.file), connections.session)
    host, port = address(link.where)
    if link.udp is not None:
        from rotator.links.udp import UdpLink
        from rotator.protocols.pstrotator import ANSWERS_ABOVE

        return UdpLink(
            wire,
            host,
            port,
            connections.session,
            answer_port=port + ANSWERS_ABOVE if link.protocol == "pstrotator" else None,
            report=connections.report(),
            allowed=Allowed(link.allow),
        )
    if link.protocol == FOLLOW:
        from rotator.links.asking import AskingLink

        return AskingLink(wire, host, port, connections.follower, every_s=link.poll_s)
    return TcpLink(
        wire,
        host,
        port,
        connections.session,
        allowed=Allowed(link.allow),
        most_clients=link.most_clients,
        speaks_http=link.protocol in HTTP,
    )


def _seen_by(link: Link, box: Box) -> Box:
    return OneAxis(box, Axis(link.axis)) if link.axis else box
