"""One axis whose motor goes to an angle by itself: its goal, its limits and its faults.

The sibling of `switched`; `positioned_law` says where the drive is sent. Knows nothing of the sky, of the other axis,
or of who gave the order. It does not know how the drive gets to an angle; it sees whether it does.
"""

from __future__ import annotations

import math
from dataclasses import replace

from hw.ports import AngleSource, Direction
from rotator.control.axis.axis_base import AxisBase
from rotator.control.axis.fault_latch import FaultLatch
from rotator.control.axis.goals import JogGoal, SeekGoal
from rotator.control.axis.held_watch import COASTS_S, HeldWatch
from rotator.control.axis.pace import Pace
from rotator.control.axis.positioned_law import PositionedLaw, Sent
from rotator.control.axis.reach import LOST_AFTER_S, lost
from rotator.control.axis.readings import Reading
from rotator.control.axis.relay_faults import limit_reached, unstoppable
from rotator.control.axis.settings import PositionedSettings
from rotator.control.axis.stray_watch import SERVO_STRAY_DEG, STRAY_DEG, StrayWatch
from rotator.control.axis.trend import Trend
from rotator.control.commands import HOLD, Command, Decision, Seek, Steer
from rotator.control.refused import Refused, no_homing
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.control.sky.plan import Path
from rotator.control.sky.sectors import UNKNOWN
from rotator.exchange.faults import LATE, Fault, FaultKind, Missing, Notice
from rotator.exchange.motor import Tries
from rotator.exchange.status import AxisStatus


