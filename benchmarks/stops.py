"""How soon a stop opened the relays, from the times of the stops and the edges of the relays' lines.

Knows that a stop may find no relay closed: a jog first waits until the axis stands. Knows nothing of the box. Has a
free port of this machine for a box that is measured while another one runs.
"""

from __future__ import annotations

import socket
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

IN_VAIN_S = 1.0
"""A relay that opens later has not opened for this stop."""

Edge = tuple[float, int, bool]
"""When, which line, and whether it is on."""


@dataclass(frozen=True, slots=True)
class Stops:
    after_ms: list[float]
    """From the last byte of each stop to the relay's line, in milliseconds."""
    unmet: int
    """Stops after which a closed relay did not open within IN_VAIN_S."""
    idle: int
    """Stops that came before the jog had closed a relay."""


def opened(sent_s: Iterable[float], edges: Sequence[Edge]) -> Stops:
    after_ms: list[float] = []
    unmet = idle = 0
    for at_s in sent_s:
        if not _closed(edges, at_s):
            idle += 1
            continue
        off_s = min((edge_s for edge_s, _, on in edges if edge_s >= at_s and not on), default=float("inf"))
        if off_s - at_s < IN_VAIN_S:
            after_ms.append(1000 * (off_s - at_s))
        else:
            unmet += 1
    return Stops(after_ms, unmet, idle)


def _closed(edges: Iterable[Edge], now_s: float) -> bool:
    """Whether a relay was closed then."""
    return any({pin: on for at_s, pin, on in edges if at_s < now_s}.values())


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port
