"""Two DC motors behind H-bridges, as the control loop sees them.

Knows what a drive can find wrong with an axis, that its count is kept in a file, and that a motor starts only after the
file marks its axis as moving. Does not know how a motor is fed: `hw.drives.h_bridge` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.drives.bridge_axis import Amiss
from hw.drives.h_bridge import BridgeDrive
from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_faults import unstoppable
from rotator.control.commands import Acknowledge, Command, Errand, Place, Seek
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind
from rotator.rotors.common import BlockedDirections, no_switches
from rotator.rotors.counted import CountedAxis, CountsKept
from rotator.rotors.counts_writer import CountsWriter
from rotator.rotors.positioned import PositionedRotor

KINDS = {
    Amiss.QUIET: FaultKind.NO_PULSES,
    Amiss.WRONG_WAY: FaultKind.WRONG_WAY,
    Amiss.TURNING: FaultKind.TURNS_BY_ITSELF,
    Amiss.LOST: FaultKind.COUNT_LOST,
    Amiss.HOMING: FaultKind.NOT_HOMED,
}
ADVICE = {
    Amiss.LOST: "Look where the antenna points, then: rotator confirm AXIS DEGREES",
    Amiss.QUIET: "Check the motor and its supply, then the encoder and its wires; or something holds the antenna",
    Amiss.TURNING: "Look at the bridge: a transistor may have failed",
}


class BridgeRotor(PositionedRotor[BridgeDrive], CountsKept[BridgeDrive]):
    """`axes`: the count of each axis. `master`: an output takes the bridges' supply, or disables them."""

    def __init__(
        self,
        drive: BridgeDrive,
        sensors: Mapping[Axis, AngleSensor],
        axes: Mapping[Axis, CountedAxis],
        shift: Offsets,
        ends: BlockedDirections = no_switches,
        *,
        counts_writer: CountsWriter | None = None,
        master: bool = False,
    ) -> None:
        super().__init__(drive, sensors, shift, ends)
        self._axes = axes
        self._counts_writer = counts_writer
        self._master = master
        self._was_lost = {axis: bool(each.condition(frozenset()).lost) for axis, each in axes.items()}

    def condition(self, axis: Axis) -> Condition:
        condition = self._axes[axis].condition(self._ends(axis))
        lost = condition.lost
        if lost and not self._was_lost[axis]:
            self._drive.fail(axis, Amiss.LOST, lost)
        self._was_lost[axis] = bool(lost)
        if failure := self._drive.failure:
            return replace(condition, fault=Fault(FaultKind.MOTOR_DRIVER, axis, failure, passing=True))
        if (found := self._drive.amiss(axis)) is None:
            return condition
        amiss, seen = found
        # A lost count of an axis that finds its end is homed: the fault's own words say that.
        advice = "" if amiss is Amiss.LOST and self._drive.finds_end(axis) else ADVICE.get(amiss, "")
        fault = Fault(KINDS[amiss], axis, seen, sensor="encoder", advice=advice)
        if amiss is Amiss.TURNING:
            fault = unstoppable(fault, master=self._master)
        return replace(condition, fault=fault, latched=True)

    def obey(self, axis: Axis, command: Command) -> Direction:
        if isinstance(command, Seek):
            self._drive.seek(axis, command.until_s)
            return Direction.OFF
        return super().obey(axis, command)

    def run(self, errand: Errand) -> None:
        match errand:
            case Acknowledge(axis):
                self._drive.acknowledge(axis)
            case Place(axis, angle_deg):
                self._axes[axis].place(angle_deg - self._shift.deg(axis))
            case _:
                super().run(errand)

    def cut(self) -> bool:
        return self._drive.cut()

    def restore(self) -> None:
        self._drive.restore()
