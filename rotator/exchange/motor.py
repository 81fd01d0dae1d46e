"""What the box knows of a motor and its relays from one run to the next: learnt figures, trust, vain tries.

Knows only values. `rotator.store` keeps them in files, `rotator.control` finds them out.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rotator.exchange.faults import FaultKind


@dataclass(frozen=True, slots=True)
class Motor:
    """One direction of a motor, as described in the configuration or as measured by the box."""

    speed_dps: float
    coast_deg: float
    """The coast after a switch-off at full speed."""

    @property
    def lag_s(self) -> float:
        """The time in which it gathers most of its speed, or loses it."""
        return max(self.coast_deg / self.speed_dps, 1e-3)


class Trust(Enum):
    """The knowledge of a motor relay that was switched off. Each value except OPEN keeps the opposite relay open."""

    OPEN = "open"
    """The axis has been seen to stop when this relay opened, and the relay has not been closed since."""
    UNSEEN = "not seen yet"
    """The relay was closed, or may have been. A window of readings will decide."""
    DOUBTED = "doubted"
    """The window is over without a result: the axis stands at a place where a motor with current might stand too."""
    WELDED = "found closed"
    """The axis ran on after this relay was switched off, or turned by itself."""


Trusts = tuple[Trust, Trust]
"""Trust in the relay clockwise or up, and in the opposite relay."""
ALL_OPEN: Trusts = (Trust.OPEN, Trust.OPEN)

Places = tuple[float | None, float | None]
"""Angles of stops met clockwise or up, and in the other direction; None: no stop met."""


@dataclass(frozen=True, slots=True)
class Tries:
    """The vain tries of one motor: the next run of the program continues their count."""

    faults: int = 0
    """The number of recent faults that stopped it."""
    kind: FaultKind | None = None
    """The latest of those faults."""
    stood_deg: Places = (None, None)
    """The last angle at which the driven axis stood still."""
    stops_deg: Places = (None, None)
    """The stops that the axis has met. Only a person lets it go there again."""
    pressed: bool = False
    """Whether presses did not move the axis while it had no calibration."""
    driven: bool = False
    """Whether its latest run has no visible motion yet."""


NO_TRIES = Tries()
