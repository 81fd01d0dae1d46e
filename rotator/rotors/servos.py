"""Two hobby servos as the control loop sees them.

Knows the faults of the servo board, and when the first jump is over. Does not know the real angle of a servo: a servo
reports nothing.
"""

from __future__ import annotations

from hw.drives.servo import ServoDrive
from hw.ports import Axis
from rotator.control.axis.readings import Condition
from rotator.exchange.faults import Fault, FaultKind
from rotator.rotors.positioned import PositionedRotor


class ServoRotor(PositionedRotor[ServoDrive]):
    """An axis is settling until its servo has had time for the jump of the first pulse."""

    def condition(self, axis: Axis) -> Condition:
        text = self._drive.faults().get(axis)
        return Condition(
            fault=Fault(FaultKind.SERVO_BOARD, axis, text) if text else None,
            settling=not self._drive.position_known(axis),
            ends=self._ends(axis),
        )

    def close(self) -> None:
        try:
            super().close()
        finally:
            self._drive.finish()
