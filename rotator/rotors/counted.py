"""Motors on relays, with angles from counted contacts (rotors of the Alliance U-100 kind), or reckoned by time alone.

Knows when a count is stored, when it is lost, and that a motor starts only after the file marks its axis as moving.
Does not know how pulses or time are counted: `hw.sensors.pulses` and `hw.sensors.timed` do.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable, Mapping

from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, Axis, Direction, HardwareError
from hw.sensors.pulses import PulseCounter
from hw.sensors.quadrature import EncoderCounter
from hw.sensors.timed import TimedAngle
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_faults import unstoppable
from rotator.control.commands import Command, Errand, Place, Run
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind
from rotator.rotors.common import BlockedDirections, DriveT, GuardedRotor, no_switches
from rotator.rotors.counts_writer import CountsWriter
from rotator.rotors.relays import RelayRotor
from rotator.store import counts

log = logging.getLogger(__name__)

KEEP_EVERY_S = 0.5
"""Seconds between two further reports to the counts file: of a resting axis, or a lost count."""


class CountedAxis:
    """A counter of pulses or of time as an angle sensor, with the reason why its count may be wrong.

    Two threads use it: the sensor thread reads, and the control thread places. `master`: a relay switches the motors'
    supply. `within_deg`: the possible error of the angle after homing.
    """

    def __init__(
        self,
        axis: Axis,
        counter: PulseCounter | EncoderCounter | TimedAngle,
        counts_writer: CountsWriter | None,
        clock: Callable[[], float],
        *,
        master: bool = False,
        within_deg: float = 0.0,
    ) -> None:
        self.source = counter.source
        self._within_deg = within_deg
        self._axis = axis
        self._counter = counter
        self._counts_writer = counts_writer
        self._clock = clock
        self._master = master
        self._lock = threading.Lock()
        self._scale = 0
        self._doubt = ""
        """Why the stored count is not trusted. The counter's own reason is in its `trouble`."""
        self._reported_s = float("-inf")
        self._moved = False
        """Whether the axis has moved since its last angle at rest was reported."""
        self._reported_lost = False

    def begin(self, kept: counts.Place) -> None:
        """Start with the count that the last run stored."""
        match kept.standing:
            case counts.Standing.KNOWN if not self._counter.reaches(kept.angle_deg):
                self._doubt = f"its kept count of {kept.angle_deg:g}° is beyond its ends"
                log.warning("%s must be homed: %s", self._axis.value, self._doubt)
            case counts.Standing.KNOWN:
                self._place(kept.angle_deg)
                self._counter.travelled_deg = kept.travelled_deg
            case counts.Standing.NEVER:
                self._doubt = "not done yet"
            case _:
                self._doubt = "the program ended in mid-move, or its count was in doubt"

    def read(self) -> float:
        with self._lock:
            angle_deg = self._counter.read()
            self._keep(angle_deg)
            return angle_deg

    def condition(self, ends: frozenset[Direction], *, supplied: bool = True) -> Condition:
        """`ends`: the directions that a limit switch blocks now. `supplied`: the motors have their supply."""
        with self._lock:
            why, error_deg = self._doubt or self._counter.trouble, self._counter.error_deg
            return Condition(
                fault=self._fault(),
                lost=why,
                scale=self._scale,
                changes=self._counter.changes,
                closed=self._counter.in_closure,
                ends=ends,
                ahead=self._counter.ahead,
                supplied=supplied,
                error_deg=math.inf if why and error_deg is not None else error_deg,
                worn=self._counter.worn,
            )

    @property
    def closed(self) -> bool:
        """Whether the contact is closed now. Raises HardwareError."""
        return self._counter.closed

    @property
    def coasts(self) -> bool:
        """Whether the axis may still turn after its relays opened. Until now its count is right."""
        return self._moved and not self._doubt and not self._counter.trouble

    def start(self, close_relay: Callable[[], Direction]) -> Direction:
        """Start the motor if the file marks its axis as moving; OFF: ask again. Raises HardwareError.

        For the sensor thread mark and relay are one step: a reading between them would be stored as an angle at rest.
        """
        with self._lock:
            if self._counts_writer and not self._counts_writer.may_start(self._axis):
                return Direction.OFF
            moved, self._moved = self._moved, True  # also if the line fails: its relay may have closed
            way = close_relay()
            self._moved = moved or way is not Direction.OFF
            return way

    def place(self, angle_deg: float) -> None:
        """The axis stands at this angle of the rotor's own scale: at its end stop, or confirmed by a user.

        Raises HardwareError: its contact cannot be read. Then no angle is known, for the former one was to be wrong.
        """
        with self._lock:
            try:
                self._place(angle_deg, self._within_deg)
            except HardwareError:
                self._doubt = "its contact could not be read when its angle was given"
                if self._counts_writer:
                    self._counts_writer.lost(self._axis)
                raise
            if self._counts_writer and not self._counter.trouble:
                self._counts_writer.homed(self._axis, self._counter.read())

    def _place(self, angle_deg: float, within_deg: float = 0.0) -> None:
        self._counter.place(angle_deg, within_deg)
        self._doubt, self._reported_lost = "", False
        self._scale += 1

    def _fault(self) -> Fault | None:
        write_failure = self._counts_writer.trouble(self._axis, self._clock()) if self._counts_writer else ""
        if write_failure:
            return Fault(FaultKind.COUNT_NOT_KEPT, self._axis, f"it does not move: {write_failure}", passing=True)
        if self._counter.turning:
            measured = "its contact opens and closes as if its motor ran"
            return unstoppable(Fault(FaultKind.TURNS_BY_ITSELF, self._axis, measured), master=self._master)
        if self._counter.quiet:
            return Fault(FaultKind.NO_PULSES, self._axis, "its motor ran for three periods, the contact did not change")
        return None

    def _keep(self, angle_deg: float) -> None:
        if self._counts_writer is None or self._doubt:
            return
        now_s = self._clock()
        if self._counter.trouble:
            # Repeat it: a card may have refused the write, and the file must not keep a wrong angle.
            if not self._reported_lost or now_s - self._reported_s >= KEEP_EVERY_S:
                self._reported_s, self._reported_lost = now_s, True
                self._counts_writer.lost(self._axis)
            return
        if self._counter.at_rest and (self._moved or now_s - self._reported_s >= KEEP_EVERY_S):
            self._reported_s, self._moved = now_s, False
            self._counts_writer.rests(self._axis, angle_deg, self._counter.travelled_deg)


