"""The places at which a driven axis stood still: an end stop, or ice. A link does not drive it there again.

Knows each direction's place until a person releases the axis, also from before the program began. Knows no motor and
no reading.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.relay_faults import WAYS
from rotator.control.sky.mount import Range
from rotator.exchange.faults import FaultKind, Notice
from rotator.exchange.motor import NO_TRIES, Places, Tries

KEPT_OFF_DEG = 2.0
"""The axis ends this far before a stop that it has met."""
SAME_DEG = 3.0
"""Two places where it stood still in mid-travel are one stop if they are no further apart."""


class MetStops:
    def __init__(self, axis: Axis, limits: Range, before: Tries = NO_TRIES) -> None:
        """`before`: what an earlier run of the program has met."""
        self._axis = axis
        self._limits = limits
        self._stood: Mapping[Direction, float] = _by_way(before.stood_deg)
        """Where the axis stood still last, by direction."""
        self._stops: Mapping[Direction, float] = {}
        self.limits = limits
        """How far the axis may turn now."""
        self.notices: tuple[Notice, ...] = ()
        # Without ends the scale begins anew with each run of the program: a place of the run before says nothing.
        self._keep({} if limits.endless else _by_way(before.stops_deg))

    def stood_still(self, kind: FaultKind, direction: Direction, angle_deg: float) -> None:
        """A fault of that kind: driven in this direction, the axis stood there. Its own brake is no stop."""
        if kind is FaultKind.BRAKE_HELD:
            return
        again = direction in self._stood and abs(self._stood[direction] - angle_deg) <= SAME_DEG
        self._stood = {**self._stood, direction: angle_deg}
        if kind is FaultKind.END_STOP or again:
            self._keep({**self._stops, direction: angle_deg})

    def forget(self) -> None:
        """A person releases the axis."""
        self._stood = {}
        self._keep({})

    @property
    def stood_deg(self) -> Places:
        return self._stood.get(Direction.PLUS), self._stood.get(Direction.MINUS)

    @property
    def stops_deg(self) -> Places:
        return self._stops.get(Direction.PLUS), self._stops.get(Direction.MINUS)

    def _keep(self, stops: Mapping[Direction, float]) -> None:
        self._stops = stops
        low_deg, high_deg = self._limits.min_deg, self._limits.max_deg
        if Direction.PLUS in stops:
            high_deg = max(low_deg, min(high_deg, stops[Direction.PLUS] - KEPT_OFF_DEG))
        if Direction.MINUS in stops:
            low_deg = min(high_deg, max(low_deg, stops[Direction.MINUS] + KEPT_OFF_DEG))
        self.limits = Range(low_deg, high_deg)
        self.notices = tuple(
            Notice(
                f"it stopped at {angle_deg:.0f}° while its motor ran {WAYS[self._axis, direction]}: "
                "it goes there again only after `resume`",
                "STOP MET",
            )
            for direction, angle_deg in stops.items()
        )


def _by_way(places_deg: Places) -> Mapping[Direction, float]:
    ways = zip((Direction.PLUS, Direction.MINUS), places_deg, strict=True)
    return {way: place_deg for way, place_deg in ways if place_deg is not None}