class PositionedAxis(AxisBase[PositionedSettings]):
    """The kind of `ControlledAxis` for drives that take an angle."""

    def __init__(self, settings: PositionedSettings, *, lease_s: float) -> None:
        # A model jumps where it is corrected, and it does not scatter.
        super().__init__(settings, settings.speed_dps if settings.source is AngleSource.MEASURED else math.inf)
        self._lease_s = lease_s
        self._faults = _latch(settings)
        servo = settings.accel_dps2 is not None and settings.source is not AngleSource.MODELLED
        self._stray = StrayWatch(
            settings.axis,
            settings.speed_dps,
            settings.accel_dps2,
            rest_s=settings.reversal_rest_s,
            near_deg=settings.near_deg,
            stray_deg=SERVO_STRAY_DEG if servo else STRAY_DEG,
        )
        self._ordered_s = -math.inf
        """When it was last sent somewhere."""
        self._held = HeldWatch(settings.axis, settings.speed_dps, master=settings.master)
        self._seen_s = 0.0
        """The moment of the present cycle."""
        self._readings = Trend()
        self._pace = Pace(settings)
        self._law = PositionedLaw(settings, self._pace.braking_deg(settings.speed_dps), lease_s)
        self._sent: Sent | None = None
        """Where the drive was sent last; None: it holds."""

    @property
    def speed_dps(self) -> float:
        return self._settings.speed_dps

    @property
    def fault(self) -> Fault | None:
        return self._faults.fault

    @property
    def driven(self) -> bool:
        return self._drive is not Direction.OFF

    @property
    def confirmable(self) -> bool:
        return self._settings.confirmable

    @property
    def homeable(self) -> bool:
        return self._settings.homes

    @property
    def homing(self) -> bool:
        return isinstance(self._goal, SeekGoal)

    def moving(self, now_s: float) -> bool:
        return self.driven

    def home(self) -> None:
        if not self.homeable:
            raise Refused(no_homing(self._settings.axis.value, lost=Missing.HOMING in self.missing))
        self._goal, self._ordered = SeekGoal(self._condition.scale), None

    def calibrate_end(self, *, high_end: bool) -> None:
        raise Refused(f"{self._settings.axis.value} knows its own angles: it needs no ends")

    def checked(self) -> None:
        raise Refused(f"{self._settings.axis.value} has no relays: there is nothing to look at")

    def see(self, reading: Reading, now_s: float) -> None:
        self._seen_s = now_s
        if reading.condition.scale != self._condition.scale:
            self._sensing.begin_anew(self._sensing.calibration)
            self._seen_turning.driven()  # another angle, and no turn
        unbelievable = self._sense(reading, now_s, self._readings.noise_deg)
        for at_s, angle_deg in self._sensing.places if self._sensing.angle_deg is not None else ():
            self._readings.see(at_s, angle_deg, self._settings.speed_dps)
            self._pace.see(at_s, angle_deg)
        # The rotor's own report says more than the watches here can see.
        reported = reading.condition.fault
        cause = unbelievable if reading.condition.latched else reported or unbelievable
        found = reported or unbelievable or self._turning(now_s) or self._straying(now_s)
        strays = found is not None and found.kind is FaultKind.NOT_FOLLOWING
        if found is not None and strays and self._settings.master:
            # A control box that does not follow may be deaf: then a stop does not reach it either.
            found = unstoppable(found, master=True)
        # A move that was too short to show anything counts with the one that shows it.
        tries = int(self.driven) + (self._stray.tries if strays else 0)
        if self._faults.note(found, now_s, cause=cause, tries=tries, in_order=self._sensing.believable):
            assert self.fault is not None
            # A lateness says nothing of the motor: its moves until then still count.
            if self.fault.kind not in LATE:
                self._stray.struck()

    def _turning(self, now_s: float) -> Fault | None:
        """The fault of an axis that turns while it must hold. A model shows none; wind turns an axis that is let go."""
        if not self._settings.own_motor or self._settings.source is not AngleSource.MEASURED:
            return None
        return self._held.see(now_s, self._readings, self._sensing.angle_deg, holds=self._sent is None)

    def _straying(self, now_s: float) -> Fault | None:
        steer = self._sent.steer if self._sent and not self._condition.waits else None
        noise_deg = self._readings.noise_deg if self._settings.source is AngleSource.MEASURED else 0.0
        return self._stray.see(now_s, steer, self._sensing.angle_deg, noise_deg, settling=self._condition.settling)

    def fail(self, fault: Fault) -> None:
        self._faults.fail(fault, self._seen_s, tries=int(self.driven))

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        if self.fault is not None:
            self._stray.clear()
        return self._faults.acknowledge(now_s, by_person=by_person)

    def decide(self, now_s: float) -> Decision:
        if isinstance(self._goal, SeekGoal):
            self._sent = None
            if self.fault is None and self._goal.scale == self._condition.scale:
                return Decision(Seek(now_s + self._lease_s))
            self._goal = None
        steer = self._wish(now_s)
        if steer is not None and (blocked := self._blocked(steer)):
            self.fail(limit_reached(self._settings.axis, blocked))
            self._goal, steer = None, None
        if steer is None:
            self._sent = None
            return Decision(HOLD)
        self._sent = Sent(steer, now_s, self._goal.direction if isinstance(self._goal, JogGoal) else Direction.OFF)
        if steer.rate_dps == 0.0:
            self._pace.sent(now_s, steer.angle_deg)
        else:
            self._pace.moves_on()
        return Decision(steer)

    def _wish(self, now_s: float) -> Steer | None:
        """Where the goal sends the axis; None: the axis is to hold. A fault ends the goal."""
        if self.fault is not None:
            self._goal = None
        # A bad reading starts nothing. What moves may go on for a moment, until the next good one.
        trusted = self._sensing.believable or self._sent is not None
        until_s = min(now_s + self._lease_s, self._sensing.ridden_until_s)
        if self._goal is None or not trusted or self._sensing.angle_deg is None or until_s <= now_s:
            return None
        match self._goal:
            case AimGoal() if self.missing:
                return None
            case AimGoal(_, _, Path() as path):
                return self._law.follow(now_s, path, until_s)
            case AimGoal(target_deg, _, _):
                return self._law.aim(target_deg, until_s)
            case JogGoal() as jog:
                steer = self._jog(now_s, self._sensing.angle_deg, jog, until_s)
                self._goal = None if steer is None else jog
                return steer
            case _:
                raise AssertionError("it has no end stop to find")

    def _jog(self, now_s: float, angle_deg: float, jog: JogGoal, until_s: float) -> Steer | None:
        """Where a jog sends the axis; None: the jog is over."""
        if jog.until_s is not None and now_s >= jog.until_s:
            return None
        if jog.end_deg is not None:
            return self._law.jog_to(jog.end_deg, angle_deg, until_s)
        settling, lost = self._condition.settling, bool(self._condition.lost)
        return self._law.jog(now_s, angle_deg, jog.direction, until_s, self._sent, settling=settling, lost=lost)

    def _blocked(self, steer: Steer) -> Direction | None:
        """The direction of the command, where a limit switch forbids it."""
        assert self._sensing.angle_deg is not None, "an axis is steered only where its angle is known"
        return self._law.blocked(steer, self._sensing.angle_deg, self._condition.ends)

    def sweep(self, now_s: float, command: Command | None) -> Range:
        if self.missing or now_s - self._sensing.believed_s > LOST_AFTER_S or lost(self.fault):
            return UNKNOWN
        span = self._pace.span(now_s)
        if isinstance(command, Seek):
            return span.spanning(self._settings.limits.min_deg)
        if not isinstance(command, Steer):
            return span
        # The axis comes to rest at the place of its last command, and moves on while that command holds.
        on_deg = abs(command.rate_dps) * (command.until_s - now_s) + self._pace.braking_deg(command.rate_dps)
        end_deg = command.angle_deg + math.copysign(on_deg, command.rate_dps)
        near_deg = self._settings.near_deg
        return span.spanning(min(command.angle_deg, end_deg) - near_deg).spanning(
            max(command.angle_deg, end_deg) + near_deg
        )

    @property
    def stopping_room_deg(self) -> float:
        return 2.0 * self._settings.near_deg

    @property
    def position_error_deg(self) -> float:
        return 1.1 * self._settings.near_deg

    def hold_back(self, now_s: float, why: str) -> None:
        self._sent = None
        if self.homing:
            self.fail(Fault(FaultKind.NOT_HOMED, self._settings.axis, why))
        if isinstance(self._goal, JogGoal | SeekGoal):
            self._goal = None

    def shortened(self, now_s: float, command: Steer) -> None:
        jog = self._sent.jog if self._sent else Direction.OFF
        self._sent = Sent(command, now_s, jog)
        self._pace.sent(now_s, command.angle_deg)
        if isinstance(self._goal, JogGoal):
            self._goal = replace(self._goal, end_deg=command.angle_deg)

    def note_driven(self, now_s: float, driven: Direction) -> None:
        if self.homing or self._sent is not None:
            self._ordered_s = now_s
        if now_s - self._ordered_s <= COASTS_S:
            self._seen_turning.driven()

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        notices = (*(each for each in (self._condition.notice, self._sensing.notice) if each), *more)
        faults = self._faults.tries(now_s)
        measured = self._settings.source is AngleSource.MEASURED
        in_vain = measured and self.fault is None and self._stray.in_vain
        tries = Tries(faults, self._faults.kind if faults else None, driven=in_vain)
        return self._status(
            now_s,
            starts,
            drive=self._drive,
            noise_deg=self._readings.noise_deg,
            notices=notices,
            tries=tries,
            fault_present=self._faults.present,
        )

    @property
    def _drive(self) -> Direction:
        """The direction in which the drive turns it to where it was sent; OFF: it is there, or it holds."""
        if self.homing:
            return Direction.MINUS
        return self._law.towards(self._sent.steer, self._sensing.angle_deg) if self._sent else Direction.OFF


def _latch(settings: PositionedSettings) -> FaultLatch:
    """The latch of faults, with the fault of an earlier run of the program that tried the motor too often."""
    before = Fault(settings.tries.kind or FaultKind.NOT_FOLLOWING, settings.axis, "")
    if before.kind is FaultKind.NOT_FOLLOWING and settings.master:
        before = unstoppable(before, master=True)
    return FaultLatch(settings.sensor, before=before, tries=settings.tries.faults)
