"""Control boxes with a digital pot in place of the knob, as the control loop sees them.

Knows that a sensor on the rotor, where one is read, corrects the model of the drive.
"""

from __future__ import annotations

from hw.drives.digipot import DigipotDrive
from hw.ports import AngleSensor, Axis
from rotator.control.axis.calibration_table import Calibration


class FollowedBox:
    """A pot of the rotor, or another sensor, on an axis whose drive has only a model.

    `calibration`: from its readings to the rotor's own scale.
    """

    def __init__(self, drive: DigipotDrive, axis: Axis, sensor: AngleSensor, calibration: Calibration) -> None:
        self.source = sensor.source
        self._drive = drive
        self._axis = axis
        self._sensor = sensor
        self._calibration = calibration

    def read(self) -> float:
        raw = self._sensor.read()
        self._drive.found(self._axis, self._calibration.degrees(raw))
        return raw
