"""Two control boxes as the control loop sees them, and a sensor whose readings correct the drive's model of the angle.

Knows when the angle is only assumed, and the calibration from the sensor's readings to degrees. Does not know the
boxes: `hw.drives.control_box` does.
"""

from __future__ import annotations

import math
from collections import deque

from hw.drives.digipot import ASTRAY_DEG, DigipotDrive
from hw.ports import AngleSensor, Axis
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.held_watch import turns_by_itself
from rotator.control.axis.readings import Condition, Window
from rotator.exchange.faults import Notice
from rotator.rotors.positioned import PositionedRotor

ASSUMED = Notice("angle not certain until the rotor has had time for a full travel")
UNFED = Notice("no supply for the control boxes until the fault is acknowledged", "BOX OFF")
UNSEEN = Notice("no supply for the control boxes before each sensor has shown where its axis is", "BOX OFF")
UNSEEN_S = 2.0
"""A sensor that works shows a place sooner."""
NEAR_DEG = 10.0
"""No control box turns its rotor further from one reading to the next."""
FIRST_READINGS = 5
"""Readings that must agree on the first place; they must also be the majority."""
NEAR_READINGS, LATEST_NEAR = 3, 5
"""So many of the latest readings must be near the last place. Among readings that show any place, one is near by
chance: a box that is to stand would turn there."""
MOVED_READINGS, LATEST_READINGS = 20, 27
"""Latest readings that must agree on a place further off. A spark on the wire is shorter, and a crackling wiper
shows other places in between."""


class BoxRotor(PositionedRotor[DigipotDrive]):
    """Reports that an angle is only assumed, from the start until the box must have arrived. Also reports that a box
    turned the wrong way or too far, so that its supply was cut.
    """

    def condition(self, axis: Axis) -> Condition:
        astray_deg, barred = self._drive.astray_deg(axis), self._drive.barred
        measured = f"it turned {astray_deg:.1f}° away from the angle that was sent to its control box"
        unseen_s = self._drive.unseen_s()
        assumed = None if self._drive.position_known(axis) else ASSUMED
        if barred and not astray_deg:
            notice: Notice | None = UNFED
        else:
            notice = UNSEEN if unseen_s > UNSEEN_S else assumed
        return Condition(
            fault=turns_by_itself(axis, measured, f"{ASTRAY_DEG:g}°", master=True) if astray_deg else None,
            latched=True,
            notice=notice,
            settling=barred or unseen_s > 0.0,
            ends=self._ends(axis),
        )

    def cut(self) -> bool:
        return self._drive.cut()

    def restore(self) -> None:
        self._drive.restore()


class FollowedBox:
    """The pot of the rotor, or another sensor, on an axis for which the drive has only a modelled angle.

    `calibration` turns the readings into degrees on the rotor's own scale. A reading outside `healthy`, as from
    a broken wire, shows no place; nor does a short jump, nor one reading among many that jump.
    """

    def __init__(
        self,
        drive: DigipotDrive,
        axis: Axis,
        sensor: AngleSensor,
        calibration: Calibration,
        healthy: Window,
    ) -> None:
        self.source = sensor.source
        self._drive = drive
        self._axis = axis
        self._sensor = sensor
        self._calibration = calibration
        self._healthy = healthy
        self._place_deg: float | None = None
        """The last angle that the sensor gave to the model."""
        self._latest_deg: deque[float] = deque(maxlen=LATEST_READINGS)
        """The latest readings in degrees; not a number: the reading shows no place."""
        drive.measured(axis)

    def read(self) -> float:
        """The reading in the sensor's own unit. The model takes its angle from it. Raises HardwareError."""
        raw = self._sensor.read()
        healthy = self._healthy.low_raw <= raw <= self._healthy.high_raw
        angle_deg = self._calibration.degrees(raw) if healthy else math.nan
        self._latest_deg.append(angle_deg)
        if healthy and self._believable(angle_deg):
            self._place_deg = angle_deg
            self._drive.found(self._axis, angle_deg)
        return raw

    def _believable(self, angle_deg: float) -> bool:
        alike = sum(abs(other_deg - angle_deg) <= NEAR_DEG for other_deg in self._latest_deg)
        if self._place_deg is None:
            return alike >= FIRST_READINGS and 2 * alike > len(self._latest_deg)
        if alike >= MOVED_READINGS:
            return True
        latest_deg = list(self._latest_deg)[-LATEST_NEAR:]
        near = sum(abs(other_deg - self._place_deg) <= NEAR_DEG for other_deg in latest_deg)
        return abs(angle_deg - self._place_deg) <= NEAR_DEG and near >= NEAR_READINGS
