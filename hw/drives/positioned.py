"""What drives that go to an angle by themselves share: the angle of one of their axes as a sensor.

Knows no motor and no chip. Does not know how the angle is found: the drive knows that, and names the source.
"""

from __future__ import annotations

from typing import Protocol

from hw.ports import AngleSource, Axis


class AngleDrive(Protocol):
    """A drive that knows where its axes stand."""

    angle_source: AngleSource

    def angle_deg(self, axis: Axis) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError where the angle is not known."""


class DriveAngle:
    """One axis of such a drive as a `hw.ports.AngleSensor`. Its readings are degrees already."""

    def __init__(self, drive: AngleDrive, axis: Axis) -> None:
        self.source = drive.angle_source
        self._drive = drive
        self._axis = axis

    def read(self) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError where the angle is not known."""
        return self._drive.angle_deg(self._axis)
