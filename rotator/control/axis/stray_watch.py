"""Whether a positioned axis follows: it stands where it was sent, or it comes nearer.

Knows where the drive was sent and where the axis is. A modelled angle always agrees with its model. What was seen lasts
while the drive holds in between. Knows no goal and no sky.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

from hw.ports import Axis
from rotator.control.axis.readings import LOOK_S
from rotator.control.axis.vain_runs import LeftBehind, VainMoves
from rotator.control.commands import Steer
from rotator.exchange.faults import Fault, FaultKind

STRAY_DEG, STRAY_S = 5.0, 1.7
"""An axis does not follow if it is this far from where it was sent, and does not come nearer for this long."""
SERVO_STRAY_DEG = 1.5
"""A motor that holds its angle with an encoder of its own rests nearer than this, also with a loaded antenna."""
SHOWN_S = 0.35
"""A motor follows its drive so much later, and the mean of the readings shows it."""
ARRIVED_S = 0.5
"""An axis that stays near its target for this long is not left behind."""
MEAN_READINGS = 5
"""The axis is at the mean of this many readings: one alone scatters by more than a slow motor turns."""
COMING_DEG, COMING_NOISES = 0.5, 2.7
"""An axis comes nearer when it moved towards its place by more than this angle, and this many times the noise."""
MOVES_DEG = 0.2
"""An axis that is still gathering speed has moved by more than this."""
SLOW_SHARE = 0.25
"""A motor at this share of its speed still comes nearer in time; a target faster than that leaves it behind soon."""


class StrayWatch:
    """`speed_dps`: of the motor; `accel_dps2`: how hard it brakes, None: it stops at once. `rest_s`: so long its drive
    lets it rest before it turns the other way; only a move that takes over from another one may need that.

    `near_deg`: it may rest this far from its place. `stray_deg`: further from it, it strays.
    """

    def __init__(
        self,
        axis: Axis,
        speed_dps: float,
        accel_dps2: float | None,
        *,
        rest_s: float = 0.0,
        near_deg: float,
        stray_deg: float,
    ) -> None:
        self._axis = axis
        self._stray_deg = stray_deg
        self._speed_dps = speed_dps
        self._stray_s = max(STRAY_S, _turned_back_s(speed_dps, accel_dps2) if accel_dps2 else 0.0)
        self._rest_s, self._rests_until_s = rest_s, 0.0
        self._apart_deg = max(stray_deg, 2.0 * near_deg)
        """A target that has moved this far has left the dead band, from any place of the axis in it."""
        self._latest_deg: deque[float] = deque(maxlen=MEAN_READINGS)
        self._sent_for_s = 0.0
        """For how long, in all, it was sent somewhere."""
        self._sent_s: float | None = None
        """The moment of the last look at the axis while it was sent somewhere."""
        self._sent_deg = 0.0
        """Where the axis was sent at that look."""
        self._place_deg: float | None = None
        """Where the axis was at that look."""
        self._nearer_deg = 0.0
        """How far, in all, it has come nearer to where it was sent."""
        self._elsewhere_s = 0.0
        """For how long, in all, it was sent somewhere else than where it was."""
        self._kept: deque[tuple[float, float, float]] = deque()
        """Moments, how far it had come nearer by then, and where it was. If the target returns to a standing axis, the
        motor is not proved: the old evidence stays."""
        self._vain = VainMoves()
        self._left = LeftBehind()
        self._away_s = 0.0
        """When the axis was last on the way to its place, on the same clock."""

    @property
    def tries(self) -> int:
        """How often it was sent elsewhere in vain before the present move."""
        return self._vain.count

    @property
    def in_vain(self) -> bool:
        """Whether its latest moves have not been seen to bring it nearer."""
        return self._vain.any

    def struck(self) -> None:
        """A fault has stopped the axis: its tries are counted."""
        self._vain.struck()

    def clear(self) -> None:
        """The fault is acknowledged."""
        self._kept.clear()
        self._sent_s = None

    def see(
        self, now_s: float, steered: Steer | None, angle_deg: float | None, noise_deg: float = 0.0, *, settling: bool
    ) -> Fault | None:
        """Returns the fault of an axis that does not follow. `noise_deg`: the scatter of the readings. `settling`: the
        axis does not follow yet, for a reason that passes by itself.
        """
        if angle_deg is not None:
            self._latest_deg.append(angle_deg)
        if steered is None or angle_deg is None:
            self._vain.hold()
            self._sent_s = self._place_deg = None
            return None
        begins = self._sent_s is None
        past_s = 0.0 if self._sent_s is None else min(now_s - self._sent_s, LOOK_S)
        self._sent_for_s += past_s
        self._sent_s = now_s
        elsewhere = not begins and abs(steered.angle_deg - self._sent_deg) > STRAY_DEG
        self._sent_deg = steered.angle_deg
        coming_deg = max(COMING_DEG, COMING_NOISES * noise_deg)
        if elsewhere:
            self._vain.hold()  # another move begins
            if _moved_deg(self._kept) >= max(MOVES_DEG, COMING_NOISES * noise_deg):
                # It moves, and may have to turn back.
                self._kept.clear()
                self._rests_until_s = self._sent_for_s + self._rest_s
        settling = settling or self._sent_for_s < self._rests_until_s
        ahead_deg = steered.angle_deg - angle_deg
        near = abs(ahead_deg) < self._stray_deg
        runs_on = abs(steered.rate_dps) > SLOW_SHARE * self._speed_dps
        arrived = (near and not runs_on) or settling
        if settling:
            self._kept.clear()
        place_deg = sum(self._latest_deg) / len(self._latest_deg)
        towards = steered.rate_dps if near and runs_on else ahead_deg
        if self._place_deg is not None:
            self._nearer_deg += (place_deg - self._place_deg) * math.copysign(1.0, towards)
        self._place_deg = place_deg
        self._keep(past_s, place_deg, arrived=arrived)
        self._vain.see(
            self._sent_for_s, self._nearer_deg, coming_deg, begins=(begins or elsewhere) and not near and not settling
        )
        self._away_s = self._away_s if arrived else self._sent_for_s
        if begins or settling or self._sent_for_s - self._away_s > ARRIVED_S:
            self._left.begin()
        patience_s = max(self._stray_s, coming_deg / (SLOW_SHARE * self._speed_dps))
        since_s = self._elsewhere_s - patience_s
        while len(self._kept) > 1 and self._kept[1][0] <= since_s:
            self._kept.popleft()
        left_s = self._left.seconds(
            self._sent_for_s, steered.angle_deg, place_deg, moved_deg=coming_deg, apart_deg=self._apart_deg
        )
        if left_s >= patience_s:
            measured = f"it stays at {angle_deg:.1f}°, and its target has moved by more than {self._apart_deg:.1f}°"
            return Fault(FaultKind.NOT_FOLLOWING, self._axis, measured, f"{coming_deg:.1f}° in {patience_s:.2g} s")
        comes = _rise_deg(self._kept) >= coming_deg
        if near or settling or comes or self._kept[0][0] > since_s:
            return None
        measured = f"it is at {angle_deg:.1f}°, {abs(ahead_deg):.1f}° from where it should be"
        return Fault(FaultKind.NOT_FOLLOWING, self._axis, measured, f"{self._stray_deg:g}° for {patience_s:.2g} s")

    def _keep(self, past_s: float, place_deg: float, *, arrived: bool) -> None:
        if arrived and self._kept:
            since_s, nearer_deg, _ = self._kept.pop()
            self._kept.append((since_s, max(nearer_deg, self._nearer_deg), place_deg))
        elif not arrived:
            self._elsewhere_s += past_s
            self._kept.append((self._elsewhere_s, self._nearer_deg, place_deg))


def _turned_back_s(speed_dps: float, accel_dps2: float) -> float:
    """After this an axis that has to turn back is seen to come nearer: it brakes from full speed, and starts again."""
    return speed_dps / accel_dps2 + math.sqrt(2.0 * COMING_DEG / accel_dps2) + SHOWN_S


def _moved_deg(kept: Iterable[tuple[float, float, float]]) -> float:
    """How far it has moved in that time, either way."""
    places_deg = [place_deg for _, _, place_deg in kept]
    return max(places_deg, default=0.0) - min(places_deg, default=0.0)


def _rise_deg(kept: Iterable[tuple[float, float, float]]) -> float:
    """The most by which it has come nearer in that time. An axis that has to turn back first came nearer before that,
    to where it was sent then."""
    least_deg, rise_deg = math.inf, 0.0
    for _, nearer_deg, _ in kept:
        least_deg = min(least_deg, nearer_deg)
        rise_deg = max(rise_deg, nearer_deg - least_deg)
    return rise_deg