class CountsKept(GuardedRotor[DriveT]):
    """A rotor with axes that count, and the file in which their counts are kept."""

    _axes: Mapping[Axis, CountedAxis]
    _counts_writer: CountsWriter | None

    def coasts(self) -> bool:
        return self._counts_writer is not None and any(axis.coasts for axis in self._axes.values())

    def close(self) -> None:
        try:
            super().close()
        finally:
            if self._counts_writer:
                self._counts_writer.close()


class CountedRotor(CountsKept[RelayBank], RelayRotor):
    """`axes`: the axes that count pulses or time. Another axis has only its sensor in `sensors`."""

    def __init__(
        self,
        bank: RelayBank,
        sensors: Mapping[Axis, AngleSensor],
        axes: Mapping[Axis, CountedAxis],
        shift: Offsets,
        *,
        ends: BlockedDirections = no_switches,
        counts_writer: CountsWriter | None = None,
    ) -> None:
        super().__init__(bank, sensors, ends)
        self._axes = axes
        self._shift = shift
        self._counts_writer = counts_writer

    def condition(self, axis: Axis) -> Condition:
        if axis not in self._axes:
            return super().condition(axis)
        return self._axes[axis].condition(self._ends(axis), supplied=self.bank.supplied)

    def obey(self, axis: Axis, command: Command) -> Direction:
        runs = isinstance(command, Run) and command.direction is not Direction.OFF
        starts = runs and self.driven(axis) is Direction.OFF
        obey = super().obey
        if starts and axis in self._axes:
            return self._axes[axis].start(lambda: obey(axis, command))
        return obey(axis, command)

    def run(self, errand: Errand) -> None:
        match errand:
            case Place(axis, angle_deg) if axis in self._axes:
                self._axes[axis].place(angle_deg - self._shift.deg(axis))
            case _:
                super().run(errand)

    def closed_contacts(self) -> frozenset[Axis]:
        return frozenset(axis for axis, each in self._axes.items() if each.closed)
