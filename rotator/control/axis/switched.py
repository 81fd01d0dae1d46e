"""One axis whose motor is only on or off: its goal, its limits and its faults.

Knows whether its sensor can be believed and what its motor may do. Knows nothing of the sky, of the other axis, or of
who gave the order.
"""

from __future__ import annotations

import math
from dataclasses import replace

from hw.ports import AngleSource, Direction
from rotator.control.axis.axis_base import AxisBase
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.goals import HomeGoal, JogGoal, PlaceAnew, SeekGoal
from rotator.control.axis.reach import Reach, lost
from rotator.control.axis.readings import Reading
from rotator.control.axis.relay_gate import SETTLED_AFTER_S, RelayGate
from rotator.control.axis.relay_state import BOTH_WAYS, RelayState
from rotator.control.axis.run_permit import RunPermit, at_ends
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.switched_faults import SwitchedFaults
from rotator.control.axis.switched_law import ANYWHERE, SwitchedLaw, Timing
from rotator.control.axis.vain_runs import IN_VAIN
from rotator.control.commands import UNFED, Command, Decision, Feed, Run, Steer
from rotator.control.refused import Refused, no_homing
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.control.sky.sectors import UNKNOWN
from rotator.exchange.faults import Fault, FaultKind, Missing, Notice
from rotator.exchange.status import AxisStatus

POSITION_ERROR_DEG = 0.5
"""The known angle may be wrong by this: readings scatter while the axis is at rest."""
BLIND = Notice("a broken pot wire would look like an angle: fit end resistors")


