"""What tracking needs of the rest of the box: the antenna, the planner, the sky; and the tracker's name as a sender.

Knows these as interfaces. `rotator.assembly` chooses what stands behind them.
"""

from __future__ import annotations

from typing import Protocol

from rotator.control.sky.flight_plan import Antenna
from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import TRACKER, Source
from rotator.exchange.status import Status
from rotator.tracking.next_flight import NextFlight, Now, Wanted
from rotator.tracking.program import Program

TRACK = Source(TRACKER)


class Planner(Protocol):
    def plan(self, wanted: Wanted, antenna: Antenna, now: Now) -> NextFlight:
        """Raises NeverRises, NotThere, Unknown; RuntimeError where the plan could not be made."""

    def plan_rest(self, wanted: Wanted, antenna: Antenna, now: Now) -> Fly:
        """The rest of a present pass. Raises NotThere, RuntimeError."""

    def plan_program(self, program: Program, antenna: Antenna, now: Now) -> NextFlight:
        """Raises CannotFly, RuntimeError."""


class Finder(Protocol):
    def find(self, words: str) -> Wanted | Aim:
        """A target that moves, or a fixed direction. Raises Unknown, NotThere."""

    def has_news(self) -> bool:
        """Whether a file of elements is new, or has changed, and has not been read yet."""


class Box(Protocol):
    """The box, as tracking sees it. No call waits."""

    def status(self) -> Status: ...

    def antenna(self) -> Antenna | None:
        """The antenna as it stands; None: its angles are not known."""

    def refusal(self, order: Order) -> str:
        """Why the rotor cannot obey this order; empty: it can."""

    def order(self, order: Order, source: Source = TRACK) -> None: ...
