"""Whether an axis that is driven turns, the right way, and not for too long.

Knows the motion as observed. Decides nothing: it returns a fault, and the axis stops.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.control.axis.observed_motion import ObservedMotion, SpeedWindow
from rotator.control.axis.run_watch import endless
from rotator.control.axis.trend import Slope
from rotator.exchange.faults import Fault, FaultKind

STANDING_WINDOW = SpeedWindow(1.4, 1.5, 4.0)
STANDING_SHARE, SLOW_STANDING_SHARES = 0.25, (0.5, 0.4)
"""An axis below this share of the reference speed stands. Of a slow axis: before it has turned, and after."""
WHOLE_RUN_S, STANDS_ERRORS = 1.6, 3.0
"""After this time a run that has not moved the axis may be clear, though the noise asks for a longer look."""
WRONG_WAY_WINDOW = SpeedWindow(0.4, 0.65, 3.0)
WRONG_WAY_SHARE = 0.5
"""This share of the reference speed backwards is the wrong way."""
NEAR_END_DEG = 5.0
"""Standing this near to a limit while driven towards it is an end stop."""


class DrivenWatch:
    """Ask it (`judge`) after each good reading, while a relay of the axis is closed."""

    def __init__(self, seen: ObservedMotion) -> None:
        self._seen = seen

    def judge(self, at_s: float, angle_deg: float, *, on_line: bool) -> Fault | None:
        """The fault that the latest reading shows. `on_line`: the reading lies on the line of the others."""
        return (on_line and (self._wrong_way(at_s) or self._standing(at_s, angle_deg))) or self._endless(at_s)

    def _wrong_way(self, at_s: float) -> Fault | None:
        seen, direction = self._seen, self._seen.relays.direction
        slope = seen.speed(at_s, WRONG_WAY_WINDOW, seen.reference_dps / 5.0)
        limit_dps = WRONG_WAY_SHARE * seen.reference_dps
        if slope is None or slope.speed_dps * direction > -max(limit_dps, 3.0 * slope.error_dps):
            return None
        ways = seen.name(direction), seen.name(Direction(-direction))
        measured = f"its motor runs {ways[0]}, the angle goes {ways[1]} at {abs(slope.speed_dps):.1f}°/s"
        return Fault(FaultKind.WRONG_WAY, seen.axis, measured, f"{limit_dps:.2g}°/s")

    def _standing(self, at_s: float, angle_deg: float) -> Fault | None:
        seen, direction = self._seen, self._seen.relays.direction
        reference_dps = seen.reference_dps
        slow_dps = SLOW_STANDING_SHARES[seen.shown_dps is not None] * reference_dps
        limit_dps = max(STANDING_SHARE * reference_dps, min(STANDING_SHARE, slow_dps))
        slope = seen.speed(at_s, STANDING_WINDOW, limit_dps / 4.5) or self._clearly(at_s, limit_dps)
        if slope is None:
            return None
        speed_dps = slope.speed_dps * direction
        if speed_dps >= limit_dps:
            certain_dps = speed_dps - 2.0 * slope.error_dps
            if certain_dps > limit_dps:
                seen.show(certain_dps)
            return None
        way = seen.name(direction)
        end_deg = seen.limits.max_deg if direction > 0 else seen.limits.min_deg
        if (end_deg - angle_deg) * direction <= NEAR_END_DEG:
            measured = f"its motor runs {way}, but it stands at {angle_deg:.1f}°"
            return Fault(FaultKind.END_STOP, seen.axis, measured, f"{end_deg:g}°, which must lie before the stop")
        measured = f"its motor runs {way}, but the angle stays at {angle_deg:.1f}° ({slope.speed_dps + 0.0:.2f}°/s)"
        return Fault(FaultKind.STANDS_STILL, seen.axis, measured, f"at least {limit_dps:.2g}°/s after 2 s")

    def _clearly(self, at_s: float, limit_dps: float) -> Slope | None:
        """The speed of a run that, looked at whole, is slower than the limit for certain."""
        slope = self._seen.whole_run(at_s, WHOLE_RUN_S)
        if slope is None:
            return None
        most_dps = slope.speed_dps * self._seen.relays.direction + STANDS_ERRORS * slope.error_dps
        return slope if most_dps < limit_dps else None

    def _endless(self, at_s: float) -> Fault | None:
        seen, relays = self._seen, self._seen.relays
        return endless(seen.axis, relays.direction, at_s - relays.begun_s, seen.limits, seen.reference_dps)
