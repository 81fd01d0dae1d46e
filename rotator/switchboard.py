"""The switchboard of the composition root: from a `[[link]]` table to a running link that speaks its protocol.

Knows which class carries the bytes of which place, and which one speaks which protocol. Moves nothing itself.
"""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Protocol

from rotator.config.links import Link, address
from rotator.control.mount import Mount
from rotator.door import Door
from rotator.links.pty import PtyLink
from rotator.links.serial import SerialLink
from rotator.links.tcp import TcpLink
from rotator.links.wire import Wire
from rotator.loop import ControlLoop
from rotator.orders import Source
from rotator.protocols.f1efw import F1efwSession
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld import RotctldSession
from rotator.protocols.session import Box, Session


class RunningLink(Protocol):
    wire: Wire

    async def open(self) -> None: ...

    async def run(self) -> None: ...


def session_maker(link: Link, box: Box) -> Session:
    """A fresh conversation on a link, in its protocol."""
    match link.protocol:
        case "gs232a" | "gs232b":
            return Gs232Session(
                box,
                Dialect.A if link.protocol == "gs232a" else Dialect.B,
                ack=b"\r" if link.ack == "cr" else b"",
                may_calibrate=link.may_calibrate,
            )
        case "gs232-f1efw":
            return F1efwSession(box)
        case "rotctld":
            return RotctldSession(box)


def build_link(link: Link, loop: ControlLoop, mount: Mount) -> RunningLink:
    wire = Wire(link.name or link.protocol, link.protocol, link.where)
    connections = itertools.count(1)

    def session() -> Session:
        return session_maker(link, Door(loop, mount, Source(wire.name, next(connections))))

    if link.pty is not None:
        return PtyLink(wire, Path(link.pty), session)
    if link.serial is not None:
        return SerialLink(wire, link.serial, link.baud, session)
    host, port = address(link.where)
    return TcpLink(wire, host, port, session)
