"""The watch over an axis whose angle is measured: it runs when driven, the right way, and stands when not.

From how the axis moves (`estimator`) to faults. `opening_watch` says how far each relay is trusted to be open. Knows
what the relays do, the motor as learnt, and the limits. Decides nothing: it returns a fault, and the axis stops.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.estimator import BACK_SHARE, FAST_SHARE, SLOW_SHARE, Ahead, Estimator
from rotator.control.axis.opening_watch import OpeningWatch
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.axis.relay_faults import CUT_BY_HAND, WAYS, accusation, unstoppable
from rotator.control.axis.relay_state import BOTH_WAYS, RelayState, RelayTrusts
from rotator.control.axis.run_watch import endless
from rotator.control.axis.vain_runs import VainRuns
from rotator.control.sky.mount import Range
from rotator.exchange.faults import NOTICED_FOR_S, Fault, FaultKind, Notice
from rotator.exchange.motor import Motor, Trust, Trusts

BACK_DEG = 0.3
"""So far the wrong way is no play of the gear."""
NEAR_END_DEG = 5.0
"""Standing this near to a limit while driven towards it is an end stop."""
TURNS_S, WELDED_SHARE, TURNING_SHARE = 1.0, 0.7, 0.5
"""An axis turns by itself when it has kept ahead for this time; at a slow pace, until its pursuer has run as far as
noise may move it. If it never came to rest after its own run, this share of that is enough."""
CUT_IN_S = 3.0
"""If it still turns this long after its supply was cut, this box cannot stop it."""
TURNS = Notice("turning with no relay on: wind, or a hand at the control box's switch", "TURNS BY SELF")


class MotionWatch:
    """The `RelayWatch` of an axis whose angle is measured.

    `placed`: the angles are calibrated, and the limits known. Without that only the relays are watched. `look`: nothing
    has been seen of the axis in this run of the program. `behind_s`: how old what a reading shows may be.
    """

    def __init__(
        self,
        axis: Axis,
        limits: Range,
        motors: Mapping[Direction, Motor],
        behind_s: float = 0.0,
        *,
        master: bool,
        trusts: Trusts,
        placed: bool,
        look: bool,
    ) -> None:
        self._axis = axis
        self._limits = limits
        self._behind_s = behind_s
        self._master = master
        self._trusts = RelayTrusts(trusts)
        self._begin(motors, placed=placed, look=look)

    def _begin(self, motors: Mapping[Direction, Motor], *, placed: bool, look: bool) -> None:
        self._placed = placed
        self._seen = Estimator(motors, self._behind_s)
        limits = self._limits if placed else None
        self._opening = OpeningWatch(self._seen, self._trusts, limits, self._behind_s, look=look)
        self.runs = VainRuns(self._seen)
        self._cut_s = math.inf
        """Since when the supply is to be cut."""
        self._noticed_s: float | None = None

    @property
    def trusts(self) -> Trusts:
        """What is known of the two relays."""
        return self._trusts.both

    @property
    def noise_deg(self) -> float:
        """Scatter of the readings, rms, as seen up to now."""
        return self._seen.trend.noise_deg

    @property
    def looks(self) -> bool:
        """Nothing has been seen of the axis yet."""
        return self._opening.looks

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the readings will not show that any more."""
        return self._opening.unsure

    @property
    def notices(self) -> tuple[Notice, ...]:
        if self._noticed_s is None or self._seen.trend.last_s > self._noticed_s + NOTICED_FOR_S:
            return ()
        if self._master and self._noticed_s - self._cut_s > CUT_IN_S:
            return (Notice(f"still turning, though the motors' supply should be off: {CUT_BY_HAND}", "STILL TURNS"),)
        return (TURNS,)

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        self._opening.note_relays(relays, self._seen.relays)
        self.runs.note_relays(relays, self._seen.relays)
        self._seen.note_relays(relays)
        self._cut_s = math.inf if relays.closed else self._cut_s

    def see(self, at_s: float, angle_deg: float, condition: Condition = NORMAL) -> Fault | None:
        """A good reading. Returns the fault that it shows, if any."""
        gone_deg = self._seen.see(at_s, angle_deg, supplied=condition.supplied)
        if gone_deg is None:
            return None
        self.runs.see()
        if self._seen.relays.closed:
            assert self._seen.place_deg is not None
            self._opening.obstacles.turned_to(self._seen.place_deg)
            return self._misbehaves(at_s, angle_deg) if self._placed else None
        self._opening.see(at_s, gone_deg, supplied=condition.supplied)
        return self._turning(at_s) or self._run_on() or self._ran_in_vain(at_s, angle_deg)

    # --- a relay is closed

    def _misbehaves(self, at_s: float, angle_deg: float) -> Fault | None:
        seen, way = self._seen, self._seen.relays.direction
        if seen.back_deg >= max(seen.sure_deg, BACK_DEG):
            ways = WAYS[self._axis, way], WAYS[self._axis, Direction(-way)]
            measured = f"its motor runs {ways[0]}, the angle goes {ways[1]} at {abs(self._dps(at_s)):.1f}°/s"
            return Fault(FaultKind.WRONG_WAY, self._axis, measured, f"{BACK_SHARE * seen.reference_dps:.2g}°/s")
        if self.runs.stands:
            return self._stands_still(at_s, way, angle_deg)
        return endless(self._axis, way, at_s - seen.relays.begun_s, self._limits, seen.reference_dps)

    def _ran_in_vain(self, at_s: float, angle_deg: float) -> Fault | None:
        """Runs that are over, as far as they led, have not turned the axis."""
        relays, runs = self._seen.relays, self.runs
        if not (self._placed and relays.last and runs.tries and runs.stands) or runs.settles(at_s):
            return None
        return self._stands_still(at_s, relays.last, angle_deg)

    def _dps(self, at_s: float) -> float:
        slope = self._seen.trend.slope(at_s - TURNS_S)
        return slope.speed_dps if slope else 0.0

    def _stands_still(self, at_s: float, way: Direction, angle_deg: float) -> Fault:
        name = WAYS[self._axis, way]
        end_deg = self._limits.max_deg if way > 0 else self._limits.min_deg
        if (end_deg - angle_deg) * way <= NEAR_END_DEG:
            measured = f"its motor runs {name}, but it stands at {angle_deg:.1f}°"
            return Fault(FaultKind.END_STOP, self._axis, measured, f"{end_deg:g}°, which must lie before the stop")
        measured = f"its motor runs {name}, but the angle stays at {angle_deg:.1f}° ({self._dps(at_s) + 0.0:.2f}°/s)"
        limit = f"at least {self._seen.stands_dps:.2g}°/s after 2 s"
        return Fault(FaultKind.STANDS_STILL, self._axis, measured, limit)

    # --- no relay is closed

    def _turning(self, at_s: float) -> Fault | None:
        """The axis turns, and no relay is on."""
        seen = self._seen
        # A motor that was only tapped, or not driven yet, may be far slower than the configuration says.
        knows = seen.measured_dps is not None or (self._opening.rested and not self.looks)
        for way in BOTH_WAYS:
            goes_on = not self._opening.rested and way is seen.relays.last
            far_deg = seen.sure_deg * (WELDED_SHARE if goes_on else 1.0)
            fast = self._lasts(seen.fast[way], FAST_SHARE, far_deg)
            slow = self._lasts(seen.slow[way], SLOW_SHARE, far_deg)
            if fast or slow:
                self._noticed_s = at_s
            if fast or (slow and not knows):
                return self._suspected(at_s, way, (TURNING_SHARE if knows else SLOW_SHARE) * seen.motor_dps)
        return None

    def _lasts(self, ahead: Ahead, share: float, far_deg: float) -> bool:
        """Whether the axis has kept ahead of this share of its motor's speed for long enough to be sure of it."""
        seen = self._seen
        return seen.place_s - ahead.since_s >= max(TURNS_S, far_deg / (share * seen.motor_dps))

    def _suspected(self, at_s: float, way: Direction, limit_dps: float) -> Fault:
        self._opening.found_closed(way)
        self._cut_s = min(self._cut_s, at_s)
        welded = not self._opening.rested and way is self._seen.relays.last
        after = " after its relay was switched off" if welded else ""
        measured = f"it turns {WAYS[self._axis, way]} at {abs(self._dps(at_s)):.1f}°/s{after}"
        kind = FaultKind.RELAY_WELDED if welded else FaultKind.TURNS_BY_ITSELF
        return self._closed(kind, measured, f"{limit_dps:.2g}°/s for {TURNS_S:g} s")

    def _run_on(self) -> Fault | None:
        """The axis ran on, and stands now: at a stop, where the motor may still have current."""
        way = self._seen.relays.last
        if not self._opening.ran_on or way is Direction.OFF or self._trusts.of(way) is not Trust.DOUBTED:
            return None
        self._opening.found_closed(way)
        name = WAYS[self._axis, way]
        measured = f"it went on {name} after its relay was switched off, and{self._place or ' stands'}"
        return self._closed(FaultKind.RELAY_WELDED, measured, f"{TURNING_SHARE:g} of its speed")

    def _closed(self, kind: FaultKind, measured: str, limit: str) -> Fault:
        return unstoppable(Fault(kind, self._axis, measured, limit), master=self._master)

    @property
    def _place(self) -> str:
        """Where the axis stands, for a person."""
        place_deg = self._seen.place_deg
        return f" stands at {place_deg:.1f}°" if place_deg is not None and self._placed else ""

    # --- what is asked and told

    def homes(self, *, homing: bool, failed: bool) -> None:
        """An axis that measures has no end stop to find."""

    def rescale(self, motors: Mapping[Direction, Motor], *, placed: bool) -> None:
        """The readings mean other places from now on: what they have shown is forgotten."""
        relays = self._seen.relays
        self._begin(motors, placed=placed, look=self.looks)
        self.note_relays(relays)

    def forbids(self, direction: Direction) -> bool:
        """Whether this relay must not close yet, because its opposite may still be closed."""
        return self._seen.relays.direction is not direction and self._opening.waits(direction)

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction, as long as the opposite relay is suspected."""
        against = Direction(-direction)
        return accusation(self._axis, against, self._trusts.of(against), self._place, master=self._master)

    def acknowledge(self) -> None:
        """The fault is acknowledged: the supply comes back with the next order."""
        self._cut_s = math.inf

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._opening.checked()
