"""The angle of one axis of a drive, as an angle sensor: for drives that measure or model the angle themselves.

Knows no motor and no chip. Does not know how the angle is measured or modelled: the drive does.
"""

from __future__ import annotations

from typing import Protocol

from hw.ports import AngleSource, Axis


class AngleDrive(Protocol):
    """A drive that knows the angles of its axes."""

    angle_source: AngleSource

    def angle_deg(self, axis: Axis) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError if the angle is not known."""


class DriveAngle:
    """One axis of such a drive as a `hw.ports.AngleSensor`. Its readings are degrees already."""

    def __init__(self, drive: AngleDrive, axis: Axis) -> None:
        self.source = drive.angle_source
        self._drive = drive
        self._axis = axis

    def read(self) -> float:
        """Degrees on the rotor's own scale. Raises HardwareError where the angle is not known."""
        return self._drive.angle_deg(self._axis)
