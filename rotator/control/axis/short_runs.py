"""Whether an axis turns at all when it is driven, from one short run to the next.

Knows the readings, and how long the relays were on. A run that is too short to be judged by itself counts together with
those before it, until the axis is seen to move. Decides nothing: it returns a fault, and the axis stops.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.control.axis.relay_faults import WAYS
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.smoothing import SETTLES_S, Smoothed
from rotator.exchange.faults import Fault, FaultKind

MOVED_DEG, MOVED_NOISES = 0.3, 2.5
"""An axis has moved when it is further from where it stood than this angle, and than this many times the noise."""
STOOD_RUNS = 3
"""A fault after this many runs that did not move the axis, each long enough for a slow motor."""
SLOW_SHARE, SHOWN_SHARE = 0.2, 0.4
"""A motor at the first share of its speed is slow: a run is judged by it. At the second share all runs together are."""
STOOD_S, UNKNOWN_STOOD_S = 1.5, 2.5
"""Or after runs of this time in all. More until the axis has moved once: its motor may be slower than the file says."""
STANDING_FAULTS = frozenset({FaultKind.STANDS_STILL, FaultKind.END_STOP})
"""The faults of a motor that does not turn."""
UNKNOWN_RUN_S = 0.5
"""A shorter run says nothing of a motor that has not turned yet."""
LEAST_RUN_S = 0.15
"""A shorter run may be over before a motor turns."""
STOOD_STARTS = 10
"""But this many runs of any length move even an antenna that only creeps to its target, if most of them led one way. To
and fro about its target an antenna turns by less than its readings scatter."""

REACHED_S = 0.3
"""So long after its relay opened the readings show how far a run has led. Later the wind may have turned it back."""


@dataclass(frozen=True, slots=True)
class _Ended:
    """A run that is over."""

    direction: Direction
    lasted_s: float
    off_s: float
    """When the run's relay opened."""


