"""docs/reference/programs.md lists programs; what each says, the protocol named for it takes."""

from __future__ import annotations

from typing import get_args

import pytest

from rotator.assembly.sessions import session_maker
from rotator.config.links import Link, ProtocolName
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal
from rotator.exchange.status import AxisStatus, Status
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.protocols.reference.programs import PROGRAMS, Program

PLACES: dict[str, dict[str, str]] = {
    "pstrotator": {"udp": "127.0.0.1:12000"},
    "n1mm": {"udp": "127.0.0.1:12040", "rotor_name": "mast"},
    "macdoppler": {"udp": "127.0.0.1:9932"},
    "wsjtx": {"file": "azel.dat"},
    "stellarium": {"tcp": "127.0.0.1:10001"},
    "pstrotatoraz": {"tcp": "127.0.0.1:8080"},
}
SKY = Sky(Site(54.0, 20.0), lambda: 1.8e9)
QUESTIONS = (b"C", b"p", b"<PST>AZ?", b"B", b"P45", b"W\0", b":G", b"#:G", b"\x06", b"GET /PstRotatorAz.htm ")
"""What moves nothing."""


class Notebook:
    """A box at 235/25 that writes down its orders."""

    def __init__(self) -> None:
        self.orders: list[Order] = []

    def status(self) -> Status:
        return Status(0.0, AxisStatus(0, 450, 235.0), AxisStatus(0, 180, 25.0))

    def note_refused(self, _refused: Refusal | bytes) -> None:
        """Nobody reads the log here."""

    def order(self, order: Order) -> None:
        self.orders.append(order)


def test_every_protocol_has_its_program() -> None:
    named = {protocol for program in PROGRAMS for protocol in program.protocols}
    # Levels of one standard, one-axis forms and the box's own question have their sections on the page.
    assert set(get_args(ProtocolName)) - named == {"easycomm1", "easycomm3", "rot1prog", "rotctld-follow"}


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_what_it_says_is_understood(program: Program) -> None:
    protocol = program.protocols[0]
    for said in program.says:
        box = Notebook()
        place = PLACES.get(protocol, {"pty": "run/test"})
        session = session_maker(
            Link.model_validate({"protocol": protocol, **place, **dict(program.keys)}), box, sky=SKY
        )
        if protocol == "wsjtx":
            session.receive(b"02:59:47,198.8, 61.8,Moon\n")  # only a file that goes on is followed
        replies = b"".join([*session.receive(said), *session.idle()])
        assert b"?>" not in replies
        assert b"RPRT -" not in replies
        assert bool(box.orders) is not said.startswith(QUESTIONS), f"{said!r}: {box.orders}"
