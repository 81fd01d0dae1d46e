"""What is wrong with a switched axis: by its readings, by the rotor's reports, and by runs that did not move it.

Knows the watches that find faults, and the latch that keeps one. Does not stop the motor.
"""

from __future__ import annotations

from rotator.control.axis.attempts import Attempts
from rotator.control.axis.readings import Reading
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.sensing import Sensing
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.vain_presses import VainPresses
from rotator.control.axis.weld_watch import TURNS
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.motor import ALL_OPEN, Tries

WHY_IT_TURNS = (FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF)
"""Faults that say more than the notice TURNS."""


class SwitchedFaults:
    """Give it every reading (`look`) and every change of the relays (`note_relays`), in order of time."""

    def __init__(self, settings: SwitchedSettings, gate: RelayGate) -> None:
        self._axis = settings.axis
        self._counts = settings.homing is not None
        self._gate = gate
        self._attempts = Attempts(settings.axis, settings.limits, settings.sensor, settings.tries)
        self._vain = VainPresses(before=settings.tries.pressed)
        self._calibrated = settings.calibration is not None
        self._changes: int | None = None
        """The changes of the counting contact, by the latest reading; None: there was no reading yet."""
        self._silent = False
        """The contact has not changed since the latest run began."""
        self._astray: Fault | None = None
        """What is wrong with the motion, by the latest reading."""
        self._lost: str | None = None
        """Why the count was lost, by the latest reading; None: there was no reading yet."""

    @property
    def fault(self) -> Fault | None:
        """What stopped the axis; None: it may be driven."""
        return self._attempts.fault

    @property
    def limits(self) -> Range:
        """How far the axis may turn now."""
        return self._attempts.limits

    def settles(self, now_s: float) -> bool:
        """Whether the readings may still show that the last run has moved the axis: a start now would be too soon."""
        return self._attempts.settles(now_s)

    @property
    def vain_presses(self) -> bool:
        """Whether presses without a calibration have failed to move the axis so often that a person has to look."""
        return self._vain.enough

    def look(
        self, reading: Reading, sensing: Sensing, unbelievable: Fault | None, now_s: float, *, homing: bool
    ) -> bool:
        """Find what the latest reading shows. Returns whether a new fault is kept.

        `unbelievable`: what is wrong with the sensor itself.
        """
        self._calibrated = sensing.calibration is not None
        self._silent = self._silent and not homing and reading.condition.changes == self._changes
        self._changes = reading.condition.changes
        for at_s, angle_deg in sensing.places:
            found = self._gate.see(at_s, angle_deg, reading.condition)
            if sensing.calibration is None:
                self._vain.see(at_s, angle_deg, self._gate.noise_deg)
            elif not self._counts:
                found = found or self._attempts.see(at_s, angle_deg, self._gate.noise_deg)
            self._astray = None if homing else found
        # The rotor's own report says more than the watches here can see.
        reported, present = reading.condition.fault, self._gate.blind(unbelievable, now_s) or self._astray
        cause = present if reading.condition.latched else reported or present
        if homing and reported and not reported.cut:
            # At its end stop missing pulses are normal. A motor that turns by itself is still a fault.
            reported = None
        lost = None if homing else self._newly_lost(reading.condition.lost)
        self._lost = reading.condition.lost
        in_order = sensing.believable and not homing and self._gate.trusts == ALL_OPEN
        return self._attempts.note(reported or present or lost, now_s, cause=cause, in_order=in_order)

    def _newly_lost(self, why: str) -> Fault | None:
        """The fault of a count that has just been lost. A count that is lost from the start is no fault."""
        if not why or self._lost != "":
            return None
        return Fault(FaultKind.COUNT_LOST, self._axis, f"homing ({why})")

    def fail(self, fault: Fault) -> bool:
        """The axis is stopped by this fault. Returns whether it is kept."""
        return self._attempts.fail(fault)

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        """Returns whether the fault is acknowledged."""
        if by_person:
            self._vain.forget()
        acknowledged = self._attempts.acknowledge(now_s, by_person=by_person)
        if acknowledged:
            self._gate.acknowledge()
        return acknowledged

    def forget(self) -> None:
        """The readings mean other places than before."""
        self._attempts.forget()

    def note_relays(self, relays: RelayState, speed_dps: float) -> None:
        """The relays have changed. `speed_dps`: of the motor that runs now; 0: none runs."""
        self._gate.note_relays(relays)
        self._attempts.note_relays(relays, speed_dps)
        self._vain.note_relays(relays)
        self._silent = self._silent or relays.closed

    def tries(self, now_s: float) -> Tries:
        """What the next run of the program has to know."""
        if self._counts:
            return self._attempts.tries(now_s, driven=self._silent and self.fault is None)
        if self._calibrated:
            return self._attempts.tries(now_s, driven=self._attempts.in_vain)
        return self._attempts.tries(now_s, pressed=self._vain.enough)

    def notices(self, now_s: float) -> tuple[Notice, ...]:
        """What a person should know of its motion though it stops nothing."""
        fault, notices = self.fault, self._gate.notices(now_s)
        if fault is not None and fault.kind in WHY_IT_TURNS:
            notices = tuple(notice for notice in notices if notice != TURNS)
        return notices + self._attempts.notices
