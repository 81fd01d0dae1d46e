"""Failed runs of a motor: the fault, who may try again, and where the axis stopped.

Knows the axis's latest faults, its runs in vain, and the places at which it stood still. Finds no fault, and stops
nothing.
"""

from __future__ import annotations

from hw.ports import Axis
from rotator.control.axis.fault_latch import FaultLatch
from rotator.control.axis.met_stops import MetStops
from rotator.control.axis.relay_gate import RelayGate
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.vain_runs import STANDING_FAULTS
from rotator.control.sky.mount import Range
from rotator.exchange.faults import LATE, POT, Fault, FaultKind, Notice
from rotator.exchange.motor import NO_TRIES, Tries


class Attempts:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time.

    `before`: what earlier runs of the program have tried.
    """

    def __init__(self, axis: Axis, limits: Range, gate: RelayGate, sensor: str = POT, before: Tries = NO_TRIES) -> None:
        fault = Fault(before.kind or FaultKind.STANDS_STILL, axis, "")
        self._faults = FaultLatch(sensor, before=fault, tries=before.faults)
        self._gate = gate
        self._stops = MetStops(axis, limits, before)
        self._now_s = 0.0
        self._angle_deg: float | None = None
        self._relays = RelayState()

    @property
    def fault(self) -> Fault | None:
        """What stopped the axis; None: it may be driven."""
        return self._faults.fault

    @property
    def present(self) -> bool:
        """As for FaultLatch."""
        return self._faults.present

    @property
    def limits(self) -> Range:
        """How far the axis may turn now."""
        return self._stops.limits

    @property
    def notices(self) -> tuple[Notice, ...]:
        return self._stops.notices

    def tries(self, now_s: float, *, pressed: bool = False, driven: bool = False) -> Tries:
        """What the next run of the program has to know. `pressed`, `driven`: those of `Tries`."""
        faults = self._faults.tries(now_s)
        kind = self._faults.kind if faults else None
        return Tries(faults, kind, self._stops.stood_deg, self._stops.stops_deg, pressed, driven)

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        self._relays = relays

    def see(self, angle_deg: float) -> None:
        """A good reading."""
        self._angle_deg = angle_deg

    def note(self, found: Fault | None, now_s: float, *, cause: Fault | None, in_order: bool = False) -> bool:
        """Note what is wrong now; `cause`: the part that is still present. Returns whether a new fault is kept.

        `in_order`: as for FaultLatch.
        """
        self._now_s = now_s
        tries = self._tries(found)
        return self._struck(self._faults.note(found, now_s, cause=cause, tries=tries, in_order=in_order))

    def fail(self, fault: Fault) -> bool:
        """The axis is stopped by this fault. Returns whether it is kept."""
        return self._struck(self._faults.fail(fault, self._now_s, tries=self._tries(fault)))

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        """End the fault, unless only a person may end it. Returns whether it has been acknowledged."""
        if not self._faults.acknowledge(now_s, by_person=by_person):
            return False
        if by_person:
            self.forget()
        return True

    def forget(self) -> None:
        """A person has looked, or the readings mean other places than before."""
        self._gate.watch.runs.forget()
        self._stops.forget()

    def _tries(self, found: Fault | None) -> int:
        """How often the motor was on in vain before this fault: it runs now, or its last runs were in vain."""
        runs = int(self._relays.closed)
        if found is None or found.kind not in {*STANDING_FAULTS, FaultKind.WRONG_WAY}:
            return runs
        return max(1, runs + self._gate.watch.runs.tries)

    def _struck(self, new: bool) -> bool:
        # A lateness says nothing of the motor: its runs until then still count.
        if new and self.fault is not None and self.fault.kind not in LATE:
            self._gate.watch.runs.struck(self.fault.kind)
            if self.fault.kind in STANDING_FAULTS and self._relays.last and self._angle_deg is not None:
                self._stops.stood_still(self.fault.kind, self._relays.last, self._angle_deg)
        return new