class ShortRuns:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time."""

    def __init__(self, axis: Axis) -> None:
        self._axis = axis
        self._smoothed = Smoothed()
        self._stands_deg: float | None = None
        """Where the axis was when it was last seen to move."""
        self._run: RelayState | None = None
        """The present run; None: no run counts now."""
        self._ended: _Ended | None = None
        """The last run, until its end is seen."""
        self._way = Direction.PLUS
        """The direction of the last run that was counted."""
        self._counted = False
        """That run has not been judged yet."""
        self._speed_dps = math.inf
        """The speed of the motor in that run."""
        self._moved_deg = MOVED_DEG
        self._from_deg: float | None = None
        """Where the present or last run began."""
        self._telling_s = math.inf
        """How long a run must be to move even a slow axis."""
        self._moved = False
        """The axis has moved since the present or last run began."""
        self._known = False
        """The axis has been seen to move in a run."""
        self._runs = 0
        self._stood_s = 0.0
        self._starts = 0
        self._driven_s = 0.0
        """Starts since the axis was last seen to move, and the time of their runs, plus one way and minus the other."""
        self._reached_deg: float | None = None
        """Where the last run has led; None: the readings cannot show it yet."""
        self._gained_deg = 0.0
        """How far those runs have led in all, each in its own direction. The wind may have turned the axis back."""
        self._backwards = 0
        self.tries = 0
        """Runs without motion since the last fault."""

    @property
    def in_vain(self) -> bool:
        """Whether the present run, or one before it, has not been seen to move the axis."""
        return self.tries > 0 or (not self._moved and (self._run is not None or self._ended is not None))

    def settles(self, now_s: float) -> bool:
        """Whether the last run is just over and has not been seen to move the axis: the readings may show it yet."""
        if self._ended is None or self._moved or self._smoothed.mean_deg is None:
            return False
        return now_s - self._ended.off_s < SETTLES_S

    def forget(self) -> None:
        """The fault is acknowledged, or the readings mean other places."""
        self._smoothed.forget()
        self._stands_deg = self._run = self._ended = self._from_deg = None
        self._runs = self._starts = self._backwards = self.tries = 0
        self._stood_s = self._driven_s = self._gained_deg = 0.0

    def struck(self, kind: FaultKind) -> None:
        """A fault has stopped the axis. If it stood still, one more run without motion is enough for the next fault."""
        self._run, self._ended, self._counted, self.tries = None, None, False, 0
        self._starts, self._driven_s, self._gained_deg = 0, 0.0, 0.0
        if kind in STANDING_FAULTS:
            self._runs, self._stood_s = STOOD_RUNS - 1, 0.0

    def note_relays(self, relays: RelayState, speed_dps: float) -> None:
        """The relays have changed. `speed_dps`: of the motor that runs now."""
        if self._run is not None:
            self._ended = _Ended(self._run.direction, relays.since_s - self._run.since_s, relays.since_s)
            self._run, self._reached_deg = None, None
        if relays.closed:
            self._count()
            if self._moved:
                self._stands_deg = self._smoothed.mean_deg
            self._run, self._from_deg, self._moved = relays, self._smoothed.mean_deg, False
            self._speed_dps = speed_dps

    def see(self, at_s: float, angle_deg: float, noise_deg: float) -> Fault | None:
        """A good reading. Returns the fault that it shows, if any."""
        self._smoothed.see(angle_deg)
        smoothed_deg = self._smoothed.mean_deg
        if smoothed_deg is None:
            return None
        moved_deg = max(MOVED_DEG, MOVED_NOISES * noise_deg)
        if self._run is not None:
            telling_s = moved_deg / (SLOW_SHARE * self._speed_dps)
            self._telling_s = telling_s if self._known else max(telling_s, UNKNOWN_RUN_S)
        if self._stands_deg is None or abs(smoothed_deg - self._stands_deg) >= moved_deg:
            self._known = self._known or (self._stands_deg is not None and self._run is not None)
            self._stands_deg, self._runs, self._stood_s, self._moved = smoothed_deg, 0, 0.0, True
            self._starts, self._driven_s, self._gained_deg = 0, 0.0, 0.0
            self.tries = 0
        self._moved_deg = moved_deg
        if self._ended is not None and self._reached_deg is None and at_s - self._ended.off_s >= REACHED_S:
            self._reached_deg = smoothed_deg
        if self._ended is not None and at_s - self._ended.off_s >= SETTLES_S:
            self._count()
        if not self._counted:
            return None
        self._counted = False
        return self._judge(smoothed_deg)

    def _judge(self, smoothed_deg: float) -> Fault | None:
        name, moved_deg = WAYS[self._axis, self._way], self._moved_deg
        if self._backwards >= STOOD_RUNS:
            measured = f"its motor ran {name} {self._backwards} times, and the angle went back each time"
            return Fault(FaultKind.WRONG_WAY, self._axis, measured, f"{moved_deg:.1f}°")
        if self._gained_deg >= moved_deg * math.sqrt(max(1, self._starts)):
            # The axis turns each time, and is turned back. The scatter of a sum grows as the root of its number.
            self._runs = self._starts = self.tries = 0
            self._stood_s = self._driven_s = self._gained_deg = 0.0
            return None
        # A slow motor among noisy readings needs longer to show that it moves.
        enough_s = max(STOOD_S if self._known else UNKNOWN_STOOD_S, moved_deg / (SHOWN_SHARE * self._speed_dps))
        one_way_s = abs(self._driven_s)
        creeps = self._starts >= STOOD_STARTS and one_way_s * SHOWN_SHARE * self._speed_dps >= moved_deg
        if self._stood_s < enough_s and self._runs < STOOD_RUNS and not creeps:
            return None
        runs = f"short runs {name}, {max(self._stood_s, one_way_s):.1f} s in all"
        measured = f"its motor made {runs}, but the angle stays at {smoothed_deg:.1f}°"
        return Fault(FaultKind.STANDS_STILL, self._axis, measured, f"at least {moved_deg:.1f}° in {enough_s:g} s")

    def _count(self) -> None:
        """The last run is over: has it moved the axis?"""
        if self._ended is None:
            return
        way, run_s = self._ended.direction, self._ended.lasted_s
        self._ended, self._counted, self._way = None, True, way
        if self._from_deg is not None and self._smoothed.mean_deg is not None:
            gone_deg = (self._smoothed.mean_deg - self._from_deg) * way
            self._backwards = self._backwards + 1 if gone_deg <= -self._moved_deg else 0
        if self._moved:
            return
        self._starts, self._driven_s = self._starts + 1, self._driven_s + run_s * way
        if self._from_deg is not None and self._smoothed.mean_deg is not None:
            reached_deg = self._smoothed.mean_deg if self._reached_deg is None else self._reached_deg
            self._gained_deg += (reached_deg - self._from_deg) * way
        if run_s >= LEAST_RUN_S:
            self._runs += run_s >= self._telling_s
            self._stood_s += run_s
            self.tries += 1
