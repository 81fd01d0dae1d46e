"""Follows one axis while a person sets it up: what its readings did from one rest to the next.

Knows the statuses as they come, one after the other. Asks nothing, says nothing, orders nothing.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.calibrating.answers import Press
from rotator.calibrating.readings import SHARES, Grain, Turned, turned
from rotator.status import AxisStatus, Status

REST_READINGS = 10
"""Kept from before a turn, to know where it began."""
EXPECT_S = 1.0
"""A press that has moved nothing for so long (dead time and all) moves nothing."""
STANDING_S = 1.0
"""Driven this long with a reading that stands still, and the axis is at a stop, or something is broken."""


@dataclass(frozen=True, slots=True)
class Move:
    """A turn has ended and the axis rests. `turned` is None where it went both ways, or the sensor failed."""

    direction: Direction
    turned: Turned | None


class Watch:
    """`settle_s`: how long the axis moves on after it says that it does not move."""

    def __init__(self, axis: Axis, grain: Grain = SHARES, settle_s: float = 0.0) -> None:
        self._axis = axis
        self._grain = grain
        self._settle_s = settle_s
        self._moved_s = 0.0
        self._rest: deque[float] = deque(maxlen=REST_READINGS)
        self._during: list[tuple[float, float]] = []
        """When, and what it read."""
        self._ways: set[Direction] = set()
        self._failed = False
        self._expected_until_s: float | None = None
        self._seen_s: float | None = None
        self.status: AxisStatus | None = None

    def press(self, press: Press, now_s: float) -> None:
        """The axis has been told to turn."""
        self._expected_until_s = now_s + min(press.seconds, EXPECT_S) + 0.1

    def halt(self) -> None:
        self._expected_until_s = None

    @property
    def driven(self) -> bool:
        """The motor runs, or is about to."""
        running = self.status is not None and self.status.drive is not Direction.OFF
        return running or self._expected_until_s is not None

    @property
    def resting(self) -> bool:
        """It neither runs nor is about to nor coasts."""
        return not self.driven and not self._ways

    def see(self, status: Status) -> Move | None:
        """Take a status; the same one again is no news. Returns the move that has ended with it."""
        if status.at_s == self._seen_s:
            return None
        self._seen_s = status.at_s
        self.status = axis = status.axis(self._axis)
        if axis.drive is not Direction.OFF:
            self._ways.add(axis.drive)
            self._expected_until_s = None
        elif self._expected_until_s is not None and status.at_s > self._expected_until_s:
            self._expected_until_s = None
        self._failed |= axis.fault is not None and bool(self._ways)
        if axis.raw is not None:
            if self._ways:
                self._during.append((status.at_s, axis.raw))
            else:
                self._rest.append(axis.raw)
        if axis.moving:
            self._moved_s = status.at_s
            return None
        return self._end() if self._ways and status.at_s - self._moved_s >= self._settle_s else None

    def stands(self) -> bool:
        """It has been driven for a while and the reading stands still."""
        if not self.driven or not self._during:
            return False
        began_s, now_s = self._during[0][0], self._during[-1][0]
        latest = [raw for at_s, raw in self._during if now_s - at_s <= STANDING_S]
        half = len(latest) // 2
        if now_s - began_s <= STANDING_S or half < REST_READINGS // 2:
            return False
        return turned(latest[:half], latest[half:], self._grain).stood

    def _end(self) -> Move:
        ways, failed = self._ways, self._failed
        during = [raw for _, raw in self._during]
        before = list(self._rest) or during[:1]
        self._ways, self._during, self._failed = set(), [], False
        self._rest.clear()
        self._rest.extend(during[-REST_READINGS:])
        whole = len(ways) == 1 and not failed and len(during) >= REST_READINGS
        return Move(next(iter(ways)), turned(before, during, self._grain) if whole else None)
