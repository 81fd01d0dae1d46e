"""One axis whose motor goes to an angle by itself: where it is to be now, and how fast its target moves on.

The sibling of `switched`. Knows its goal, its limits and its faults. Knows nothing of the sky, of the other axis, or of
who gave the order. It does not know how the drive gets to an angle; it sees whether it does.
"""

from __future__ import annotations

import math
from dataclasses import replace

from hw.ports import AngleSource, Direction
from rotator.control.axis.fault_latch import FaultLatch
from rotator.control.axis.goals import JogGoal, jog
from rotator.control.axis.held_watch import HeldWatch
from rotator.control.axis.pace import Pace
from rotator.control.axis.reach import UNSEEN_S, lost
from rotator.control.axis.relay_faults import limit_reached, unstoppable
from rotator.control.axis.sensing import Condition, Reading, Sensing
from rotator.control.axis.settings import PositionedSettings
from rotator.control.axis.stray_watch import COMING_DEG, SERVO_STRAY_DEG, STRAY_DEG, StrayWatch
from rotator.control.axis.trend import Trend
from rotator.control.commands import HOLD, Command, Decision, Hold, Steer
from rotator.control.refused import Refused
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path
from rotator.control.sky.pointing import AimGoal
from rotator.control.sky.sectors import UNKNOWN
from rotator.faults import Fault, FaultKind, Missing, Notice
from rotator.status import AxisStatus

RATE_OVER_S = 0.25
"""The target's rate is taken over this much of its path, half of it before now."""
STILL_DPS = 0.05
"""A target slower than this stands still."""


