"""Two hobby servos as the control loop sees them.

Knows the faults of the servo board, and when the first jump is over. Does not know the real angle of a servo: a servo
reports nothing.
"""

from __future__ import annotations

from hw.drives.servo import ServoDrive
from hw.ports import AngleSensor, Axis
from rotator.control.axis.readings import Condition
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import Fault, FaultKind
from rotator.rotors.common import BlockedDirections, no_switches
from rotator.rotors.positioned import PositionedRotor


class ServoRotor(PositionedRotor):
    """An axis is settling until its servo has had time for the jump of the first pulse."""

    def __init__(
        self, drive: ServoDrive, sensors: dict[Axis, AngleSensor], shift: Offsets, ends: BlockedDirections = no_switches
    ) -> None:
        super().__init__(drive, sensors, shift, ends)
        self._servos = drive

    def condition(self, axis: Axis) -> Condition:
        text = self._servos.faults().get(axis)
        return Condition(
            fault=Fault(FaultKind.SERVO_BOARD, axis, text) if text else None,
            settling=not self._servos.position_known(axis),
            ends=self._ends(axis),
        )

    def close(self) -> None:
        try:
            super().close()
        finally:
            self._servos.finish()
