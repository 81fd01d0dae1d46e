"""The law for a motor that is only on or off: when to start it, when to stop it.

Bang-bang with a tolerance: at rest until the error exceeds it, then on until the motor, switched off, would coast onto
the target. Knows one axis's angle and target. Knows nothing of the sky, of limits, of faults or of relays.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from hw.ports import Direction

SPEED_WINDOW_S = 0.3
"""Speed is the change of angle over this long: shorter is noise, longer is late."""


@dataclass(frozen=True, slots=True)
class Run:
    """Drive that way until that moment at the latest."""

    direction: Direction
    until_s: float


class SwitchedLaw:
    """One axis.

    `coast_s`: how long the motor goes on, as time at the speed it had when it was switched off. `period_s`: how soon
    the law will be asked again; a stop nearer than that is left to the lease's end.
    """

    def __init__(self, *, coast_s: float, lease_s: float, period_s: float) -> None:
        self._coast_s = coast_s
        self._lease_s = lease_s
        self._period_s = period_s
        self._running = Direction.OFF
        self._stop_s: float | None = None
        self._stop_for_deg = 0.0
        self._seen: deque[tuple[float, float]] = deque()

    def see(self, at_s: float, angle_deg: float) -> None:
        """A new reading of the axis."""
        self._seen.append((at_s, angle_deg))
        while self._seen[0][0] < at_s - SPEED_WINDOW_S:
            self._seen.popleft()

    def blind(self) -> None:
        """Readings are not to be believed: what was seen says nothing of the speed any more."""
        self._seen.clear()

    def rest(self, now_s: float) -> Run:
        self._running = Direction.OFF
        self._stop_s = None
        return Run(Direction.OFF, now_s)

    def approach(self, now_s: float, angle_deg: float, target_deg: float, tolerance_deg: float) -> Run:
        """What to do about the error between `angle_deg` and `target_deg`."""
        if self._stop_s is not None and self._stop_for_deg == target_deg:
            if now_s < self._stop_s:
                return Run(self._running, self._stop_s)
            self._running = Direction.OFF
        self._stop_s = None
        speed_dps = self._speed_dps()
        # Where the axis would come to rest if it were switched off now: coasting is no reason to start again.
        error_deg = target_deg - (angle_deg + speed_dps * self._coast_s)
        if self._running is Direction.OFF:
            if abs(error_deg) <= tolerance_deg:
                return self.rest(now_s)
            self._running = Direction.PLUS if error_deg > 0 else Direction.MINUS
        left_deg = error_deg * self._running
        if left_deg <= 0:
            return self.rest(now_s)
        until_s = now_s + self._lease_s
        towards_dps = speed_dps * self._running
        if towards_dps > 0 and left_deg < towards_dps * self._period_s:
            self._stop_s = until_s = now_s + left_deg / towards_dps
            self._stop_for_deg = target_deg
        return Run(self._running, until_s)

    def _speed_dps(self) -> float:
        if len(self._seen) < 2:  # a difference takes two
            return 0.0
        (first_s, first_deg), (last_s, last_deg) = self._seen[0], self._seen[-1]
        return (last_deg - first_deg) / (last_s - first_s) if last_s > first_s else 0.0
