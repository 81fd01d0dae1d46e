"""How far each of the two relays of an axis is trusted to be open.

Knows what has been reported of them. Does not know how that was found out: `opening_watch` and `contact_watch` do.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.exchange.motor import Trust, Trusts

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
