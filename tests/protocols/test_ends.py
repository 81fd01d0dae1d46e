"""The end of a connection is the end of a line: a whole pair counts, half a pair does not.

And a W counts anywhere in a line of GS-232, unless the file says `strict`.
"""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import pytest

from rotator.exchange.orders import Aim
from rotator.links.tcp import TcpLink
from rotator.links.wire import Wire
from rotator.protocols.gs232 import Dialect
from rotator.protocols.gs232_session import Gs232Session
from rotator.protocols.rotctld_session import RotctldSession
from tests.boxes import free_port
from tests.protocols.fed import connected
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

WHOLE = [("rotctld", b"P 180 45"), ("easycomm2", b"AZ180 EL45"), ("gs232b", b"W180 045"), ("gs232-f1efw", b"W180 045")]
HALF = [
    ("rotctld", b"P 180"),
    ("easycomm2", b"AZ180 EL"),
    ("gs232b", b"W180"),
    ("gs232-f1efw", b"W180"),
    ("rc2800", b""),
]


@pytest.mark.parametrize(("protocol", "said"), WHOLE)
def test_a_whole_pair_counts(box: BenchBox, protocol: str, said: bytes) -> None:
    session = connected(protocol, box)
    assert session.receive(said) == []
    assert box.orders == []
    session.finish()
    session.finish()
    assert box.orders == [Aim(180, 45)]


@every_row(("protocol", "said"), HALF)
def test_half_a_pair_does_not(new_box: type[BenchBox], protocol: str, said: bytes) -> None:
    box = new_box(at=(235, 25))
    session = connected(protocol, box)
    session.receive(said)
    session.finish()
    assert box.orders == []


def test_a_program_that_hangs_up_at_once_gets_its_answer(box: BenchBox) -> None:
    """As `echo -n "P 180 45" | nc -N`."""

    async def main() -> bytes:
        port = free_port()
        link = TcpLink(Wire("rotctld", "rotctld", ""), "127.0.0.1", port, lambda: RotctldSession(box))
        await link.open()
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(b"P 180 45")
        writer.write_eof()
        answer = await reader.read()
        writer.close()
        link.close()
        return answer

    assert asyncio.run(main()) == b"RPRT 0\n"
    assert box.orders == [Aim(180, 45)]


@every_row("line", [b"XW180 045", b"AOS w180045", b"W12 W180 045", b"W100 020W180 045 ;", b"? W 180 045"])
def test_w_anywhere_in_a_line(new_box: type[BenchBox], line: bytes) -> None:
    lenient, strict = new_box(), new_box()
    assert Gs232Session(lenient, Dialect.A).receive(line + b"\r") == []
    assert lenient.orders == [Aim(180, 45)]
    assert Gs232Session(strict, Dialect.A, strict=True).receive(line + b"\r") == [b"?>\r\n"]
    assert strict.orders == []
    assert strict.refused == [line]


@every_row("line", [b"XW180 45", b"XW180 04x", b"XW180 045x", b"XW1800 045", b"XM180", b"XW180 045 7"])
def test_but_not_what_may_be_damaged(new_box: type[BenchBox], line: bytes) -> None:
    box = new_box(at=(235, 25))
    assert Gs232Session(box, Dialect.B).receive(line + b"\r") == [b"?>\r\n"]
    assert box.orders == []
