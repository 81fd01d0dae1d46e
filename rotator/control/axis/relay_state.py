"""What the relays of one axis do, and what they did last; and how far each is trusted to be open.

Knows directions and moments, and what has been reported. Does not know how that was found out: `opening_watch` and
`contact_watch` do.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from hw.ports import Direction
from rotator.exchange.motor import Trust, Trusts

BLINK_S = 0.1
"""A relay that closes again this soon after it opened continues its run: a stop, then the same order once more."""


@dataclass(frozen=True, slots=True)
class RelayState:
    """The defaults are the state at the start: no relay was closed yet."""

    direction: Direction = Direction.OFF
    since_s: float = -math.inf
    """When the relays last changed."""
    last: Direction = Direction.OFF
    """The direction of the present or latest run; OFF: there was none yet."""
    begun_s: float = -math.inf
    """When that run began. A blink of its relay does not end a run."""

    closed: bool = field(init=False, repr=False, compare=False)
    """Whether one of them is closed."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "closed", self.direction is not Direction.OFF)

    def off_for_s(self, now_s: float) -> float:
        """For how long both have been open; 0 while one is closed."""
        return 0.0 if self.closed else now_s - self.since_s

    def changed(self, now_s: float, direction: Direction) -> RelayState:
        """The state from now on, where the relays drive in this direction. The same state: nothing changed."""
        if direction is self.direction:
            return self
        if direction is Direction.OFF:
            return RelayState(direction, now_s, self.last, self.begun_s)
        goes_on = not self.closed and direction is self.last and now_s - self.since_s < BLINK_S
        return RelayState(direction, now_s, direction, self.begun_s if goes_on else now_s)


BOTH_WAYS = (Direction.PLUS, Direction.MINUS)


class RelayTrusts:
    """`trusts`: what an earlier run of the program has left."""

    def __init__(self, trusts: Trusts) -> None:
        self._of = dict(zip(BOTH_WAYS, trusts, strict=True))

    @property
    def both(self) -> Trusts:
        return self._of[Direction.PLUS], self._of[Direction.MINUS]

    def of(self, way: Direction) -> Trust:
        return self._of[way]

    def closed(self, way: Direction) -> None:
        """This relay is closed, or may be. An older doubt stays."""
        if self._of[way] is Trust.OPEN:
            self._of[way] = Trust.UNSEEN

    def look_again(self, way: Direction) -> None:
        """What raised the doubt of this relay is over: readings may show now whether it is open."""
        if self._of[way] is Trust.DOUBTED:
            self._of[way] = Trust.UNSEEN

    def seen_open(self, way: Direction) -> None:
        self._of[way] = Trust.OPEN

    def doubt(self, way: Direction) -> None:
        self._of[way] = Trust.DOUBTED

    def found_closed(self, way: Direction) -> None:
        self._of[way] = Trust.WELDED

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._of = dict.fromkeys(BOTH_WAYS, Trust.OPEN)
