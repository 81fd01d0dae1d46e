"""Follows one axis during its calibration: what its readings did from one rest to the next.

Knows the statuses in the order they come. Asks, says and orders nothing.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import takewhile

from hw.ports import Axis, Direction
from rotator.calibrating.entries import Press
from rotator.calibrating.readings import SHARES, Movement, ReadingUnit, movement, stands
from rotator.exchange.status import AxisStatus, Status

REST_READINGS = 10
"""Readings kept from before a movement, to know where it began."""
EXPECT_S = 1.0
"""A press that has not started the motor after this time (dead time included) will not start it. A relay that waits
until its opposite is seen to open takes longer."""
STANDING_S = 1.0
"""Driven for this long while the reading stands: the axis is at a stop, or something is broken."""


@dataclass(frozen=True, slots=True)
class AxisMoved:
    """The axis has moved and rests again. `movement` is None where it went both ways, or the sensor failed."""

    direction: Direction
    movement: Movement | None


class ReadingWatch:
    """`settle_s`: how long the axis still moves after its status says that it stands."""

    def __init__(self, axis: Axis, unit: ReadingUnit = SHARES, settle_s: float = 0.0) -> None:
        self._axis = axis
        self._unit = unit
        self._settle_s = settle_s
        self._moved_s = 0.0
        self._rest: deque[float] = deque(maxlen=REST_READINGS)
        self._during: list[tuple[float, float]] = []
        """(moment, reading) since the movement began."""
        self._directions: set[Direction] = set()
        self._runs_s = 0.0
        """Since when the motor runs this way. Before that the axis stood, or went the other way."""
        self._failed = False
        self._expected_until_s: float | None = None
        self._seen_s: float | None = None
        self._status: AxisStatus | None = None

    def press(self, press: Press, now_s: float) -> None:
        """The axis has been ordered to turn."""
        self._expected_until_s = now_s + min(press.seconds, EXPECT_S) + 0.1

    def halt(self) -> None:
        self._expected_until_s = None

    @property
    def driven(self) -> bool:
        """The motor runs, or is about to run."""
        running = self._status is not None and self._status.drive is not Direction.OFF
        return running or self._expected_until_s is not None

    @property
    def resting(self) -> bool:
        """The motor does not run, is not about to run, and the axis does not coast."""
        return not self.driven and not self._directions

    def see(self, status: Status) -> AxisMoved | None:
        """Take a status; the same one a second time changes nothing. Returns the movement that ended with it."""
        if status.at_s == self._seen_s:
            return None
        self._seen_s = status.at_s
        axis = status.axis(self._axis)
        if self._status is None or axis.drive is not self._status.drive:
            self._runs_s = status.at_s
        self._status = axis
        if axis.drive is not Direction.OFF:
            self._directions.add(axis.drive)
            self._expected_until_s = None
        elif axis.waiting and self._expected_until_s is not None:
            self._expected_until_s = max(self._expected_until_s, status.at_s + EXPECT_S)
        elif self._expected_until_s is not None and status.at_s > self._expected_until_s:
            self._expected_until_s = None
        self._failed |= axis.fault is not None and bool(self._directions)
        if axis.raw is not None:
            if self._directions:
                self._during.append((status.at_s, axis.raw))
            else:
                self._rest.append(axis.raw)
        if axis.moving:
            self._moved_s = status.at_s
            return None
        settled = status.at_s - self._moved_s >= self._settle_s
        return self._end() if self._directions and settled else None

    def stands(self) -> bool:
        """The motor has run for a while and the reading, which comes without a fault, does not change."""
        if self._status is None or self._status.drive is Direction.OFF or not self._during or self._failed:
            return False
        now_s = self._during[-1][0]
        lately = takewhile(lambda seen: now_s - seen[0] <= STANDING_S, reversed(self._during))
        latest = [raw for _, raw in lately][::-1]
        return now_s - self._runs_s > STANDING_S and len(latest) >= REST_READINGS and stands(latest, self._unit)

    def _end(self) -> AxisMoved:
        directions, failed = self._directions, self._failed
        during = [raw for _, raw in self._during]
        before = list(self._rest) or during[:1]
        self._directions, self._during, self._failed = set(), [], False
        self._rest.clear()
        self._rest.extend(during[-REST_READINGS:])
        whole = len(directions) == 1 and not failed and len(during) >= REST_READINGS
        return AxisMoved(next(iter(directions)), movement(before, during, self._unit) if whole else None)
