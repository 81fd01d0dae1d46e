"""Two steppers on chips with ramps, as the control loop sees them.

Knows their faults by name, when an axis has to be homed, and that its place is kept: a motor starts only after the file
marks its axis as moving. Does not know a chip: `hw.drives.stepper` does.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Mapping

from hw.drives.stepper import StepperDrive
from hw.drives.stepper_axis import Trouble
from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.commands import Acknowledge, Command, Errand, Place, Seek, Steer
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.rotors.common import BlockedDirections, no_switches
from rotator.rotors.counted import KEEP_EVERY_S
from rotator.rotors.counts_writer import CountsWriter
from rotator.rotors.positioned import PositionedRotor
from rotator.store.counts import Place as Kept
from rotator.store.counts import Standing

KINDS = {
    Trouble.STEPS_LOST: FaultKind.STEPS_LOST,
    Trouble.DRIVER: FaultKind.STEPPER_DRIVER,
    Trouble.HOMING: FaultKind.NOT_HOMED,
}
HOT = Notice("its chip is hot, and will switch its motor off: less current, or more air", "DRIVER HOT")
NOT_YET = float("-inf")
SPI_WIRES = "Check the chip's two supplies, and its wires to the Pi's SPI"


class StepperRotor(PositionedRotor[StepperDrive]):
    """`kept`: where each axis stood at the end of the last run. `writer`: keeps that; None: they stand there now.

    `homes`: the axes that have an end to find. `clock`: seconds.
    """

    def __init__(
        self,
        drive: StepperDrive,
        sensors: Mapping[Axis, AngleSensor],
        shift: Offsets,
        ends: BlockedDirections = no_switches,
        *,
        kept: Mapping[Axis, Kept],
        homes: Collection[Axis],
        clock: Callable[[], float],
        writer: CountsWriter | None = None,
    ) -> None:
        super().__init__(drive, sensors, shift, ends)
        self._homes = homes
        self._clock = clock
        self._writer = writer
        self._lock = threading.Lock()
        """From the mark in the file to the motor's start: between the two, no angle at rest may be written."""
        self._told: dict[Axis, tuple[float | None, int, str]] = dict.fromkeys(Axis, (None, 0, ""))
        """What was last written of each axis: where it rests, its scale, why its place is lost."""
        self._told_s = dict.fromkeys(Axis, NOT_YET)
        for axis, place in kept.items():
            match place.standing:
                case Standing.KNOWN:
                    drive.begin(axis, place.angle_deg, sure=writer is None)
                case Standing.NEVER:
                    drive.begin(axis, None, "not done yet")
                case _:
                    drive.begin(axis, None, "the program ended in mid-move, or its count was in doubt")

    def condition(self, axis: Axis) -> Condition:
        self._keep(axis)
        trouble = self._drive.trouble(axis)
        return Condition(
            fault=self._fault(axis),
            latched=trouble is not None,
            notice=HOT if self._drive.hot(axis) else None,
            lost=self._drive.lost(axis),
            scale=self._drive.scale(axis),
            ends=self._ends(axis),
        )

    def obey(self, axis: Axis, command: Command) -> Direction:
        with self._lock:
            match command:
                case Steer(angle_deg, 0.0) if self._drive.stands_at(axis, angle_deg - self._shift.deg(axis)):
                    self._drive.hold(axis)
                case Steer() | Seek() if self._writer and not self._writer.may_start(axis):
                    pass  # the next command asks again
                case Seek(until_s):
                    self._told_s[axis] = NOT_YET
                    self._drive.seek(axis, until_s)
                case Steer():
                    self._told_s[axis] = NOT_YET
                    return super().obey(axis, command)
                case _:
                    return super().obey(axis, command)
        return Direction.OFF

    def run(self, errand: Errand) -> None:
        match errand:
            case Acknowledge(axis) if self._drive.trouble(axis):
                self._drive.acknowledge(axis)
            case Place(axis, angle_deg):
                self._drive.confirm(axis, angle_deg - self._shift.deg(axis))
            case _:
                super().run(errand)

    def coasts(self) -> bool:
        return self._writer is not None and any(map(self._drive.runs, self.sensors))

    def close(self) -> None:
        try:
            super().close()
        finally:
            for axis in self.sensors:
                self._keep(axis)
            if self._writer:
                self._writer.close()

    def _fault(self, axis: Axis) -> Fault | None:
        if trouble := self._drive.trouble(axis):
            kind, text = trouble
            lost = FaultKind.COUNT_LOST if axis in self._homes else FaultKind.POSITION_UNKNOWN
            return Fault(KINDS.get(kind, lost), axis, text)
        if silent := self._drive.silent(axis):
            return Fault(FaultKind.CONTROLLER_SILENT, axis, silent, passing=True, advice=SPI_WIRES)
        if self._writer is None:
            return None
        why = self._writer.trouble(axis, self._clock())
        return Fault(FaultKind.COUNT_NOT_KEPT, axis, f"it does not move: {why}", passing=True) if why else None

    def _keep(self, axis: Axis) -> None:
        """In the file: where it rests, and that its place is lost."""
        steppers, writer = self._drive, self._writer
        if writer is None or steppers.silent(axis):
            return
        with self._lock:
            found = steppers.rests_deg(axis), steppers.scale(axis), steppers.lost(axis)
            angle_deg, scale, lost = found
            # The same again only now and then: it would take back the mark that a start waits for.
            if (angle_deg is None and not lost) or (
                found == self._told[axis] and self._clock() - self._told_s[axis] < KEEP_EVERY_S
            ):
                return
            before, self._told[axis], self._told_s[axis] = self._told[axis], found, self._clock()
            if lost or angle_deg is None:
                writer.lost(axis)
            elif scale != before[1]:
                writer.homed(axis, angle_deg)
            else:
                writer.rests(axis, angle_deg)
