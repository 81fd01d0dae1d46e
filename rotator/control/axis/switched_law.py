"""The law for a motor that is only on or off: when to start it, when to stop it.

A target that stands still is followed bang-bang: the motor rests until the error exceeds the tolerance, then runs to
the target. A moving target is followed in steps that run past it: it then drifts back through the window (`sky.plan`).
The motor is stopped where its coast, as learnt, ends on the goal. Knows one axis. Knows nothing of the sky, of limits,
of faults or of relays.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from hw.ports import Direction
from rotator.control.axis.goals import JogGoal
from rotator.control.axis.motion import Motion
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.settings import BrakeSettings, SpeedSettings
from rotator.control.axis.throttle import Throttle
from rotator.control.commands import Run
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path, next_place_deg
from rotator.exchange.motor import Motor
from rotator.exchange.status import JOG_ENDS_DEG

LEAST_SHARE = 0.55
"""An error below this share of the tolerance starts no motor, even for a slow target: orders in whole degrees are no
more exact."""
LEAST_MOVE_DEG = 0.3
RESTARTS_AFTER_S = 0.5
"""After a motor was switched off for a standing target, it starts for that target again after this time at the
earliest: only then do the readings show where the axis stands. Without this the relay of a counted axis would chatter,
because the axis waits for its contact."""

ANYWHERE = (-math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class Timing:
    lease_s: float
    """How long a command to a drive lives unless renewed."""
    period_s: float
    """How soon the next cycle comes. A stop that is due before it is left to the end of the lease."""
    brake: BrakeSettings | None = None
    """A brake that is released before a start; None: the motor starts at once."""
    speed: SpeedSettings | None = None
    """What an output can set the motor's speed to; None: it turns at full speed."""