class PositionedAxis:
    """The kind of `ControlledAxis` for drives that take an angle."""

    def __init__(self, settings: PositionedSettings, *, lease_s: float) -> None:
        self.settings = settings
        self._goal: AimGoal | JogGoal | None = None
        self._faults = FaultLatch(settings.sensor)
        self._condition = Condition()
        self._lease_s = lease_s
        # A model jumps where it is corrected, and it does not scatter.
        fastest_dps = settings.speed_dps if settings.source is AngleSource.MEASURED else math.inf
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration, fastest_dps)
        servo = settings.accel_dps2 is not None and settings.source is AngleSource.MEASURED
        self._stray = StrayWatch(
            settings.axis,
            settings.speed_dps,
            settings.accel_dps2,
            near_deg=settings.near_deg,
            stray_deg=SERVO_STRAY_DEG if servo else STRAY_DEG,
        )
        self._held = HeldWatch(settings.axis, settings.speed_dps, master=settings.master)
        self._seen_s = 0.0
        """The moment of the present cycle."""
        self._readings = Trend()
        self._pace = Pace(settings)
        self._steered: tuple[Steer, float] | None = None
        """Where the drive was sent last, and when; None: it holds."""
        self._jogged = Direction.OFF
        """Which way a jog sent it there."""

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def speed_dps(self) -> float:
        return self.settings.speed_dps

    @property
    def aiming(self) -> AimGoal | None:
        return self._goal if isinstance(self._goal, AimGoal) else None

    @property
    def busy(self) -> bool:
        return self._goal is not None

    @property
    def jog_is_held(self) -> bool:
        return isinstance(self._goal, JogGoal) and (self._goal.held or self._goal.until_s is None)

    @property
    def fault(self) -> Fault | None:
        return self._faults.fault

    @property
    def driven(self) -> bool:
        """Whether the drive was last sent elsewhere than where the axis is."""
        return self._steered is not None and not self._arrived(self._steered[0])

    @property
    def pressed_in_vain(self) -> bool:
        return False  # without a calibration there is nowhere to send it

    @property
    def confirmable(self) -> bool:
        return self.settings.confirmable

    @property
    def has_relays(self) -> bool:
        return False

    @property
    def homeable(self) -> bool:
        return False

    @property
    def homing(self) -> bool:
        return False

    @property
    def cooling(self) -> bool:
        return False

    def moving(self, now_s: float) -> bool:
        return self.driven

    def aim(self, goal: AimGoal) -> None:
        self._goal = goal

    @property
    def missing(self) -> tuple[Missing, ...]:
        return self.settings.missing

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        self._goal = jog(direction, seconds, now_s, commissioned=not self.settings.missing, held=held)

    def home(self) -> None:
        raise Refused(f"{self.settings.axis.value} knows its angle: it needs no homing")

    def calibrate_end(self, *, high_end: bool) -> None:
        raise Refused(f"{self.settings.axis.value} knows its own angles: it needs no ends")

    def checked(self) -> None:
        raise Refused(f"{self.settings.axis.value} has no relays: there is nothing to look at")

    def halt(self) -> None:
        self._goal = None

    def forget_path(self) -> None:
        if isinstance(self._goal, AimGoal):
            self._goal = self._goal.standing()

    def confirmed(self) -> None:
        self._sensing.begin_anew(self._sensing.calibration)

    def see(self, reading: Reading, now_s: float) -> None:
        self._condition = reading.condition
        self._seen_s = now_s
        unbelievable = self._sensing.take(reading, now_s, self._readings.noise_deg)
        for at_s, angle_deg in self._sensing.places if self._sensing.angle_deg is not None else ():
            self._readings.see(at_s, angle_deg, self.settings.speed_dps)
            self._pace.see(at_s, angle_deg)
        # The rotor's own report says more than what can be seen of it from here.
        reported = reading.condition.fault
        cause = unbelievable if reading.condition.latched else reported or unbelievable
        found = reported or unbelievable or self._turning(now_s) or self._straying(now_s)
        if found is not None and found.kind is FaultKind.NOT_FOLLOWING and self.settings.master:
            # A control box that does not follow may not hear, and then no stop reaches it either.
            found = unstoppable(found, master=True)
        # A move that was too short to show anything counts with the one that shows it.
        vain = self._stray.tries if found is not None and found.kind is FaultKind.NOT_FOLLOWING else 0
        if self._faults.note(found, now_s, cause=cause, tries=int(self.driven) + vain):
            self._stray.struck()

    def _turning(self, now_s: float) -> Fault | None:
        """What is wrong while it is to hold. A model would show nothing, and wind turns an axis that is let go."""
        if not self.settings.own_motor or self.settings.source is not AngleSource.MEASURED:
            return None
        return self._held.see(now_s, self._readings, self._sensing.angle_deg, holds=self._steered is None)

    def _straying(self, now_s: float) -> Fault | None:
        steered = self._steered[0] if self._steered else None
        noise_deg = self._readings.noise_deg if self.settings.source is AngleSource.MEASURED else 0.0
        return self._stray.see(now_s, steered, self._sensing.angle_deg, noise_deg, settling=self._condition.settling)

    def fail(self, fault: Fault) -> None:
        self._faults.fail(fault, self._seen_s, tries=int(self.driven))

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        if self.fault is not None:
            self._stray.clear()
        return self._faults.acknowledge(now_s, by_person=by_person)

    def decide(self, now_s: float) -> Decision:
        command = self._wish(now_s)
        if isinstance(command, Steer) and (blocked := self._blocked(command)):
            self.fail(limit_reached(self.settings.axis, blocked))
            self._goal, command = None, HOLD
        self._steered = (command, now_s) if isinstance(command, Steer) else None
        self._jogged = self._goal.direction if isinstance(self._goal, JogGoal) else Direction.OFF
        match command:
            case Steer(place_deg, 0.0, _):
                self._pace.sent(now_s, place_deg)
            case Steer():
                self._pace.moves_on()
        return Decision(command)

    def sweep(self, now_s: float, command: Command | None) -> Range:
        if self.settings.missing or now_s - self._sensing.believed_s > UNSEEN_S or lost(self.fault):
            return UNKNOWN
        span = self._pace.span(now_s)
        if not isinstance(command, Steer):
            return span
        # It comes to rest at the place of its last command, moving on for as long as that holds.
        on_deg = abs(command.rate_dps) * (command.until_s - now_s) + self._pace.braking_deg(command.rate_dps)
        end_deg = command.angle_deg + math.copysign(on_deg, command.rate_dps)
        near_deg = self.settings.near_deg
        return span.spanning(min(command.angle_deg, end_deg) - near_deg).spanning(
            max(command.angle_deg, end_deg) + near_deg
        )

    @property
    def room_deg(self) -> float:
        return 2.0 * self.settings.near_deg

    @property
    def about_deg(self) -> float:
        return 1.1 * self.settings.near_deg

    def hold_back(self, now_s: float, why: str) -> None:
        self._steered = None
        if isinstance(self._goal, JogGoal):
            self._goal = None

    def shortened(self, now_s: float, command: Steer) -> None:
        self._steered = (command, now_s)
        self._pace.sent(now_s, command.angle_deg)
        if isinstance(self._goal, JogGoal):
            self._goal = replace(self._goal, end_deg=command.angle_deg)

    def note_driven(self, now_s: float, driven: Direction) -> None:
        """There are no relays to be noted."""

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        limits = self.settings.limits
        return AxisStatus(
            min_deg=limits.min_deg,
            max_deg=limits.max_deg,
            angle_deg=self._sensing.angle_deg,
            seen=now_s <= self._sensing.ridden_until_s,
            raw=self._sensing.raw,
            source=self.settings.source,
            target_deg=self.aiming.target_deg if self.aiming else None,
            tolerance_deg=self.aiming.tolerance_deg if self.aiming else None,
            drive=self._direction(),
            moving=self.moving(now_s),
            starts=starts,
            missing=self.settings.missing,
            confirmable=self.confirmable,
            fault=self.fault,
            noise_deg=self._readings.noise_deg,
            notices=(*(each for each in (self._condition.notice, self._sensing.notice) if each), *more),
        )

    def _wish(self, now_s: float) -> Steer | Hold:
        """What the goal asks for. A fault ends the goal."""
        if self.fault is not None:
            self._goal = None
        # A bad reading starts nothing, and what moves may go on for a moment, until the next good one.
        trusted = self._sensing.believable or self._steered is not None
        if self._goal is None or not trusted or self._sensing.angle_deg is None:
            return HOLD
        until_s = min(now_s + self._lease_s, self._sensing.ridden_until_s)
        if until_s <= now_s:
            return HOLD
        match self._goal:
            case AimGoal() if self.settings.missing:
                return HOLD
            case AimGoal(_, _, Path() as path):
                before_deg = path.angle_deg(now_s - RATE_OVER_S / 2)
                rate_dps = (path.angle_deg(now_s + RATE_OVER_S / 2) - before_deg) / RATE_OVER_S
                return self._within(path.angle_deg(now_s), rate_dps, until_s)
            case AimGoal(target_deg, _, _):
                return self._within(target_deg, 0.0, until_s)
            case JogGoal(_, jog_until_s) if jog_until_s is not None and now_s >= jog_until_s:
                self._goal = None
                return HOLD
            case JogGoal(end_deg=float() as end_deg):
                return self._jog_to(end_deg, until_s)
            case JogGoal(direction):
                return self._jog(self._sensing.angle_deg, now_s, direction, until_s)

    def _jog(self, angle_deg: float, now_s: float, direction: Direction, until_s: float) -> Steer | Hold:
        """On from where this jog sent it last, at its own speed, as far as its limit; at first from where it is."""
        limits = self.settings.limits
        limit_deg = limits.max_deg if direction > 0 else limits.min_deg
        if self._steered is None and (limit_deg - angle_deg) * direction <= self.settings.near_deg:
            self._goal = None
            return HOLD
        # Where it can just brake, it is steered to its limit again and again: `hold` would let it come to rest beyond.
        from_deg = angle_deg
        if self._steered is not None and self._jogged is direction and not self._condition.settling:
            steered, steered_s = self._steered
            from_deg = steered.angle_deg + steered.rate_dps * (now_s - steered_s)
        if (limit_deg - from_deg) * direction <= self._braking_deg:
            return Steer(limit_deg, 0.0, until_s)
        return self._within(from_deg, self.speed_dps * direction, until_s)

    def _jog_to(self, end_deg: float, until_s: float) -> Steer | Hold:
        """The end of a jog that may go no further."""
        steer = self._within(end_deg, 0.0, until_s)
        if not self._arrived(steer):
            return steer
        self._goal = None
        return HOLD

    @property
    def _braking_deg(self) -> float:
        """How far it takes to come to rest from its full speed."""
        return self._pace.braking_deg(self.speed_dps)

    def _within(self, angle_deg: float, rate_dps: float, until_s: float) -> Steer:
        """No further than the limits; at a limit the target moves on alone."""
        limits = self.settings.limits
        kept_deg = limits.nearest(angle_deg)
        outward = (kept_deg == limits.max_deg and rate_dps > 0) or (kept_deg == limits.min_deg and rate_dps < 0)
        return Steer(kept_deg, 0.0 if outward or kept_deg != angle_deg else rate_dps, until_s)

    def _blocked(self, command: Steer) -> Direction | None:
        """The direction of the command, where a limit switch forbids it."""
        assert self._sensing.angle_deg is not None, "an axis is steered only where its angle is known"
        ahead_deg = command.angle_deg + command.rate_dps * self._lease_s - self._sensing.angle_deg
        towards = Direction.PLUS if ahead_deg > 0 else Direction.MINUS
        return towards if towards in self._condition.ends and abs(ahead_deg) >= COMING_DEG else None

    def _arrived(self, steered: Steer) -> bool:
        angle_deg = self._sensing.angle_deg
        if angle_deg is None:
            return True
        return abs(steered.angle_deg - angle_deg) < self.settings.near_deg and abs(steered.rate_dps) < STILL_DPS

    def _direction(self) -> Direction:
        if self._steered is None or self._sensing.angle_deg is None or self._arrived(self._steered[0]):
            return Direction.OFF
        steered = self._steered[0]
        ahead_deg = steered.angle_deg - self._sensing.angle_deg
        towards = ahead_deg if abs(ahead_deg) >= self.settings.near_deg else steered.rate_dps
        return Direction.PLUS if towards > 0 else Direction.MINUS
