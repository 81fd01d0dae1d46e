"""What is wrong with a switched axis: by its readings, by the rotor's reports, and by runs that did not move it.

Knows the watches that find faults, and the latch that keeps one. Does not stop the motor.
"""

from __future__ import annotations

from dataclasses import replace

from hw.ports import AngleSource, Direction
from rotator.control.axis.attempts import Attempts
from rotator.control.axis.motion_watch import TURNS
from rotator.control.axis.readings import Reading
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.commands import Run
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.motor import ALL_OPEN, Tries

ROCK_S = 0.5
"""The length of the run the other way."""
GIVES_UP_S = 4.0
"""A run that could not begin for so long, at a limit for example, is left out."""


class Rock:
    """The rock of an axis whose wedge brake sticks: once, a short run the other way, so that the wedge comes free.

    Does not know why the axis stands, nor whether a run is permitted.
    """

    def __init__(self, *, wanted: bool) -> None:
        self._wanted = wanted
        self._spent = False
        self._way = self._way_tried = Direction.OFF
        """The way of the run that is to come or goes on, OFF: there is none; and of the latest one."""
        self._from_s = 0.0

    @property
    def may_begin(self) -> bool:
        """Whether the operator wants it, and it was not tried since the axis turned or a person looked."""
        return self._wanted and not self._spent

    def begin(self, now_s: float, stood: Direction) -> None:
        """The motor ran in this direction, and the axis stood."""
        self._spent, self._from_s = True, now_s
        self._way = self._way_tried = Direction(-stood)

    def renew(self) -> None:
        """A person has looked: the next wedge that sticks gets its own try."""
        self._spent = False

    def turned(self, way: Direction) -> None:
        """Driven in this direction the axis turns: if it is the one in which it stood, the try has helped."""
        self._spent = self._spent and way is self._way_tried

    def end(self) -> None:
        self._way = Direction.OFF

    def run(self, now_s: float, relays: RelayState, lease_s: float) -> Run | None:
        """The run the other way; None: it is over, or there is none."""
        begun = relays.last is self._way and relays.begun_s >= self._from_s
        until_s = relays.begun_s + ROCK_S if begun else now_s + ROCK_S
        if self._way is Direction.OFF or now_s >= until_s or now_s >= self._from_s + GIVES_UP_S:
            self.end()
            return None
        return Run(self._way, min(now_s + lease_s, until_s))


WHY_IT_TURNS = (FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF)
"""Faults that say more than the notice TURNS."""


class SwitchedFaults:
    """Give it every reading (`look`) and every change of the relays (`note_relays`), in order of time."""

    def __init__(self, settings: SwitchedSettings, gate: RelayGate) -> None:
        self._axis = settings.axis
        self._counts = settings.source is AngleSource.COUNTED
        self._gate = gate
        self.attempts = Attempts(settings.axis, settings.limits, gate, settings.sensor, settings.tries)
        self._brake = settings.brake
        self._relays = RelayState()
        self.rock = Rock(wanted=self._brake is not None and self._brake.rock)
        gate.watch.runs.forget(pressed=settings.tries.pressed)
        self._calibrated = settings.calibration is not None
        self._changes: int | None = None
        """The changes of the counting contact, by the latest reading; None: there was no reading yet."""
        self._silent = False
        """The contact has not changed since the latest run began."""
        self._astray: Fault | None = None
        """What is wrong with the motion, by the latest reading."""
        self._lost: str | None = None
        """Why the count was lost, by the latest reading; None: there was no reading yet."""

    def look(
        self,
        reading: Reading,
        sensing: Sensing,
        unbelievable: Fault | None,
        now_s: float,
        *,
        homing: bool,
        aiming: bool = False,
    ) -> bool:
        """Find what the latest reading shows. Returns whether a new fault is kept.

        `unbelievable`: what is wrong with the sensor itself.
        """
        self._calibrated = sensing.calibration is not None
        self._silent = self._silent and not homing and reading.condition.changes == self._changes
        self._changes = reading.condition.changes
        watch = self._gate.watch
        for at_s, angle_deg in sensing.places:
            found = self._by_brake(watch.see(at_s, angle_deg, reading.condition))
            found = None if self._rocks(found, now_s, aiming=aiming) else found
            if sensing.calibration is not None:
                self.attempts.see(angle_deg)
            self._astray = None if homing else found
        # The rotor's own report says more than the watches here can see.
        reported, present = (
            self._by_brake(reading.condition.fault),
            self._gate.blind(unbelievable, now_s) or self._astray,
        )
        cause = present if reading.condition.latched else reported or present
        if homing and reported and not reported.cut:
            # At its end stop missing pulses are normal. A motor that turns by itself is still a fault.
            reported = None
        lost = None if homing else self._newly_lost(reading.condition.lost)
        self._lost = reading.condition.lost
        in_order = sensing.believable and not homing and watch.trusts == ALL_OPEN
        return self.attempts.note(reported or present or lost, now_s, cause=cause, in_order=in_order)

    def _by_brake(self, fault: Fault | None) -> Fault | None:
        """The same fault; where an axis with a brake has not turned since its start, the brake is the first suspect."""
        if fault is None or self._brake is None or fault.kind not in (FaultKind.STANDS_STILL, FaultKind.NO_PULSES):
            return fault
        at_start = self._silent if self._counts else self._gate.watch.runs.in_vain
        return replace(fault, kind=FaultKind.BRAKE_HELD) if at_start else fault

    def _rocks(self, fault: Fault | None, now_s: float, *, aiming: bool) -> bool:
        """Whether the wedge gets a try in place of this fault."""
        watch = self._gate.watch
        if self._relays.closed and not watch.runs.in_vain:
            self.rock.turned(self._relays.direction)
        if fault is None or fault.kind is not FaultKind.BRAKE_HELD or not (aiming and self.rock.may_begin):
            return False
        # The relay that was closed cannot be seen to open while a wedge holds the axis. Who asks for the rock accepts
        # that its opposite closes then.
        watch.checked()
        watch.runs.forget()
        self.rock.begin(now_s, self._relays.last)
        return True

    def _newly_lost(self, why: str) -> Fault | None:
        """The fault of a count that has just been lost. A count that is lost from the start is no fault."""
        if not why or self._lost != "":
            return None
        return Fault(FaultKind.COUNT_LOST, self._axis, f"homing ({why})")

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        """Returns whether the fault is acknowledged."""
        acknowledged = self.attempts.acknowledge(now_s, by_person=by_person)
        if acknowledged:
            if by_person:
                self.rock.renew()
            self._gate.watch.acknowledge()
        return acknowledged

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        self._relays = relays
        self._gate.note_relays(relays)
        self.attempts.note_relays(relays)
        self._silent = self._silent or relays.closed

    def tries(self, now_s: float) -> Tries:
        """What the next run of the program has to know."""
        if self._counts:
            return self.attempts.tries(now_s, driven=self._silent and self.attempts.fault is None)
        if self._calibrated:
            in_vain = self._gate.watch.runs.in_vain and self.attempts.fault is None
            return self.attempts.tries(now_s, driven=in_vain)
        return self.attempts.tries(now_s, pressed=self._gate.watch.runs.pressed)

    def notices(self, now_s: float) -> tuple[Notice, ...]:
        """What a person should know of its motion though it stops nothing."""
        fault, notices = self.attempts.fault, self._gate.notices(now_s)
        if fault is not None and fault.kind in WHY_IT_TURNS:
            notices = tuple(notice for notice in notices if notice != TURNS)
        return notices + self.attempts.notices
