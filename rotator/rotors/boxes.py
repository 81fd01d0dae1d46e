"""A sensor on a rotor with control boxes: each reading corrects the drive's model of the angle.

Knows the calibration from the sensor's readings to degrees. Does not know the boxes: `hw.drives.control_box` does.
"""

from __future__ import annotations

from hw.drives.digipot import DigipotDrive
from hw.ports import AngleSensor, Axis
from rotator.control.axis.calibration_table import Calibration


class FollowedBox:
    """The pot of the rotor, or another sensor, on an axis for which the drive has only a modelled angle.

    `calibration` turns the sensor's readings into degrees on the rotor's own scale.
    """

    def __init__(self, drive: DigipotDrive, axis: Axis, sensor: AngleSensor, calibration: Calibration) -> None:
        self.source = sensor.source
        self._drive = drive
        self._axis = axis
        self._sensor = sensor
        self._calibration = calibration

    def read(self) -> float:
        """The sensor's reading, in the sensor's own unit; the model takes over its angle. Raises HardwareError."""
        raw = self._sensor.read()
        self._drive.found(self._axis, self._calibration.degrees(raw))
        return raw
