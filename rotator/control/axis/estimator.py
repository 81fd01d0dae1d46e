"""How one axis moves, by its readings: whether it keeps up with a motor that would turn it.

Each question is asked in the same way. A pursuer runs along the axis at a steady speed, and starts from the axis again
and again. An axis that stands falls behind it; one that its motor turns keeps ahead of it. How far is a distance, so it
is compared with one number: how far two places may seem apart by the noise of the readings alone (`sure_deg`). There is
no window to choose: a slow motor, or a noisy sensor, only takes longer to get as far.

Knows the readings, the relays, and the motor as learnt. Judges nothing: `motion_watch` does. Time is an argument.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.relay_state import BOTH_WAYS, RelayState
from rotator.control.axis.trend import Slope, Trend
from rotator.exchange.motor import Motor

FEW, MANY, NOISY_DEG = (5, 0.53), (11, 0.33), 0.18
"""A place is the mean of the latest few readings, or of many where they scatter by more than this, without the highest
and the lowest: a lone spark is left out. How many; and the standard error of such a mean, in noises of one reading."""
SURE_ERRORS = 4.5
"""Two places differ for certain if they are so many standard errors apart: by chance once in 150,000 pairs, which is
once a year for an antenna that turns two hours a day (docs/decisions.md)."""
RELAY_SETTLES_S, START_S, COASTS_S = 0.05, 0.15, 0.8
"""A relay, and the cycle in which it closed, take the first time at most; a motor turns after the second; what the axis
goes within the third after its relay opened belongs to its run."""
SLOWEST_DPS = 0.5
"""Until an axis has shown how fast it turns it may be as slow as this, also if the configuration says otherwise."""
SLOWEST_START_S = 0.25
"""Until a run has shown its speed, a motor may gather it as slowly as this."""
STANDS_SHARE, BACK_SHARE = 0.25, 0.5
"""An axis that is driven stands below the first share of its speed, and goes the wrong way at the second, backwards."""
SLOW_STANDING_DPS, SLOW_STANDING_SHARES = 0.25, (0.5, 0.4)
"""Of a slow axis: below this speed, or this share of it, before it has turned and after."""
POWERED_SHARE, POWERED_BELIEVED_SHARE = 0.5, 0.2
"""A powered motor turns at this share of its speed at least: of the measured speed, or of the believed one."""
SLOWED_SHARE = 0.65
"""An axis below this share of the speed at which its own run ended has lost its current."""
FAST_SHARE, SLOW_SHARE = 0.45, 0.2
"""With no relay on, an axis at the first share is turned by its motor; at the second it turns at all."""
CLOSE_S, CLOSE_ERRORS = 0.2, 2.5
"""A pursuer that is to show that a motion lasts follows so close: what it runs in this time, or what noise asks for."""
END_WINDOWS_S, SEEN_ERRORS, EXACT_ERRORS = (0.25, 0.5, 1.0, 2.0, 4.0), 3.5, 6.0
"""The end of a run is looked at for these times, one after the other, until its speed is seen; and when it is exact."""
MEASURED_AFTER_S, STEADY_S = 1.0, 1.5
"""A run as long as this shows the motor's speed. After the second time its last second shows it exactly."""


@dataclass(slots=True)
class Behind:
    """How far an axis is behind a pursuer, and for how long the pursuer has run since the axis was level with it.

    An axis that goes backwards is no further behind than one that stands.
    """

    deg: float = 0.0
    for_s: float = 0.0
    run_deg: float = 0.0
    """How far the pursuer has run in that time."""

    def note(self, dps: float, passed_s: float, gone_deg: float, sure_deg: float) -> None:
        """`sure_deg`: so far noise alone may seem to move the axis."""
        self.run_deg += dps * passed_s
        self.deg = min(max(0.0, self.deg + dps * passed_s - gone_deg), self.run_deg + sure_deg)
        if self.deg > 0.0:
            self.for_s += passed_s
        else:
            self.for_s = self.run_deg = 0.0


@dataclass(slots=True)
class Ahead:
    """How far an axis is ahead of a pursuer, and since when it has kept ahead of one that follows close behind it."""

    deg: float = 0.0
    since_s: float = math.inf
    _close_deg: float = 0.0

    def note(self, at_s: float, gained_deg: float, close_deg: float, far_deg: float) -> None:
        """`gained_deg`: since the last look. The pursuers follow at these distances at most."""
        self.deg = min(max(0.0, self.deg + gained_deg), far_deg)
        self._close_deg = min(max(0.0, self._close_deg + gained_deg), close_deg)
        self.since_s = min(self.since_s, at_s) if self._close_deg > 0.0 else math.inf


