"""Two moteus controllers, as the control loop sees them.

Knows their faults, that a controller may have lost its position, and that the operator then confirms it. Does not know
how an order reaches a controller: `hw.moteus.bus` does, and `hw.moteus.wire` in simulated time.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.moteus.bus import MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.wire import MoteusInStep
from hw.ports import AngleSensor, Axis, Direction, HardwareError
from rotator.control.axis.readings import Condition
from rotator.control.commands import Acknowledge, Command, Errand, Place
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.orders import LetGo
from rotator.rotors.common import BlockedDirections, PlainRotor, no_switches
from rotator.rotors.port import AddAlarm
from rotator.rotors.positioned import steered


class MoteusRotor(PlainRotor):
    """`serve` carries the orders: a MoteusBus in real time, a MoteusInStep in simulated time."""

    def __init__(
        self,
        drive: MoteusDrive,
        serve: MoteusBus | MoteusInStep,
        sensors: Mapping[Axis, AngleSensor],
        shift: Offsets,
        ends: BlockedDirections = no_switches,
    ) -> None:
        self.sensors = sensors
        self._drive = drive
        self._serve = serve
        self._shift = shift
        self._ends = ends

    def condition(self, axis: Axis) -> Condition:
        limit, stopped_by = self._drive.limits().get(axis), self._drive.faults().get(axis, "")
        return Condition(
            fault=self._fault(axis, stopped_by),
            latched=bool(stopped_by),
            notice=Notice(limit.name, limit.short) if limit else None,
            missed=self._drive.misses(axis),
            ends=self._ends(axis),
        )

    def obey(self, axis: Axis, command: Command) -> Direction:
        return steered(self._drive, self._shift, axis, command)

    def run(self, errand: Errand) -> None:
        match errand:
            case Acknowledge(axis) if axis in self._drive.faults():
                self._drive.acknowledge(axis)
            case Place(axis, angle_deg):
                self._drive.confirm(axis, angle_deg - self._shift.deg(axis))
            case LetGo():
                self._drive.release()

    def off(self) -> None:
        self._drive.off()

    def start(self) -> None:
        if isinstance(self._serve, MoteusBus):
            self._serve.start()

    def begin(self, add_alarm: AddAlarm) -> None:
        if isinstance(self._serve, MoteusInStep):
            add_alarm(self._serve.due_s, self._serve.serve)

    def close(self) -> None:
        if isinstance(self._serve, MoteusBus):
            self._serve.close()
        else:
            self._drive.off()

    def _fault(self, axis: Axis, stopped_by: str) -> Fault | None:
        if stopped_by:
            return Fault(FaultKind.CONTROLLER_FAULT, axis, stopped_by)
        try:
            self._drive.angle_deg(axis)
        except HardwareError as reason:
            if self._drive.answer(axis) is None:
                return Fault(FaultKind.CONTROLLER_SILENT, axis, str(reason), passing=True)
            if self._drive.position_known(axis):
                return Fault(FaultKind.CONTROLLER_SILENT, axis, str(reason), passing=self._drive.forgiven(axis))
            return Fault(FaultKind.POSITION_UNKNOWN, axis, str(reason), passing=True)
        return None
