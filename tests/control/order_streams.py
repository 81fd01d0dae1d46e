"""Who sends orders in the tests of authority, and a stream of orders as a tracking program sends it."""

from __future__ import annotations

from rotator.control.authority import Authority
from rotator.exchange.sources import Source

CONSOLE = Source("console")
PST, GPREDICT, GPREDICT_AGAIN = Source("gs232b", 1), Source("rotctld", 1), Source("rotctld", 2)
HERE, THERE = (180.0, 45.0), (20.0, 10.0)


def stream(authority: Authority, source: Source, *, from_s: float = 0.0, until_s: float) -> list[bool]:
    """An order for HERE every second; returns which had an effect."""
    return [authority.may_move(source, float(at_s), HERE) for at_s in range(int(from_s), int(until_s) + 1)]
