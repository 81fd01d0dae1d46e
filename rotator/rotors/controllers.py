"""Ready-made controllers as the control loop sees them.

Knows the faults of a controller in words, and that a person may turn it at its own knob. Does not know how it is spoken
to: `hw.controllers` does. A stop is as good as the controller's own.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from hw.controllers.drive import ControllerDrive
from hw.controllers.unit import Trouble
from hw.ports import AngleSensor, Axis
from rotator.control.axis.readings import Condition
from rotator.control.commands import Errand
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.orders import LetGo, Stop
from rotator.rotors.common import BlockedDirections, no_switches
from rotator.rotors.port import AddAlarm
from rotator.rotors.positioned import PositionedRotor

FIRST_ANSWER_S, LOOK_S = 1.5, 0.01
"""A controller that is there answers within this time, so that the box begins without a fault."""
SILENT = "Check the controller's supply, its cable, and the port in [controller]"
BY_HAND = Notice("it is turned at its controller's own controls: the box follows, and stops nothing", "TURNED THERE")
LEFT = Notice(
    "it was turned away at its controller's own controls: it is not sent back before another target, or a stop",
    "TURNED THERE",
)
SWITCH_OFF = "SWITCH IT OFF!"


class ControllerRotor(PositionedRotor[ControllerDrive]):
    """`sleep`: waits, in seconds, for the first answer."""

    def __init__(
        self,
        drive: ControllerDrive,
        sensors: dict[Axis, AngleSensor],
        shift: Offsets,
        ends: BlockedDirections = no_switches,
        *,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(drive, sensors, shift, ends)
        self._sleep = sleep

    def condition(self, axis: Axis) -> Condition:
        by_hand, left = self._drive.by_hand(axis)
        return Condition(
            fault=self._fault(axis),
            notice=BY_HAND if by_hand else LEFT if left else None,
            settling=by_hand or left,
            waits=self._drive.waits(axis),
            missed=self._drive.unit(axis).missed,
            ends=self._ends(axis),
        )

    def run(self, errand: Errand) -> None:
        match errand:
            case Stop(axes):
                for axis in self.sensors.keys() & axes:
                    self._drive.halt(axis)
            case LetGo():
                for axis in self.sensors:
                    self._drive.halt(axis)

    def start(self) -> None:
        super().start()
        self._drive.start()
        self._wait()

    def begin(self, add_alarm: AddAlarm) -> None:
        super().begin(add_alarm)
        self._drive.start()
        self._wait()

    def close(self) -> None:
        try:
            super().close()
        finally:
            self._drive.finish()

    def _wait(self) -> None:
        for _ in range(round(FIRST_ANSWER_S / LOOK_S)):
            if self._drive.answered:
                return
            self._sleep(LOOK_S)

    def _fault(self, axis: Axis) -> Fault | None:
        match self._drive.trouble(axis):
            case Trouble.SILENT, str() as text:
                return Fault(FaultKind.CONTROLLER_SILENT, axis, text, passing=True, advice=SILENT)
            case Trouble.GARBLED, str() as text:
                return Fault(FaultKind.CONTROLLER_GARBLED, axis, text, passing=True)
            case Trouble.RUNS_ON, str() as text:
                return Fault(FaultKind.CONTROLLER_RUNS_ON, axis, text, act_now=SWITCH_OFF)
            case _:
                return None
