"""docs/reference/programs.md lists programs; what each says, the protocol named for it takes."""

from __future__ import annotations

from typing import get_args

from rotator.config.links import ProtocolName
from rotator.protocols.programs import PROGRAMS, Program
from tests.protocols.fed import Notebook, connected
from tests.tables import every_row

QUESTIONS = (b"C", b"p", b"<PST>AZ?", b"B", b"P45", b"W\0", b":G", b"#:G", b"\x06", b"GET /PstRotatorAz.htm ")
"""What moves nothing."""


def test_every_protocol_has_its_program() -> None:
    named = {protocol for program in PROGRAMS for protocol in program.protocols}
    # Levels of one standard, one-axis forms and the box's own question have their sections on the page.
    assert set(get_args(ProtocolName)) - named == {"easycomm1", "easycomm3", "rot1prog", "rotctld-follow"}


@every_row("program", PROGRAMS)
def test_what_it_says_is_understood(program: Program) -> None:
    protocol = program.protocols[0]
    for said in program.says:
        box = Notebook()
        session = connected(protocol, box, **dict(program.keys))
        if protocol == "wsjtx":
            session.receive(b"02:59:47,198.8, 61.8,Moon\n")  # only a file that goes on is followed
        replies = b"".join([*session.receive(said), *session.idle()])
        assert b"?>" not in replies
        assert b"RPRT -" not in replies
        assert bool(box.orders) is not said.startswith(QUESTIONS), f"{said!r}: {box.orders}"
