"""Packets without an end of line, given to a session again and again: it must not keep them.

Knows bytes and memory. Knows no protocol.
"""

from __future__ import annotations

import tracemalloc

from rotator.protocols.session import Session


def assert_not_kept(session: Session, packet: bytes, times: int = 32) -> None:
    """The session answers none of these packets, and its memory stays small."""
    tracemalloc.start()
    for _ in range(times):
        assert session.receive(packet) == []
    kept, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert kept < 20_000
    assert peak < 100_000
