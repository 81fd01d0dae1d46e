"""One axis whose motor is only on or off: its goal, its limits and its faults.

Knows whether its sensor can be believed and what its motor may do. Knows nothing of the sky, of the other axis, or of
who gave the order.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from hw.ports import AngleSource, Direction
from rotator.control.axis.attempts import Attempts
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.end_calibration import EndCalibration
from rotator.control.axis.endurance import Endurance
from rotator.control.axis.goals import HomeGoal, JogGoal, jog
from rotator.control.axis.homing import Homing
from rotator.control.axis.motion import Motor
from rotator.control.axis.reach import Reach, lost
from rotator.control.axis.relay_faults import limit_reached
from rotator.control.axis.relay_gate import SETTLED_AFTER_S, RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Condition, Reading, Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.switched_law import ANYWHERE, SwitchedLaw, Timing
from rotator.control.axis.vain_presses import IN_VAIN, VainPresses
from rotator.control.axis.weld_watch import TURNS
from rotator.control.commands import UNFED, Command, Decision, Feed, Run, Steer
from rotator.control.refused import Refused
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path
from rotator.control.sky.pointing import AimGoal
from rotator.control.sky.sectors import UNKNOWN
from rotator.faults import Fault, FaultKind, Missing, Notice
from rotator.status import JOG_ENDS_DEG, AxisStatus, LearntMotor

ABOUT_DEG = 0.5
"""What readings scatter of an axis at rest."""
WHY_IT_TURNS = (FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF)
"""Faults that say more than the notice TURNS."""
LAPSED_S = 1.0
"""After a late cycle the relay stays open for so long: a busy computer would else make it chatter."""
BLIND = Notice("a broken pot wire would look like an angle: fit end resistors")


class SwitchedAxis:
    """The kind of `ControlledAxis` that relays drive. It can be homed where `settings.homing` says how."""

    def __init__(self, settings: SwitchedSettings, *, lease_s: float, period_s: float) -> None:
        self.settings = settings
        self._goal: AimGoal | JogGoal | HomeGoal | None = None
        self._decided_s: float | None = None
        """When it decided last: each order that comes makes it decide anew."""
        self._attempts = Attempts(settings.axis, settings.limits, settings.sensor)
        self._vain = VainPresses()
        self._ends = EndCalibration(settings.limits, settings.missing, settings.calibration)
        self._condition: Condition | None = None
        # A count does not scatter, and it is corrected by as much as a pulse at once. In a calibration the sensor's
        # scale and the motor's speed are not known yet, and the person is to hear of every spark.
        unjudged = settings.source is AngleSource.COUNTED or (settings.attended and settings.calibration is None)
        fastest_dps = math.inf if unjudged else settings.motor.speed_dps
        self._sensing = Sensing(settings.axis, settings.window, settings.calibration, fastest_dps)
        self._timing = Timing(lease_s=lease_s, period_s=period_s)
        motors = settings.learnt or (settings.motor, settings.motor)
        self._law = self._new_law(dict(zip((Direction.PLUS, Direction.MINUS), motors, strict=True)))
        self._gate = RelayGate(settings, self._law.motion.motors, lease_s=lease_s, placed=self._placed)
        self._astray: Fault | None = None
        """What is wrong with the motion, by the latest reading."""
        self._lapsed_s = -math.inf
        """When a late cycle came last: the lease had opened the relay of the motor that ran."""
        self._endurance = Endurance(settings.longest_run_s, settings.rest_s)
        self._relays = RelayState()
        self._reach = Reach(settings)

    @property
    def angle_deg(self) -> float | None:
        return self._sensing.angle_deg

    @property
    def speed_dps(self) -> float:
        """The slower direction, as learnt."""
        return min(motor.speed_dps for motor in self._law.motion.motors.values())

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
    def homing(self) -> bool:
        return isinstance(self._goal, HomeGoal)

    @property
    def fault(self) -> Fault | None:
        return self._attempts.fault

    @property
    def driven(self) -> bool:
        return self._relays.closed

    @property
    def pressed_in_vain(self) -> bool:
        return self._sensing.calibration is None and self._vain.enough

    @property
    def confirmable(self) -> bool:
        return self.settings.source is AngleSource.COUNTED

    @property
    def missing(self) -> tuple[Missing, ...]:
        """What this axis lacks before it may be aimed; empty: nothing."""
        lost = self._condition is not None and bool(self._condition.lost)
        return (*self._ends.missing, Missing.HOMING) if lost else self._ends.missing

    @property
    def has_relays(self) -> bool:
        return True

    @property
    def homeable(self) -> bool:
        return self.settings.homing is not None

    @property
    def cooling(self) -> bool:
        return self._endurance.resting

    def moving(self, now_s: float) -> bool:
        return self._relays.off_for_s(now_s) < SETTLED_AFTER_S

    def aim(self, goal: AimGoal) -> None:
        self._goal = goal

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        self._goal = jog(direction, seconds, now_s, commissioned=not self.missing, held=held)

    def home(self) -> None:
        if self.settings.homing is None:
            raise Refused(f"{self.settings.axis.value} knows its angle: it needs no homing")
        self._goal = HomeGoal(Homing(self.settings.homing))

    def halt(self) -> None:
        self._goal = None

    def forget_path(self) -> None:
        if isinstance(self._goal, AimGoal):
            self._goal = self._goal.standing()

    def confirmed(self) -> None:
        self._sensing.begin_anew(self._sensing.calibration)

    def see(self, reading: Reading, now_s: float) -> None:
        lost = self._note_condition(reading.condition)
        unbelievable = self._sensing.take(reading, now_s, self._gate.noise_deg)
        for at_s, angle_deg in self._sensing.places:
            if self._sensing.calibration is None:
                # Without a calibration there is no angle, but a relay that does not open is seen all the same.
                self._astray = self._gate.see(at_s, angle_deg, reading.condition)
                self._vain.see(at_s, angle_deg, self._gate.noise_deg)
                continue
            self._law.see(at_s, angle_deg)
            found = self._gate.see(at_s, angle_deg, reading.condition)
            if self.settings.homing is None:
                found = found or self._attempts.see(at_s, angle_deg, self._gate.noise_deg)
            self._astray = None if self.homing else found
        # The rotor's own report says more than what can be seen of it from here.
        reported, present = reading.condition.fault, self._gate.blind(unbelievable, now_s) or self._astray
        cause = present if reading.condition.latched else reported or present
        # Looking for its stop an axis is silent there; but one that turns by itself is told all the same.
        told = None if self.homing and reported and not reported.cut else reported
        if self._attempts.note(told or present or lost, now_s, cause=cause):
            self._law.forget_run()

    def _note_condition(self, condition: Condition) -> Fault | None:
        """What has become of the rotor since the last reading. A count that has just been lost is a fault, once."""
        before, self._condition = self._condition, condition
        if before is None:
            return None
        if condition.scale != before.scale:
            self._begin_anew(self._sensing.calibration)
        if condition.lost and not before.lost and not self.homing:
            return Fault(FaultKind.COUNT_LOST, self.settings.axis, f"homing ({condition.lost})")
        return None

    def fail(self, fault: Fault) -> None:
        if self._attempts.fail(fault):
            self._law.forget_run()

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        if by_person:
            self._vain.forget()
        acknowledged = self._attempts.acknowledge(now_s, by_person=by_person)
        if acknowledged:
            self._gate.acknowledge()
        return acknowledged

    def checked(self) -> None:
        """A person has looked at both relays, and they are open: no doubt is left."""
        self._gate.checked()

    def decide(self, now_s: float) -> Decision:
        past_s = 0.0 if self._decided_s is None else now_s - self._decided_s
        self._decided_s = now_s
        begun = isinstance(self._goal, HomeGoal) and self._goal.homing.begun
        self._gate.homes(homing=begun, failed=self.fault is not None)
        run: Command = self._safe(self._wish(now_s), now_s, past_s)
        if isinstance(run, Run) and run.direction is Direction.OFF and self._gate.unsure:
            run = UNFED
        if isinstance(self._goal, HomeGoal) and self._goal.homing.homed:
            homed_deg = self._goal.homing.home_deg
            self._goal = None
            return Decision(run, homed_deg)
        return Decision(run)

    def _safe(self, run: Run, now_s: float, past_s: float) -> Run | Feed:
        """The run, unless a relay, a limit or the motor's heat forbids it. `past_s`: since the last one."""
        if past_s > self._timing.lease_s and self.driven:
            self._lapsed_s = now_s
        if run.direction is Direction.OFF or now_s < self._lapsed_s + LAPSED_S:
            self._gate.rests()
            return self._law.rest(now_s) if run.direction else run
        if (suspected := self._gate.accuse(run.direction)) is not None:
            self.fail(suspected)
        if self._condition and run.direction in self._condition.ends:
            self.fail(limit_reached(self.settings.axis, run.direction))
        if self.fault is not None or self._endurance.resting or self._beyond(run.direction):
            self._gate.rests()
            return self._law.rest(now_s)
        passed = self._gate.passed(run, now_s)
        if self._gate.waiting and isinstance(self._goal, JogGoal):
            self._goal = self._goal.put_off(past_s)
        return passed

    def sweep(self, now_s: float, command: Command | None) -> Range:
        if self.missing or lost(self.fault):
            return UNKNOWN
        run = command if isinstance(command, Run) else None
        return self._reach.swept(now_s, self._sensing, self._law.motion, self._relays, run)

    @property
    def room_deg(self) -> float:
        return self._reach.room_deg(self._law.motion)

    @property
    def about_deg(self) -> float:
        return ABOUT_DEG

    def hold_back(self, now_s: float, why: str) -> None:
        self._law.rest(now_s)
        if self.homing:
            self.fail(Fault(FaultKind.NOT_HOMED, self.settings.axis, why))
        if not isinstance(self._goal, AimGoal):
            self._goal = None

    def _beyond(self, direction: Direction) -> bool:
        """Whether the axis stands at its limit in that direction, or past it."""
        if self.missing or self._sensing.angle_deg is None or self.homing:
            return False
        limits, angle_deg = self._attempts.limits, self._sensing.angle_deg
        return angle_deg >= limits.max_deg if direction > 0 else angle_deg <= limits.min_deg

    def _wish(self, now_s: float) -> Run:
        """What the goal asks for. A fault ends the goal."""
        if self.fault is not None:
            self._goal = None
        if self._goal is None or now_s >= self._sensing.ridden_until_s:
            return self._law.rest(now_s)
        run = self._towards(now_s, self._goal)
        if self._sensing.believable:
            return run
        # A bad reading starts nothing, and what runs may go on for a moment, until the next good one.
        if run.direction is not self._relays.direction:
            return self._law.rest(now_s)
        return Run(run.direction, min(run.until_s, self._sensing.ridden_until_s))

    def _towards(self, now_s: float, goal: AimGoal | JogGoal | HomeGoal) -> Run:
        match goal:
            case HomeGoal(homing):
                return self._home(now_s, homing)
            case AimGoal() if self.missing or self._sensing.angle_deg is None:
                return self._law.rest(now_s)
            case AimGoal(_, tolerance_deg, Path() as path) if self._attempts.limits.holds(path.angle_deg(now_s)):
                return self._law.follow(now_s, path, tolerance_deg)
            case AimGoal(target_deg, tolerance_deg, path):
                wanted_deg = path.angle_deg(now_s) if path else target_deg
                return self._law.approach(now_s, self._attempts.limits.nearest(wanted_deg), tolerance_deg)
            case JogGoal(_, until_s) if until_s is not None and now_s >= until_s:
                self._goal = None
                return self._law.rest(now_s)
            case JogGoal(direction, until_s):
                return self._jog(now_s, direction, until_s)

    def _jog(self, now_s: float, direction: Direction, until_s: float | None) -> Run:
        longest_s = now_s + self._timing.lease_s
        if until_s is not None:
            longest_s = min(longest_s, until_s)
        if self.missing or self._sensing.angle_deg is None:
            return Run(direction, longest_s)
        limits, rests_deg = self._attempts.limits, self._rests_deg
        limit_deg = min(limits.max_deg, rests_deg[1]) if direction > 0 else max(limits.min_deg, rests_deg[0])
        if (limit_deg - self._sensing.angle_deg) * direction <= JOG_ENDS_DEG:
            self._goal = None
            return self._law.rest(now_s)
        run = self._law.approach(now_s, limit_deg, JOG_ENDS_DEG)
        # A jog never turns back. Where the law would, the motor rests, also before a reversal.
        return Run(direction, min(run.until_s, longest_s)) if run.direction is direction else self._law.rest(now_s)

    def _home(self, now_s: float, homing: Homing) -> Run:
        assert self._condition is not None, "an axis homes only after its first reading"
        direction = homing.step(now_s, self._relays.direction, self._condition)
        if homing.failure:
            self._goal = None
            self.fail(Fault(FaultKind.NOT_HOMED, self.settings.axis, homing.failure))
        return Run(direction, now_s + self._timing.lease_s) if direction else self._law.rest(now_s)

    def calibrate_end(self, *, high_end: bool) -> None:
        raw = self._sensing.raw if self._sensing.believable else None
        try:
            calibration = self._ends.take(raw, self._sensing.calibration, high_end=high_end)
        except ValueError as reason:
            raise Refused(f"{self.settings.axis.value} keeps its calibration: {reason}") from reason
        if calibration is not None:
            self._begin_anew(calibration)

    def _begin_anew(self, calibration: Calibration | None) -> None:
        """The readings mean other places than before. Only a motor that counts keeps what it has learnt."""
        self._sensing.begin_anew(calibration)
        self._attempts.forget()
        keeps = self.settings.homing is not None
        motors = self._law.motion.motors if keeps else dict.fromkeys(self._law.motion.motors, self.settings.motor)
        self._law = self._new_law(motors)
        self._gate.rescale(self._law.motion.motors, placed=self._placed)

    def shortened(self, now_s: float, command: Steer) -> None:
        """Relays are not steered."""

    def note_driven(self, now_s: float, driven: Direction) -> None:
        was, self._relays = self._relays, self._relays.changed(now_s, driven)
        self._law.note_relays(now_s, self._relays)
        self._endurance.note(now_s, running=self._relays.closed)
        if self._relays != was:
            self._gate.note_relays(self._relays)
            self._attempts.note_relays(self._relays, self._law.motion.motors[driven].speed_dps if driven else 0.0)
            self._vain.note_relays(self._relays)

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        calibration = self._sensing.calibration
        return AxisStatus(
            min_deg=self.settings.limits.min_deg,
            max_deg=self.settings.limits.max_deg,
            angle_deg=self._sensing.angle_deg,
            seen=now_s <= self._sensing.ridden_until_s,
            raw=self._sensing.raw,
            source=self.settings.source,
            target_deg=self.aiming.target_deg if self.aiming else None,
            tolerance_deg=self.aiming.tolerance_deg if self.aiming else None,
            drive=self._relays.direction,
            moving=self.moving(now_s),
            starts=starts,
            missing=self.missing,
            lost=self._condition.lost if self._condition else "",
            confirmable=self.confirmable,
            fault=self.fault,
            homing=self.homing,
            notices=self._notices(now_s) + more,
            noise_deg=self._gate.noise_deg,
            calibration=calibration.points if calibration else None,
            learnt=self._learnt(),
            trusts=self._gate.trusts,
            waiting=self._gate.waiting,
        )

    def _notices(self, now_s: float) -> tuple[Notice, ...]:
        reported = self._condition.notice if self._condition else None
        blind = BLIND if self.settings.window.blind else None
        vain = IN_VAIN if self.pressed_in_vain else None
        single = (reported, self._sensing.notice, self._endurance.notice, vain, blind)
        found = (notice for notice in single if notice is not None)
        told = self.fault is not None and self.fault.kind in WHY_IT_TURNS
        gate = (notice for notice in self._gate.notices(now_s) if not (told and notice == TURNS))
        return (*gate, *self._attempts.notices, *found)

    @property
    def _placed(self) -> bool:
        """Whether its readings are angles, and its limits known."""
        return self._sensing.calibration is not None and Missing.LIMITS not in self.missing

    @property
    def _rests_deg(self) -> tuple[float, float]:
        """Between these angles the axis may be brought to rest."""
        limits, homing = self.settings.limits, self.settings.homing
        if homing is None:
            return limits.min_deg, limits.max_deg
        return max(limits.min_deg, homing.rest_deg[0]), min(limits.max_deg, homing.rest_deg[1])

    def _new_law(self, motors: Mapping[Direction, Motor]) -> SwitchedLaw:
        homing = self.settings.homing
        return SwitchedLaw(motors, self._timing, homing.rest_deg if homing else ANYWHERE)

    def _learnt(self) -> tuple[LearntMotor, LearntMotor]:
        plus, minus = (self._law.motion.motors[way] for way in (Direction.PLUS, Direction.MINUS))
        return LearntMotor(plus.speed_dps, plus.coast_deg), LearntMotor(minus.speed_dps, minus.coast_deg)
