"""What sessions are tried with: a box that only writes down, a link of any protocol, pieces of bytes without an end."""

from __future__ import annotations

import re
import tracemalloc
from collections.abc import Collection, Sequence

from rotator.assembly.sessions import session_maker
from rotator.config.links import Link
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal
from rotator.exchange.status import AxisStatus, Status
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.protocols.session import Box, Session

_UDP, _TCP = {"udp": "127.0.0.1:12000"}, {"tcp": "127.0.0.1:8080"}
PLACES = {"pstrotator": _UDP, "n1mm": _UDP, "macdoppler": _UDP, "wsjtx": {"file": "azel.dat"}}
PLACES |= {"stellarium": _TCP, "pstrotatoraz": _TCP}
"""Where those are spoken that no pseudo-terminal carries."""
SKY = Sky(Site(52.5, 13.4), lambda: 1.8e9)
AZIMUTH, ELEVATION = AxisStatus(0.0, 450.0, angle_deg=235.0), AxisStatus(0.0, 180.0, angle_deg=25.0)


class Notebook:
    """A box that takes every order, as few rotors do, and shows what it is told to show."""

    def __init__(self, azimuth: AxisStatus = AZIMUTH, elevation: AxisStatus = ELEVATION) -> None:
        self.orders: list[Order] = []
        self.shown = Status(0.0, azimuth, elevation)

    def status(self) -> Status:
        return self.shown

    def note_refused(self, _refused: Refusal | bytes) -> None:
        """Nobody reads the log here."""

    def order(self, order: Order) -> Refusal | None:
        self.orders.append(order)
        return None


def connected(protocol: str, box: Box, **keys: object) -> Session:
    """A connection on a link of this protocol, with these keys beside its place."""
    link = Link.model_validate({"protocol": protocol, **PLACES.get(protocol, {"pty": "x"}), **keys})
    return session_maker(link, sky=SKY)(box)


def assert_well_formed(session: Session, pieces: Sequence[bytes], silences: Collection[int], pattern: bytes) -> None:
    """Each answer of the session matches the pattern. `silences`: the numbers of the pieces after which it is idle."""
    for number, piece in enumerate(pieces):
        replies = session.receive(piece) + (session.idle() if number in silences else [])
        assert all(re.fullmatch(pattern, reply) for reply in replies)


def assert_not_kept(session: Session, packet: bytes, times: int = 32) -> None:
    """The session answers none of these packets without an end of line, and its memory stays small."""
    tracemalloc.start()
    for _ in range(times):
        assert session.receive(packet) == []
    kept, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert kept < 20_000
    assert peak < 100_000