class SwitchedAxis(AxisBase[SwitchedSettings]):
    """The kind of `ControlledAxis` that relays drive."""

    def __init__(self, settings: SwitchedSettings, *, lease_s: float, period_s: float) -> None:
        # Counts and models do not scatter, and are corrected at once: by a pulse, at an end stop. In a calibration the
        # sensor's scale and the motor's speed are not known yet, and the person is to hear of every spark.
        unjudged = settings.source is not AngleSource.MEASURED or (settings.attended and settings.calibration is None)
        super().__init__(settings, math.inf if unjudged else settings.motor.speed_dps)
        motors = dict(zip(BOTH_WAYS, settings.learnt or (settings.motor, settings.motor), strict=True))
        rests_deg = settings.homing.rest_deg if settings.homing else ANYWHERE
        self._law = SwitchedLaw(motors, Timing(lease_s, period_s, settings.brake, settings.speed), rests_deg)
        self._gate = RelayGate(settings, self._law.motion.motors, lease_s=lease_s, placed=self._placed)
        self._permit = RunPermit(settings, self._gate, lease_s=lease_s)
        self._faults = SwitchedFaults(settings, self._gate)
        self._reach = Reach(settings)
        self._relays = RelayState()
        self._lease_s = lease_s
        self._rocked = False
        """The present or latest run belongs to a rock, and teaches nothing."""
        self._scale: int | None = None
        """The scale of the latest reading; None: there was no reading yet."""
        self._blind = BLIND if settings.window.blind else None
        self._decided_s: float | None = None
        """When the axis decided last. An order makes it decide again between two cycles."""
        self._anew = PlaceAnew(settings.homing)
        self._homed_scale: int | None = None
        """The scale that ends, for the end stop has just been found; no target is gone to with it."""

    @property
    def speed_dps(self) -> float:
        """The slower direction, as learnt."""
        return min(motor.speed_dps for motor in self._law.motion.motors.values())

    @property
    def fault(self) -> Fault | None:
        return self._faults.attempts.fault

    @property
    def driven(self) -> bool:
        return self._relays.closed

    @property
    def pressed_in_vain(self) -> bool:
        return self._sensing.calibration is None and self._gate.watch.runs.pressed

    @property
    def confirmable(self) -> bool:
        return self._settings.source is not AngleSource.MEASURED

    @property
    def has_relays(self) -> bool:
        return True

    @property
    def turns_when_fed(self) -> bool:
        return self._gate.turns_when_fed

    @property
    def homeable(self) -> bool:
        return self._settings.homing is not None

    @property
    def waits(self) -> bool:
        return self._permit.cooling or self._gate.waiting

    def moving(self, now_s: float) -> bool:
        return self._relays.off_for_s(now_s) < SETTLED_AFTER_S

    def nudged(self) -> None:
        self._law.nudged()

    def limit_speed(self, level: int) -> None:
        self._law.throttle.limit(level)

    def home(self) -> None:
        if self._settings.homing is None:
            raise Refused(no_homing(self._settings.axis.value, lost=False))
        self._goal, self._ordered = HomeGoal(self._settings.homing.begin(None)), None

    def aim(self, goal: AimGoal) -> None:
        self._anew.aimed(self._decided_s or 0.0, self._condition)
        super().aim(goal)

    def see(self, reading: Reading, now_s: float) -> None:
        scale, self._scale = self._scale, reading.condition.scale
        if scale is not None and scale != self._scale:
            self._begin_anew(self._sensing.calibration)
        unbelievable = self._sense(reading, now_s, self._gate.watch.noise_deg)
        if self._sensing.calibration is not None:
            for at_s, angle_deg in self._sensing.places:
                self._law.see(at_s, angle_deg)
        if self._faults.look(reading, self._sensing, unbelievable, now_s, homing=self.homing, aiming=bool(self.aiming)):
            self._law.forget_run()

    def fail(self, fault: Fault) -> None:
        if self._faults.attempts.fail(fault):
            self._law.forget_run()

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        return self._faults.acknowledge(now_s, by_person=by_person)

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._gate.watch.checked()

    def decide(self, now_s: float) -> Decision:
        past_s = 0.0 if self._decided_s is None else now_s - self._decided_s
        self._decided_s = now_s
        begun = isinstance(self._goal, HomeGoal) and self._goal.homing.begun
        fault = self.fault
        self._gate.watch.homes(homing=begun, failed=fault is not None)
        if fault is not None:
            self._goal = None
        run: Command = self._safe(self._rock(now_s) or self._wish(now_s), now_s, past_s)
        if isinstance(run, Run) and run.direction is Direction.OFF and self._gate.unsure:
            run = UNFED
        if isinstance(run, Run) and self._settings.speed:
            run = replace(run, pace=self._law.throttle.share)
        if isinstance(self._goal, HomeGoal) and self._goal.homing.homed:
            homed_deg = self._goal.homing.home_deg
            self._goal, self._homed_scale = self._goal.then, self._scale
            return Decision(run, homed_deg)
        turns = self._settings.brake is not None and self._seen_turning.speed_dps(self._gate.watch.noise_deg) != 0.0
        return Decision(run, turns=turns)

    def _rock(self, now_s: float) -> Run | None:
        """The run that frees the wedge of its brake; None: none is under way."""
        rock = self._faults.rock
        if not isinstance(self._goal, AimGoal) or not self._sensing.believable:
            rock.end()
        if run := rock.run(now_s, self._relays, self._lease_s):
            self._law.rest(now_s)
            self._rocked = True
        return run

    def _safe(self, run: Run, now_s: float, past_s: float) -> Run | Feed:
        """The run, as far as it is permitted. `past_s`: since the cycle before."""
        unbounded = run.direction is Direction.OFF or self.missing or self.homing
        angle_deg = None if unbounded else self._sensing.angle_deg
        ends = () if angle_deg is None else at_ends(angle_deg, self._faults.attempts.limits)
        permitted = self._permit.permitted(run, now_s, past_s, ends=ends, switches=self._condition.ends)
        if isinstance(permitted, Fault):
            self.fail(permitted)
        if permitted is None or isinstance(permitted, Fault):
            return self._law.rest(now_s)
        starts = not self._relays.closed and run.direction is not Direction.OFF and self._law.start_s(now_s) > 0.0
        if (self._gate.waiting or starts) and isinstance(self._goal, JogGoal):
            self._goal = self._goal.put_off(past_s)
        return permitted

    def sweep(self, now_s: float, command: Command | None) -> Range:
        if self.missing or lost(self.fault):
            return UNKNOWN
        run = command if isinstance(command, Run) else None
        swept = self._reach.swept(now_s, self._sensing, self._law.motion, self._relays, run)
        return swept.widened(self._condition.error_deg or 0.0)

    @property
    def stopping_room_deg(self) -> float:
        return self._reach.stopping_room_deg(self._law.motion)

    @property
    def position_error_deg(self) -> float:
        return self._condition.error_deg or POSITION_ERROR_DEG

    def hold_back(self, now_s: float, why: str) -> None:
        self._law.rest(now_s)
        if self.aiming and not self._condition.lost:
            self._goal = self.aiming
        elif self.homing:
            self.fail(Fault(FaultKind.NOT_HOMED, self._settings.axis, why))
        if not isinstance(self._goal, AimGoal):
            self._goal = None

    def _wish(self, now_s: float) -> Run:
        """What the goal asks for."""
        if self._goal is None or now_s >= self._sensing.ridden_until_s:
            return self._law.rest(now_s)
        run = self._towards(now_s, self._goal)
        if self._sensing.believable:
            return run
        # A bad reading starts nothing, and what runs may go on for a moment, until the next good one.
        if run.direction is not self._relays.direction:
            return self._law.rest(now_s)
        return Run(run.direction, min(run.until_s, self._sensing.ridden_until_s))

    def _towards(self, now_s: float, goal: AimGoal | JogGoal | HomeGoal | SeekGoal) -> Run:
        angle_deg = None if self.missing else self._sensing.angle_deg
        match goal:
            case HomeGoal():
                return self._home(now_s, goal)
            case SeekGoal():
                raise AssertionError("relays find no end by themselves")
            case AimGoal() if self._homed_scale == self._scale:
                return self._law.rest(now_s)
            case AimGoal() if not self._ends.missing and (first := self._anew.first(goal, self._condition, angle_deg)):
                self._goal = first
                return self._home(now_s, first)
            case AimGoal():
                # Without the second condition a motor that stands near its target would be started several times a
                # second.
                waits = angle_deg is None or (not self._relays.closed and self._gate.watch.runs.settles(now_s))
                return self._law.rest(now_s) if waits else self._law.aim(now_s, goal, self._faults.attempts.limits)
            case JogGoal(_, until_s) if until_s is not None and now_s >= until_s:
                run = None
            case JogGoal(direction) if angle_deg is None:
                run = Run(direction, self._law.jog_until_s(now_s, goal))
            case JogGoal():
                run = self._law.jog(now_s, goal, angle_deg, self._faults.attempts.limits)
        if run is None:
            self._goal = None
        return run or self._law.rest(now_s)

    def _home(self, now_s: float, goal: HomeGoal) -> Run:
        homing = goal.homing
        direction = homing.step(now_s, self._relays.direction, self._condition)
        if homing.failure:
            self._goal = None
            self.fail(Fault(FaultKind.NOT_HOMED, self._settings.axis, homing.failure))
        return self._law.drive(now_s, direction)

    def calibrate_end(self, *, high_end: bool) -> None:
        if self._settings.limits.endless:
            raise Refused(f"{self._settings.axis.value} has no ends")
        raw = self._sensing.raw if self._sensing.believable else None
        try:
            calibration = self._ends.take(raw, self._sensing.calibration, high_end=high_end)
        except ValueError as reason:
            raise Refused(f"{self._settings.axis.value} keeps its calibration: {reason}") from reason
        if calibration is not None:
            self._begin_anew(calibration)

    def _begin_anew(self, calibration: Calibration | None) -> None:
        """The readings mean other places than before. Only a motor that counts keeps what it has learnt."""
        self._sensing.begin_anew(calibration)
        self._seen_turning.driven()
        self._faults.attempts.forget()
        motors = self._law.motion.motors if self.homeable else dict.fromkeys(BOTH_WAYS, self._settings.motor)
        self._law = self._law.renewed(motors)
        self._gate.watch.rescale(self._law.motion.motors, placed=self._placed)

    def shortened(self, now_s: float, command: Steer) -> None:
        """Relays are not steered."""

    def note_driven(self, now_s: float, driven: Direction) -> None:
        was, self._relays = self._relays, self._relays.changed(now_s, driven)
        self._law.note_relays(now_s, self._relays)
        if self._rocked and not self._relays.closed:
            self._law.forget_run()
            self._rocked = False
        self._permit.note_relays(now_s, self._relays)
        if self.moving(now_s):
            self._seen_turning.driven()
        if self._relays != was:
            self._faults.note_relays(self._relays)
        self._gate.watch.runs.note_pace(self._law.throttle.share)

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        calibration = self._sensing.calibration
        return self._status(
            now_s,
            starts,
            error_deg=self._condition.error_deg,
            fault_present=self._faults.attempts.present,
            drive=self._relays.direction,
            noise_deg=self._gate.watch.noise_deg,
            notices=self._notices(now_s) + more,
            tries=self._faults.tries(now_s),
            calibration=calibration.points if calibration else None,
            learnt=self._law.learnt,
            trusts=self._gate.watch.trusts,
            waiting=self._gate.waiting,
        )

    def _notices(self, now_s: float) -> tuple[Notice, ...]:
        vain = IN_VAIN if self.pressed_in_vain else None
        more = (self._condition.notice, self._sensing.notice, self._permit.notice, vain, self._blind)
        return (*self._faults.notices(now_s), *(notice for notice in more if notice is not None))

    @property
    def _placed(self) -> bool:
        """Whether the readings of the axis are angles, and its limits known."""
        return self._sensing.calibration is not None and Missing.LIMITS not in self.missing
