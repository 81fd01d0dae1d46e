"""A model of the rotor that a control box turns: its angle, the bounds of that angle, the lead at rest, and whether
the box obeys.

Knows the box's speed and that it stands still within its dead band. Does not know the chip, nor a bus. All angles are
degrees on the rotor's own scale; a direction is -1 or 1.
"""

from __future__ import annotations

from dataclasses import dataclass, field

SLOW, FAST = 0.75, 1.25
"""A motor may be slower or faster than the configured speed by this factor."""
TIGHT_DEG = 0.1
"""Degrees: bounds this close count as one angle."""
RESTS_S = 1.0
RESTS_DEG = 0.5
"""A rotor rests when it has turned by less than these degrees for these seconds."""
MOVED_DEG = 3.0
"""Degrees: only a rest after a turn this long shows the dead band, because the rotor came to it from one side."""
LEARNING = 0.5
"""The weight of a new rest against the lead learnt before."""


class BoxModel:
    """The rotor is assumed at `angle_deg`. Until a full travel is over it may be anywhere from `low` to `high`."""

    def __init__(
        self, angle_deg: float, low_deg: float, high_deg: float, speed_dps: float, dead_band_deg: float
    ) -> None:
        self.angle_deg = angle_deg
        self.known = False
        """Whether the bounds have met within the dead band, or the rotor was measured."""
        self._bounds_deg: tuple[float, float] | None = (low_deg, high_deg)
        """None: the model is exact."""
        self._speed_dps = speed_dps
        self._dead_band_deg = dead_band_deg
        self._turns = False

    def found(self, angle_deg: float) -> None:
        """The rotor was measured there."""
        self.angle_deg, self.known, self._bounds_deg = angle_deg, True, None

    def advance(self, wiper_deg: float, down_deg: float, up_deg: float, past_s: float) -> None:
        """Turn towards the wiper for `past_s` seconds; rest `up_deg` below it, or `down_deg` above it.

        The motor starts only where the error is beyond the dead band. It rests within it, because it coasts.
        """

        def turned(angle_deg: float, up_pace: float, down_pace: float) -> float:
            most_deg = self._speed_dps * past_s
            if angle_deg < wiper_deg - up_deg:
                return min(wiper_deg - up_deg, angle_deg + most_deg * up_pace)
            if angle_deg > wiper_deg + down_deg:
                return max(wiper_deg + down_deg, angle_deg - most_deg * down_pace)
            return angle_deg

        if past_s <= 0:
            return
        if self._turns or abs(wiper_deg - self.angle_deg) > self._dead_band_deg:
            before_deg, self.angle_deg = self.angle_deg, turned(self.angle_deg, 1.0, 1.0)
            self._turns = self.angle_deg != before_deg
        if self._bounds_deg is None:
            return
        low_deg = turned(self._bounds_deg[0], SLOW, FAST)
        high_deg = turned(self._bounds_deg[1], FAST, SLOW)
        self.known = self.known or high_deg - low_deg <= up_deg + down_deg + TIGHT_DEG
        self._bounds_deg = (low_deg, high_deg)
        if high_deg - low_deg <= TIGHT_DEG:
            self.angle_deg, self._bounds_deg = (low_deg + high_deg) / 2, None

    def way(self, target_deg: float, before: int, turn_back_deg: float) -> int:
        """The direction of the move to the target. `before`: that of the last move, kept for small corrections.

        If the model has arrived but the rotor may not have, the side on which the rotor may still be decides.
        """
        ahead_deg = target_deg - self.angle_deg
        if abs(ahead_deg) > turn_back_deg or (before == 0 and abs(ahead_deg) > turn_back_deg / 2):
            return 1 if ahead_deg > 0 else -1
        if self._bounds_deg is None:
            return before
        below = self._bounds_deg[0] < target_deg - turn_back_deg
        above = self._bounds_deg[1] > target_deg + turn_back_deg
        if below and above:
            return before or 1
        return 1 if below else -1 if above else before


class Obedience:
    """Whether a box turns towards its step: judged by the measured angle while the box has its supply."""

    def __init__(self) -> None:
        self._nearest_deg: float | None = None
        """The measured angle when the rotor last came nearer to its step."""

    def forget(self) -> None:
        self._nearest_deg = None

    def astray_deg(self, angle_deg: float, wiper_deg: float) -> float:
        """How far it has turned away from its step, or past it. `angle_deg`: measured now."""
        before_deg = angle_deg if self._nearest_deg is None else self._nearest_deg
        nearer = (wiper_deg - angle_deg) * (angle_deg - before_deg) > 0
        self._nearest_deg = angle_deg if nearer else before_deg
        return abs(angle_deg - self._nearest_deg)


@dataclass(slots=True)
class RestLead:
    """How far before the wiper the rotor rests, for each direction: as configured, until a pot measures it.

    It stays between 0 and twice the configured dead band, because a stalled motor rests too.
    """

    dead_band_deg: float
    coast_deg: float
    """The coast: how far the motor turns on after the box has switched it off."""
    _learnt: dict[int, float] = field(default_factory=dict)
    _aim: tuple[float, int] | None = None
    """The wiper's angle and the direction of the move."""
    _came_from_deg: float | None = None
    """The measured angle at which the present move began."""
    _last: tuple[float, float] | None = None
    """The angle measured last, and since when it has been the same."""

    def deg(self, way: int) -> float:
        return self._learnt.get(way, max(0.0, self.dead_band_deg - self.coast_deg))

    def ordered(self, wiper_deg: float, way: int, now_s: float) -> None:
        """The wiper was set to this angle, for a move in this direction."""
        if self._aim != (wiper_deg, way):
            if self._aim is None or self._aim[1] != way:
                self._came_from_deg = None
            self._aim = (wiper_deg, way)
            self._last = None if self._last is None else (self._last[0], now_s)

    def forget(self) -> None:
        """The wiper was set to the rotor's own angle. So the next rest shows no dead band."""
        self._aim = self._came_from_deg = None

    def seen(self, angle_deg: float, now_s: float) -> None:
        """The rotor was measured there."""
        if self._last is None or abs(angle_deg - self._last[0]) > RESTS_DEG:
            self._last = (angle_deg, now_s)
        if self._aim is None or self._aim[1] == 0:
            return
        wiper_deg, way = self._aim
        if self._came_from_deg is None:
            self._came_from_deg = angle_deg
        if now_s - self._last[1] < RESTS_S or (angle_deg - self._came_from_deg) * way < MOVED_DEG:
            return
        short_deg = (wiper_deg - angle_deg) * way
        if -self.coast_deg - TIGHT_DEG <= short_deg <= 2 * self.dead_band_deg:
            before_deg = self.deg(way)
            self._learnt[way] = max(0.0, before_deg + LEARNING * (short_deg - before_deg))
        self._came_from_deg = angle_deg
