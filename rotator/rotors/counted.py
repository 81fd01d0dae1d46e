"""Motors on relays, each with a contact that is counted: rotors of the Alliance U-100 kind.

Knows when a count is kept, when it is lost, and that a motor starts only after the file marks its axis as moving. The
counting itself is in `hw.sensors.pulses`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping

from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, AngleSource, Axis, Direction
from hw.sensors.pulses import PulseCounter
from rotator.control.axis.run_watch import unstoppable
from rotator.control.axis.sensing import Condition
from rotator.control.commands import Command, Errand, Place, Run
from rotator.control.sky.offsets import Offsets
from rotator.faults import Fault, FaultKind
from rotator.rotors.common import Ends, no_switches
from rotator.rotors.counts_writer import CountsWriter
from rotator.rotors.relays import RelayRotor
from rotator.store import counts

KEEP_EVERY_S = 0.5
"""How often the place of a resting axis goes to the file, which decides when that is worth a write."""


class CountedAxis:
    """A counter as a sensor that reads degrees. Two threads use it: one reads, one places.

    `master`: an output switches the motors' supply.
    """

    source = AngleSource.COUNTED

    def __init__(
        self,
        axis: Axis,
        counter: PulseCounter,
        counts_writer: CountsWriter | None,
        clock: Callable[[], float],
        *,
        master: bool = False,
    ) -> None:
        self._axis = axis
        self._counter = counter
        self._counts_writer = counts_writer
        self._clock = clock
        self._master = master
        self._lock = threading.Lock()
        self._scale = 0
        self._doubt = ""
        """Why the kept count is not believed; the trouble of the counter comes beside it."""
        self._told_s = 0.0
        self._lost = False

    def begin(self, kept: counts.Place) -> None:
        """Start from the count that the last run kept."""
        match kept.standing:
            case counts.Standing.KNOWN:
                self._place(kept.angle_deg)
            case counts.Standing.NEVER:
                self._doubt = "not done yet"
            case _:
                self._doubt = "the program ended in mid-move, or its count was in doubt"

    def read(self) -> float:
        with self._lock:
            angle_deg = self._counter.read()
            self._keep(angle_deg)
            return angle_deg

    def condition(self, ends: frozenset[Direction]) -> Condition:
        with self._lock:
            why = self._doubt or self._counter.trouble
            return Condition(
                fault=self._fault(),
                lost=why,
                scale=self._scale,
                changes=self._counter.changes,
                ends=ends,
            )

    @property
    def closed(self) -> bool:
        """Whether its contact is closed now. Raises HardwareError."""
        return self._counter.closed

    def may_start(self) -> bool:
        """Whether its motor may be switched on now."""
        return self._counts_writer is None or self._counts_writer.may_start(self._axis)

    def place(self, angle_deg: float) -> None:
        """The axis stands at this angle of the rotor's own scale: at its end stop, or confirmed by a user.

        Raises HardwareError.
        """
        with self._lock:
            self._place(angle_deg)
            if self._counts_writer and not self._counter.trouble:
                self._counts_writer.homed(self._axis, angle_deg)

    def _place(self, angle_deg: float) -> None:
        self._counter.place(angle_deg)
        self._doubt, self._lost = "", False
        self._scale += 1

    def _fault(self) -> Fault | None:
        unkept = self._counts_writer.trouble(self._axis) if self._counts_writer else ""
        if unkept:
            return Fault(FaultKind.COUNT_NOT_KEPT, self._axis, f"it does not move: {unkept}", passing=True)
        if self._counter.turning:
            measured = "its contact opens and closes as if its motor ran"
            return unstoppable(FaultKind.TURNS_BY_ITSELF, self._axis, measured, "", master=self._master)
        if self._counter.quiet:
            return Fault(FaultKind.NO_PULSES, self._axis, "driven for three periods, and its contact did not change")
        return None

    def _keep(self, angle_deg: float) -> None:
        if self._counts_writer is None or self._doubt:
            return
        if self._counter.trouble:
            if not self._lost:
                self._counts_writer.lost(self._axis)
            self._lost = True
            return
        now_s = self._clock()
        if self._counter.at_rest and now_s - self._told_s >= KEEP_EVERY_S:
            self._told_s = now_s
            self._counts_writer.rests(now_s, self._axis, angle_deg)


class CountedRotor(RelayRotor):
    """`axes`: those that count; another axis may have a sensor."""

    def __init__(
        self,
        bank: RelayBank,
        sensors: Mapping[Axis, AngleSensor],
        axes: Mapping[Axis, CountedAxis],
        shift: Offsets,
        *,
        ends: Ends = no_switches,
        counts_writer: CountsWriter | None = None,
    ) -> None:
        super().__init__(bank, sensors, ends)
        self._axes = axes
        self._shift = shift
        self._counts_writer = counts_writer

    def condition(self, axis: Axis) -> Condition:
        if axis not in self._axes:
            return super().condition(axis)
        return self._axes[axis].condition(self._ends(axis))

    def obey(self, axis: Axis, command: Command) -> Direction:
        assert isinstance(command, Run), "relays know directions only"
        starts = command.direction is not Direction.OFF and self.bank.driven()[axis] is Direction.OFF
        if starts and axis in self._axes and not self._axes[axis].may_start():
            return Direction.OFF
        return super().obey(axis, command)

    def run(self, errand: Errand) -> None:
        match errand:
            case Place(axis, angle_deg) if axis in self._axes:
                self._axes[axis].place(angle_deg - self._shift.of(axis))
            case _:
                super().run(errand)

    def closed_contacts(self) -> frozenset[Axis]:
        return frozenset(axis for axis, each in self._axes.items() if each.closed)

    def close(self) -> None:
        try:
            super().close()
        finally:
            if self._counts_writer:
                self._counts_writer.close()
