"""A port that echoes, as Linux ports do until a program sets them: what the box answers comes back, and that ends soon.

For each protocol that answers on a serial port, its usual question and a line that means nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from rotator.assembly.sessions import session_maker
from tests.assembly.test_links import DIALOGUES, PLACES, SKY, link
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

ON_A_PORT = [(keys, asked) for keys, asked, _ in DIALOGUES if keys.split('"')[1] not in PLACES]
SOON = 4
"""Answers to answers. None is needed; a table of commands that comes back gets one for each line, once."""


def as_sent(reply: bytes) -> bytes:
    """A half-duplex adapter: what it sends, it hears."""
    return reply


def by_a_terminal(reply: bytes) -> bytes:
    """Linux with its usual settings: a carriage return is a line feed, and a line feed goes out as both."""
    return reply.replace(b"\r", b"\n").replace(b"\n", b"\r\n")


@every_row("echo", [as_sent, by_a_terminal])
@every_row(("keys", "asked"), ON_A_PORT)
def test_an_echo_dies_away(new_box: type[BenchBox], keys: str, asked: bytes, echo: Callable[[bytes], bytes]) -> None:
    for said in (asked, b"nonsense\r", b"\r", b"H\rH2\rH3\r", b"p\n_\n\\dump_caps\n"):
        session = session_maker(link(keys), sky=SKY)(new_box(at=(235, 25)))
        replies = session.receive(said)
        for _ in range(SOON):
            replies = session.receive(b"".join(map(echo, replies)))
        assert replies == [], said
