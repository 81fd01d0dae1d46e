"""Pieces of bytes given to a session: its answers are well formed, and it does not keep what has no end.

Knows bytes and memory. Knows no protocol.
"""

from __future__ import annotations

import re
import tracemalloc
from collections.abc import Collection, Sequence

from rotator.protocols.session import Session


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
