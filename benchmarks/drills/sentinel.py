"""The sentinel of a drill: it hears every lease of a relay, and notices when the program falls silent during a lease.

Knows the two words `renew` and `rest`, and time, as `hw/safety/sentinel_process.py` does. Opens no relay: a drill in
which the sentinel would have killed the program has already shown a bug.
"""

from __future__ import annotations

from firmware_sim.clock import SimClock

SILENCE_S = 0.7
"""Seconds of silence after which the real sentinel opens the relays (docs/safety.md)."""


class DrilledSentinel:
    def __init__(self, clock: SimClock) -> None:
        self._clock = clock
        self._leased_s: float | None = None
        """When a lease was last renewed; None: all relays are open."""

    def renew(self) -> None:
        self._leased_s = self._clock()

    def rest(self) -> None:
        self._leased_s = None

    @property
    def kills(self) -> bool:
        """Whether the program has been silent for too long while a relay is closed."""
        return self._leased_s is not None and self._clock() > self._leased_s + SILENCE_S
