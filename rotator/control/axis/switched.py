"""One axis whose motor is only on or off: its goal, its limits and its faults.

Knows whether its sensor can be believed and what its motor may do. Knows nothing of the sky, of the other axis, or of
who gave the order.
"""

from __future__ import annotations

import math

from hw.ports import AngleSource, Direction
from rotator.control.axis.axis_base import AxisBase
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.goals import HomeGoal, JogGoal
from rotator.control.axis.homing import Homing
from rotator.control.axis.reach import Reach, lost
from rotator.control.axis.readings import Reading
from rotator.control.axis.relay_gate import SETTLED_AFTER_S, RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.relay_trust import BOTH_WAYS
from rotator.control.axis.run_permit import RunPermit, at_ends
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.switched_faults import SwitchedFaults
from rotator.control.axis.switched_law import ANYWHERE, SwitchedLaw, Timing
from rotator.control.axis.vain_presses import IN_VAIN
from rotator.control.commands import UNFED, Command, Decision, Feed, Run, Steer
from rotator.control.refused import Refused, needs_no_homing
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
        # A count does not scatter, and it is corrected by as much as a pulse at once. In a calibration the sensor's
        # scale and the motor's speed are not known yet, and the person is to hear of every spark.
        unjudged = settings.source is AngleSource.COUNTED or (settings.attended and settings.calibration is None)
        super().__init__(settings, math.inf if unjudged else settings.motor.speed_dps)
        motors = dict(zip(BOTH_WAYS, settings.learnt or (settings.motor, settings.motor), strict=True))
        rests_deg = settings.homing.rest_deg if settings.homing else ANYWHERE
        self._law = SwitchedLaw(motors, Timing(lease_s=lease_s, period_s=period_s), rests_deg)
        self._gate = RelayGate(settings, self._law.motion.motors, lease_s=lease_s, placed=self._placed)
        self._permit = RunPermit(settings, self._gate, lease_s=lease_s)
        self._faults = SwitchedFaults(settings, self._gate)
        self._reach = Reach(settings)
        self._relays = RelayState()
        self._scale: int | None = None
        """The scale of the latest reading; None: there was no reading yet."""
        self._blind = BLIND if settings.window.blind else None
        self._decided_s: float | None = None
        """When the axis decided last. An order makes it decide again between two cycles."""

    @property
    def speed_dps(self) -> float:
        """The slower direction, as learnt."""
        return min(motor.speed_dps for motor in self._law.motion.motors.values())

    @property
    def fault(self) -> Fault | None:
        return self._faults.fault

    @property
    def driven(self) -> bool:
        return self._relays.closed

    @property
    def pressed_in_vain(self) -> bool:
        return self._sensing.calibration is None and self._faults.vain_presses

    @property
    def confirmable(self) -> bool:
        return self._settings.source is AngleSource.COUNTED

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

    def home(self) -> None:
        if self._settings.homing is None:
            raise Refused(needs_no_homing(self._settings.axis.value))
        self._goal, self._ordered = HomeGoal(Homing(self._settings.homing)), None

    def see(self, reading: Reading, now_s: float) -> None:
        scale, self._scale = self._scale, reading.condition.scale
        if scale is not None and scale != self._scale:
            self._begin_anew(self._sensing.calibration)
        unbelievable = self._sense(reading, now_s, self._gate.noise_deg)
        if self._sensing.calibration is not None:
            for at_s, angle_deg in self._sensing.places:
                self._law.see(at_s, angle_deg)
        if self._faults.look(reading, self._sensing, unbelievable, now_s, homing=self.homing):
            self._law.forget_run()

    def fail(self, fault: Fault) -> None:
        if self._faults.fail(fault):
            self._law.forget_run()

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        return self._faults.acknowledge(now_s, by_person=by_person)

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
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
        """The run, as far as it is permitted. `past_s`: since the cycle before."""
        unbounded = run.direction is Direction.OFF or self.missing or self.homing
        angle_deg = None if unbounded else self._sensing.angle_deg
        ends = () if angle_deg is None else at_ends(angle_deg, self._faults.limits)
        permitted = self._permit.permitted(run, now_s, past_s, ends=ends, switches=self._condition.ends)
        if isinstance(permitted, Fault):
            self.fail(permitted)
        if permitted is None or isinstance(permitted, Fault):
            return self._law.rest(now_s)
        if self._gate.waiting and isinstance(self._goal, JogGoal):
            self._goal = self._goal.put_off(past_s)
        return permitted

    def sweep(self, now_s: float, command: Command | None) -> Range:
        if self.missing or lost(self.fault):
            return UNKNOWN
        run = command if isinstance(command, Run) else None
        return self._reach.swept(now_s, self._sensing, self._law.motion, self._relays, run)

    @property
    def stopping_room_deg(self) -> float:
        return self._reach.stopping_room_deg(self._law.motion)

    @property
    def position_error_deg(self) -> float:
        return POSITION_ERROR_DEG

    def hold_back(self, now_s: float, why: str) -> None:
        self._law.rest(now_s)
        if self.homing:
            self.fail(Fault(FaultKind.NOT_HOMED, self._settings.axis, why))
        if not isinstance(self._goal, AimGoal):
            self._goal = None

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
        angle_deg = None if self.missing else self._sensing.angle_deg
        match goal:
            case HomeGoal(homing):
                return self._home(now_s, homing)
            case AimGoal():
                # Without the second condition a motor that stands near its target would be started several times a
                # second.
                waits = angle_deg is None or (not self._relays.closed and self._faults.settles(now_s))
                return self._law.rest(now_s) if waits else self._law.aim(now_s, goal, self._faults.limits)
            case JogGoal(_, until_s) if until_s is not None and now_s >= until_s:
                run = None
            case JogGoal(direction) if angle_deg is None:
                run = Run(direction, self._law.jog_until_s(now_s, goal))
            case JogGoal():
                run = self._law.jog(now_s, goal, angle_deg, self._faults.limits)
        if run is None:
            self._goal = None
        return run or self._law.rest(now_s)

    def _home(self, now_s: float, homing: Homing) -> Run:
        direction = homing.step(now_s, self._relays.direction, self._condition)
        if homing.failure:
            self._goal = None
            self.fail(Fault(FaultKind.NOT_HOMED, self._settings.axis, homing.failure))
        return self._law.drive(now_s, direction)

    def calibrate_end(self, *, high_end: bool) -> None:
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
        self._faults.forget()
        motors = self._law.motion.motors if self.homeable else dict.fromkeys(BOTH_WAYS, self._settings.motor)
        self._law = self._law.renewed(motors)
        self._gate.rescale(self._law.motion.motors, placed=self._placed)

    def shortened(self, now_s: float, command: Steer) -> None:
        """Relays are not steered."""

    def note_driven(self, now_s: float, driven: Direction) -> None:
        was, self._relays = self._relays, self._relays.changed(now_s, driven)
        self._law.note_relays(now_s, self._relays)
        self._permit.note_relays(now_s, self._relays)
        if self.moving(now_s):
            self._seen_turning.driven()
        if self._relays != was:
            self._faults.note_relays(self._relays, self._law.motion.motors[driven].speed_dps if driven else 0.0)

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        calibration = self._sensing.calibration
        return self._status(
            now_s,
            starts,
            drive=self._relays.direction,
            noise_deg=self._gate.noise_deg,
            notices=self._notices(now_s) + more,
            tries=self._faults.tries(now_s),
            calibration=calibration.points if calibration else None,
            learnt=self._law.learnt,
            trusts=self._gate.trusts,
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