class Estimator:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time.

    `motors` is read, never changed: what is learnt meanwhile counts from the next run on. `behind_s`: a reading shows a
    place where the axis was at most so long ago.
    """

    def __init__(self, motors: Mapping[Direction, Motor], behind_s: float) -> None:
        self.motors = motors
        self.motor = motors[Direction.PLUS]
        """The motor of the present or latest run, as it was known when the run began."""
        self.relays = RelayState()
        self.trend = Trend(behind_s)
        self._behind_s = behind_s
        self._mean_of = FEW
        self._latest: deque[tuple[float, float]] = deque(maxlen=MANY[0])
        self.place_deg: float | None = None
        """Where the axis is; None: there are too few readings since the latest gap."""
        self.place_s = -math.inf
        """The middle of the readings of that place."""
        self._shown_dps: float | None = None
        """The fastest speed seen for certain; None: the axis was not seen to turn yet."""
        self._measured_dps: dict[Direction, float] = {}
        self._pace = 1.0
        self._paced_s = -math.inf
        """When it has this pace for certain."""
        # A relay is closed:
        self._from_deg: float | None = None
        """Where the present or latest run began."""
        self.turned = True
        """The present or latest run was seen to turn the axis, or a fault has ended it, or there was none."""
        self._same_way = False
        """That run goes on in the direction of the one before."""
        self.short = Behind()
        """Behind a motor so slow that it stands, in this run and those before it."""
        self.held = Behind()
        """Behind a motor with current, in this run and those before it."""
        self.back_deg = 0.0
        """How far it went backwards in this run, and those before it one way, beyond the pace of the wrong way."""
        # No relay is closed:
        self.line: Slope | None = None
        """How the axis turned when the latest run ended; None: it was not seen to turn then."""
        self.off_deg: float | None = None
        """Where the axis was when its relay opened; None: it is not known, or a gap came since."""
        self._ended_dps = 0.0
        """How fast the motor is at the pace at which the latest run ended: off, its speed input is at the lowest."""
        self._supplied_s = -math.inf
        """When the motor was last without a supply, with no relay closed."""
        self._weigh()
        self._look_anew()

    def _look_anew(self) -> None:
        """What moved the axis is over, or begins: without a relay its motion is seen from now on."""
        self._spared_s = 0.0
        """So much sooner the present run would have got as far at full speed."""
        self.lost_deg = dict.fromkeys(BOTH_WAYS, 0.0)
        """How far the axis is behind a motor with current in that direction."""
        self.fast = {way: Ahead() for way in BOTH_WAYS}
        self.slow = {way: Ahead() for way in BOTH_WAYS}

    # --- how fast, and how exact

    def _weigh(self) -> None:
        """The figures that all questions about a reading share."""
        self.error_deg = self._mean_of[1] * self.trend.noise_deg
        """The standard error of a place."""
        self.sure_deg = SURE_ERRORS * math.sqrt(2.0) * self.error_deg
        """Two places further apart than this are different places."""
        believed_dps = min(each.speed_dps for each in self.motors.values()) * self._pace
        measured_dps = min(self._measured_dps.values(), default=None)
        self.measured_dps = None if measured_dps is None else measured_dps * self._pace
        """The slower of the speeds that the latest runs have shown, at the present pace; None: no run has shown one."""
        self.motor_dps = self.measured_dps or believed_dps
        self.powered_dps = (POWERED_SHARE if self.measured_dps else POWERED_BELIEVED_SHARE) * self.motor_dps
        """The least speed of a powered motor."""

    @property
    def shown(self) -> bool:
        """Whether the axis has been seen to turn at all."""
        return self._shown_dps is not None

    @property
    def reference_dps(self) -> float:
        """The speed that is expected of the axis: that of its motor as known, but not more than it has shown."""
        return min(self.motor.speed_dps, SLOWEST_DPS if self._shown_dps is None else self._shown_dps) * self._pace

    @property
    def stands_dps(self) -> float:
        """An axis that is driven and slower than this stands."""
        share = SLOW_STANDING_SHARES[self.shown]
        return max(STANDS_SHARE * self.reference_dps, min(SLOW_STANDING_DPS, share * self.reference_dps))

    @property
    def full_dps(self) -> float:
        """The motor's full speed at the pace of the latest run, which it has not reached in a short one."""
        return max(abs(self.line.speed_dps) if self.line else 0.0, self._ended_dps)

    @property
    def gone_deg(self) -> float:
        """How far the axis has gone on since its relay opened; 0: that is not known."""
        if self.place_deg is None or self.off_deg is None:
            return 0.0
        return (self.place_deg - self.off_deg) * self.relays.last

    # --- what happens

    def note_pace(self, pace: float) -> None:
        """An output lets the motor turn at this share of its full speed from now on."""
        if pace != self._pace:
            self._pace, self._paced_s = pace, self.trend.last_s + self.motor.lag_s
            self._weigh()

    def note_relays(self, relays: RelayState) -> None:
        was, self.relays = self.relays, relays
        if was.closed:
            self._end(relays.since_s, was)
            self._weigh()
            self._ended_dps = self.motor_dps
        if relays.closed:
            self.motor = self.motors[relays.direction]
            self._from_deg, self.off_deg, self.line, self.turned = self.place_deg, None, None, False
            self._same_way = relays.direction is was.last
            self.back_deg = self.back_deg if self._same_way else 0.0
        self._look_anew()

    def released(self) -> None:
        """Nothing holds the axis: it was moved, or a person has looked."""
        self.held = Behind()
        self.lost_deg = dict.fromkeys(BOTH_WAYS, 0.0)

    def see(self, at_s: float, angle_deg: float, *, supplied: bool) -> float | None:
        """A good reading. Returns how far the place has moved since the last look; None: there is nothing new to see.

        `supplied`: a motor would have current if its relay were closed.
        """
        # Three readings that share nothing are newer than the latest change.
        steady = self.relays.since_s + 3.0 * self._behind_s <= at_s
        if not self.trend.see(at_s, angle_deg, max(each.speed_dps for each in self.motors.values()), steady=steady):
            return None
        if self.trend.since_s == at_s:
            self._latest.clear()
            self.place_deg = self.off_deg = None
            self._look_anew()
        self._latest.append((at_s, angle_deg))
        before_deg, before_s, before_of = self.place_deg, self.place_s, self._mean_of
        self.place_deg = self._place()
        self._weigh()
        if before_deg is None or before_of is not self._mean_of or len(self._latest) <= FEW[0]:
            return None  # a place of fewer readings is less exact
        gone_deg, passed_s = self.place_deg - before_deg, self.place_s - before_s
        if self.relays.closed:
            self._pursue_driven(at_s, gone_deg, passed_s)
        else:
            self._pursue_idle(at_s, gone_deg, passed_s, supplied=supplied)
        return gone_deg

    def _place(self) -> float:
        if len(self._latest) == MANY[0]:
            share = self.trend.noise_deg / NOISY_DEG
            self._mean_of = MANY if share > (1.25 if self._mean_of is FEW else 0.8) else FEW
        latest = list(self._latest)[-self._mean_of[0] :]
        self.place_s = sum(at_s for at_s, _ in latest) / len(latest)
        degrees = sorted(angle_deg for _, angle_deg in latest)
        degrees = degrees[1:-1] if len(degrees) >= FEW[0] else degrees
        return sum(degrees) / len(degrees)

    @property
    def _turns_s(self) -> float:
        """When the motor of the present or latest run was due to turn."""
        return self.relays.begun_s + RELAY_SETTLES_S + self.motor.lag_s

    def _pursue_driven(self, at_s: float, gone_deg: float, passed_s: float) -> None:
        way = self.relays.direction
        self._from_deg = self.place_deg if self._from_deg is None else self._from_deg
        self.held.note(self.powered_dps, passed_s, gone_deg * way, self.sure_deg)
        self._note_turned(way)
        self._spared_s += passed_s * (1.0 - self._pace)
        if at_s > self.relays.begun_s + START_S:
            self.short.note(self.stands_dps, passed_s, gone_deg * way, self.sure_deg)
        if self.place_s - passed_s < self._turns_s:
            return
        self.back_deg = max(0.0, self.back_deg - gone_deg * way - BACK_SHARE * self.reference_dps * passed_s)
        least_deg = self._led_deg(way) - self.sure_deg
        turned_s = max(self.place_s - self._turns_s - self._spared_s, START_S)
        if least_deg > self.stands_dps * turned_s:
            self._shown_dps = max(self._shown_dps or SLOWEST_DPS, least_deg / (turned_s + self.motor.lag_s))

    def _note_turned(self, way: Direction) -> None:
        self.turned = self.turned or self._led_deg(way) > self.sure_deg

    def _led_deg(self, way: Direction) -> float:
        """How far the present or latest run has led; 0: that is not known."""
        if self.place_deg is None or self._from_deg is None:
            return 0.0
        return (self.place_deg - self._from_deg) * way

    def _pursue_idle(self, at_s: float, gone_deg: float, passed_s: float, *, supplied: bool) -> None:
        last, from_s = self.relays.last, self.place_s - passed_s
        open_s = self.relays.since_s + RELAY_SETTLES_S + self._behind_s
        if from_s < open_s + 2.0 * self.motor.lag_s and last:
            # How far the run has led. Later the wind may have turned it back.
            self._note_turned(last)
            self.short.note(0.0, 0.0, gone_deg * last, self.sure_deg)
        if at_s < open_s + COASTS_S and last and self.line is None:
            self.held.note(0.0, 0.0, gone_deg * last, self.sure_deg)
        if not supplied:
            self._supplied_s, self.lost_deg = at_s, dict.fromkeys(BOTH_WAYS, 0.0)
        elif from_s >= max(open_s, self._turns_s + self._gathers_s, self._supplied_s + 2.0 * self.motor.lag_s):
            for way in BOTH_WAYS:
                dps = self._powered_on_dps if way is last else self.powered_dps
                self.lost_deg[way] = max(0.0, self.lost_deg[way] + dps * passed_s - gone_deg * way)
        if from_s >= open_s + 2.0 * self.motor.lag_s + 3.0 * RELAY_SETTLES_S:
            for ahead, share in ((self.fast, FAST_SHARE), (self.slow, SLOW_SHARE)):
                dps = share * self.motor_dps
                close_deg = max(CLOSE_S * dps, CLOSE_ERRORS * self.error_deg)
                for way in BOTH_WAYS:
                    ahead[way].note(self.place_s, gone_deg * way - dps * passed_s, close_deg, 1.5 * self.sure_deg)

    @property
    def _gathers_s(self) -> float:
        """Its motor gathers its speed in this time."""
        return self.motor.lag_s if self._measured_dps else max(self.motor.lag_s, SLOWEST_START_S)

    @property
    def _powered_on_dps(self) -> float:
        """The least speed of a motor that goes on as its run has ended."""
        if self.line is None or self.off_deg is None:
            return self.powered_dps
        return max(SLOWED_SHARE * (abs(self.line.speed_dps) - 2.0 * self.line.error_dps), self.powered_dps)

    # --- how a run ended

    def _end(self, now_s: float, was: RelayState) -> None:
        line = self.line = self._turning(min(now_s, self.trend.last_s), was.begun_s)
        if self._same_way:
            # Only a reversal has to take up the play of the gear. The rest of the start shows as coast.
            self.short.note(self.stands_dps, min(now_s - was.begun_s, START_S), 0.0, self.sure_deg)
        self.off_deg = self.place_deg
        if line is not None:
            self.off_deg = line.place_deg + line.speed_dps * (now_s - line.at_s)
            self.held = Behind()
            # A line over a time in which its pace has changed belongs to no pace.
            steady = 2.0 * line.at_s - self.trend.last_s >= self._paced_s
            exact = abs(line.speed_dps) >= EXACT_ERRORS * line.error_dps
            if exact and steady and now_s - was.begun_s >= MEASURED_AFTER_S:
                self._measured_dps[was.direction] = abs(line.speed_dps) / self._pace
                shown_dps = (abs(line.speed_dps) - line.error_dps) / self._pace
                self._shown_dps = max(self._shown_dps or SLOWEST_DPS, shown_dps)
        elif self._stopped(min(now_s, self.trend.last_s), was):
            self.held.note(self.motor_dps, 1.0, 0.0, 0.0)

    def _stopped(self, now_s: float, was: RelayState) -> bool:
        """Whether something held the axis, which had turned at first. A shorter run may be gathering speed."""
        end = self.trend.slope(now_s - END_WINDOWS_S[0])
        if end is None or now_s - was.begun_s < MEASURED_AFTER_S:
            return False
        stands = abs(end.speed_dps) + 3.0 * end.error_dps < self.powered_dps
        return stands and self._led_deg(was.direction) > self.sure_deg

    def _turning(self, now_s: float, begun_s: float) -> Slope | None:
        """How fast the axis turns just now, for certain."""
        for window_s in END_WINDOWS_S:
            slope = self.trend.slope(max(begun_s, now_s - window_s))
            if slope is None:
                continue
            if abs(slope.speed_dps) + 3.0 * slope.error_dps < self.powered_dps:
                return None  # it stands, though the longer windows still contain its motion
            if abs(slope.speed_dps) < SEEN_ERRORS * slope.error_dps:
                continue
            # The axis may have stopped within this window: then the window's end is slower than the whole.
            latest = self.trend.slope(max(begun_s, now_s - max(END_WINDOWS_S[0], window_s / 4.0)))
            if latest is None or latest.speed_dps * slope.way + 2.0 * latest.error_dps < SLOWED_SHARE * abs(
                slope.speed_dps
            ):
                return None
            longer = self.trend.slope(now_s - 1.0) if now_s - begun_s >= STEADY_S else None
            # No motor is faster than in the second before: a short line that says so is tilted by noise.
            steady = longer is not None and (longer.speed_dps - slope.speed_dps) * slope.way <= 3.0 * slope.error_dps
            return longer if longer is not None and steady and longer.error_dps < slope.error_dps else slope
        return None