class SwitchedLaw:
    """`motors`: what is known of each direction's motor. `reach`: between these angles the axis is brought to rest."""

    def __init__(
        self, motors: Mapping[Direction, Motor], timing: Timing, reach: tuple[float, float] = ANYWHERE
    ) -> None:
        self.motion = Motion(motors)
        self.throttle = Throttle(timing.speed)
        self._timing = timing
        self._reach = reach
        self._taught = dict(motors)
        """What was known of the motors before the present or latest run."""
        self._relays = RelayState()
        self._running = Direction.OFF
        self._goal_deg = 0.0
        self._stop_s: float | None = None
        """When the lease will have opened the relay."""
        self._planned: tuple[Path, float] | None = None
        self._nudged = False
        """A person has shifted the target, and the axis has not been there since."""

    def renewed(self, motors: Mapping[Direction, Motor]) -> SwitchedLaw:
        """The same law for readings that mean other places than before."""
        law = SwitchedLaw(motors, self._timing, self._reach)
        law.throttle = self.throttle
        return law

    def see(self, at_s: float, angle_deg: float) -> None:
        """A new good reading of the axis."""
        self._note_stop(at_s)
        self.motion.see(at_s, angle_deg)

    def note_relays(self, now_s: float, relays: RelayState) -> None:
        """After each cycle: what the relays do."""
        if relays.closed and not self._relays.closed:
            self._taught = dict(self.motion.motors)
        self._relays = relays
        self._note_stop(now_s)
        if relays.direction is not self.motion.direction:
            wanted_deg = self._goal_deg if self._running else self._rest_deg(now_s)
            self.motion.note_drive(now_s, relays.direction, wanted_deg)
        if not relays.closed:
            self.throttle.rest()
        self.motion.note_pace(now_s, self.throttle.share)

    @property
    def learnt(self) -> tuple[Motor, Motor]:
        return self.motion.motors[Direction.PLUS], self.motion.motors[Direction.MINUS]

    def forget_run(self) -> None:
        """Something was wrong with the present or latest run: what it has taught is dropped."""
        self.motion.forget_run()
        self.motion.motors.update(self._taught)

    def rest(self, now_s: float) -> Run:
        self._running = Direction.OFF
        self._stop_s = None
        self._planned = None
        return Run(Direction.OFF, now_s)

    def nudged(self) -> None:
        """A person has shifted the target: go there, also where the tolerance would let the axis rest."""
        self._nudged = True

    def approach(self, now_s: float, target_deg: float, tolerance_deg: float) -> Run:
        """Towards a target that stands still."""
        target_deg = self._within_reach(target_deg)
        error_deg = target_deg - self._rest_deg(now_s)
        tolerance_deg = min(tolerance_deg, LEAST_MOVE_DEG) if self._nudged else tolerance_deg
        if self._running is Direction.OFF and abs(error_deg) <= tolerance_deg:
            self._nudged = False
            return self.rest(now_s)
        again = target_deg == self._goal_deg and self._relays.off_for_s(now_s) < RESTARTS_AFTER_S
        if self._running is Direction.OFF and again:
            return self.rest(now_s)
        return self._go(now_s, target_deg)

    def start_s(self, now_s: float) -> float:
        """How long a start takes now, until its relay closes: while the brake holds, its release."""
        brake = self._timing.brake
        held = brake is not None and self._relays.off_for_s(now_s) >= brake.held_off_s
        return brake.release_s if brake and held else 0.0

    def drive(self, now_s: float, direction: Direction) -> Run:
        """Drive in this direction at any angle of the axis; OFF: rest."""
        return Run(direction, now_s + self._timing.lease_s) if direction else self.rest(now_s)

    def aim(self, now_s: float, goal: AimGoal, limits: Range) -> Run:
        """Towards this goal, inside the limits."""
        match goal:
            case AimGoal(_, tolerance_deg, Path() as path) if limits.holds(path.angle_deg(now_s)):
                return self.follow(now_s, path, tolerance_deg)
            case AimGoal(target_deg, tolerance_deg, path):
                wanted_deg = path.angle_deg(now_s) if path else target_deg
                return self.approach(now_s, limits.nearest(wanted_deg), tolerance_deg)

    def jog(self, now_s: float, goal: JogGoal, angle_deg: float, limits: Range) -> Run | None:
        """In this direction, up to the limit. None: it is there, and the jog is over."""
        direction = goal.direction
        limit_deg = self._within_reach(limits.max_deg if direction > 0 else limits.min_deg)
        if (limit_deg - angle_deg) * direction <= JOG_ENDS_DEG:
            return None
        run = self.approach(now_s, limit_deg, JOG_ENDS_DEG)
        # A jog never turns back. Where the law would, the motor rests, also before a reversal.
        if run.direction is not direction:
            return self.rest(now_s)
        return Run(direction, min(run.until_s, self.jog_until_s(now_s, goal)))

    def jog_until_s(self, now_s: float, goal: JogGoal) -> float:
        """Until when a command of this jog holds, at any angle of the axis."""
        longest_s = now_s + self._timing.lease_s
        return longest_s if goal.until_s is None else min(longest_s, goal.until_s)

    def follow(self, now_s: float, path: Path, tolerance_deg: float) -> Run:
        """Along with a target that moves; the tolerance is on the sky."""
        rest_deg = self._rest_deg(now_s)
        direction = Direction.PLUS if path.angle_deg(now_s) > rest_deg else Direction.MINUS
        full_dps = self.motion.motors[self._running or direction].speed_dps
        way_deg = path.angle_deg(now_s) - rest_deg
        if self._running and self._along(now_s, path, full_dps):
            return Run(self._running, now_s + self._timing.lease_s)
        speed_dps = full_dps * self.throttle.mean(abs(way_deg) / full_dps)
        start_s = self.start_s(now_s)
        place_deg = self._within_reach(self._place_deg(path, rest_deg, speed_dps, tolerance_deg, start_s))
        if self._running is Direction.OFF:
            crossing_s = now_s + start_s + abs(place_deg - rest_deg) / speed_dps / 2
            then_deg = path.angle_deg(crossing_s)
            staying_deg, going_deg = abs(then_deg - rest_deg), abs(then_deg - place_deg)
            on_sky_deg = staying_deg * math.sqrt(path.weight(crossing_s))
            worth_it = staying_deg >= going_deg and on_sky_deg >= LEAST_SHARE * tolerance_deg
            if not (worth_it or self._nudged):
                return Run(Direction.OFF, now_s)
            if abs(place_deg - rest_deg) < LEAST_MOVE_DEG:
                self._nudged = False
                return Run(Direction.OFF, now_s)
        return self._go(now_s, place_deg)

    def _along(self, now_s: float, path: Path, full_dps: float) -> bool:
        """Whether the motor turns along with a target that is fast enough for it."""
        soon_s = now_s + self._timing.period_s
        rate_dps = (path.angle_deg(soon_s) - path.angle_deg(now_s)) / self._timing.period_s
        behind_deg = path.angle_deg(now_s) - self.motion.angle_at(now_s)
        way = self._running / full_dps
        if self._stop_s is not None or not self.throttle.along(now_s, rate_dps * way, behind_deg * way):
            return False
        self._goal_deg = path.angle_deg(soon_s)
        return True

    def _place_deg(self, path: Path, rest_deg: float, speed_dps: float, tolerance_deg: float, start_s: float) -> float:
        """The place planned on this path. It is planned once for each path, because a path is replaced after 0.5 s."""
        if self._planned is None or self._planned[0] is not path:
            self._planned = (path, next_place_deg(path, rest_deg, speed_dps, tolerance_deg, start_s))
        return self._planned[1]

    def _go(self, now_s: float, goal_deg: float) -> Run:
        """Start, or go on, towards the goal; stop where the motor would coast onto it."""
        if self._stop_s is not None:
            if now_s < self._stop_s and goal_deg == self._goal_deg:
                return Run(self._running, self._stop_s)
            if now_s >= self._stop_s:
                return self.rest(now_s)
            self._stop_s = None
        left_deg = goal_deg - self._rest_deg(now_s)
        if self._running is Direction.OFF:
            self._running = Direction.PLUS if left_deg > 0 else Direction.MINUS
        self._nudged = self._nudged and (goal_deg != self._goal_deg or left_deg * self._running > 0)
        self._goal_deg = goal_deg
        left_deg *= self._running
        if left_deg <= 0:
            return self.rest(now_s)
        # The point where the axis would come to rest runs ahead at full speed from the first moment on.
        full_dps = self.motion.motors[self._running].speed_dps
        if self._relays.closed:
            self.throttle.towards(now_s, left_deg / full_dps)
        left_s = left_deg / (full_dps * self.throttle.share)
        if left_s > self._timing.period_s:
            return Run(self._running, now_s + self._timing.lease_s)
        self._stop_s, self._nudged = now_s + left_s, False
        return Run(self._running, self._stop_s)

    def _within_reach(self, goal_deg: float) -> float:
        return min(max(goal_deg, self._reach[0]), self._reach[1])

    def _rest_deg(self, now_s: float) -> float:
        return self.motion.rest_deg(now_s)

    def _note_stop(self, now_s: float) -> None:
        if self._stop_s is not None and now_s >= self._stop_s:
            self.motion.note_drive(self._stop_s, Direction.OFF, self._goal_deg)
            self._running = Direction.OFF
            self._stop_s = None
            self._planned = None
