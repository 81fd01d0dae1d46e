"""The rock of an axis whose wedge brake sticks: once, a short run the other way, so that the wedge comes free.

Knows one try: which way, and for how long. Does not know why the axis stands, nor whether a run is permitted.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayState
from rotator.control.commands import Run

ROCK_S = 0.5
"""The length of the run the other way."""
GIVES_UP_S = 4.0
"""A run that could not begin for so long, at a limit for example, is left out."""


class Rock:
    def __init__(self, *, wanted: bool) -> None:
        self._wanted = wanted
        self._spent = False
        self._way = self._way_tried = Direction.OFF
        """The way of the run that is to come or goes on, OFF: there is none; and of the latest one."""
        self._from_s = 0.0

    @property
    def may_begin(self) -> bool:
        """Whether the operator wants it, and it was not tried since the axis turned or a person looked."""
        return self._wanted and not self._spent

    def begin(self, now_s: float, stood: Direction) -> None:
        """The motor ran in this direction, and the axis stood."""
        self._spent, self._from_s = True, now_s
        self._way = self._way_tried = Direction(-stood)

    def renew(self) -> None:
        """A person has looked: the next wedge that sticks gets its own try."""
        self._spent = False

    def turned(self, way: Direction) -> None:
        """Driven in this direction the axis turns: if it is the one in which it stood, the try has helped."""
        self._spent = self._spent and way is self._way_tried

    def end(self) -> None:
        self._way = Direction.OFF

    def run(self, now_s: float, relays: RelayState, lease_s: float) -> Run | None:
        """The run the other way; None: it is over, or there is none."""
        begun = relays.last is self._way and relays.begun_s >= self._from_s
        until_s = relays.begun_s + ROCK_S if begun else now_s + ROCK_S
        if self._way is Direction.OFF or now_s >= until_s or now_s >= self._from_s + GIVES_UP_S:
            self.end()
            return None
        return Run(self._way, min(now_s + lease_s, until_s))
