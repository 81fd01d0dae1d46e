"""How long a guard sleeps, and one axis of a drive as a sensor."""

from __future__ import annotations

import threading

import pytest

from hw.drives.leases import wait_until
from hw.drives.positioned import DriveAngle
from hw.ports import AngleSource, Axis, HardwareError
from tests.tables import every_row


class Noted(threading.Condition):
    """A condition that writes down for how long it was to sleep, and does not sleep."""

    def __init__(self) -> None:
        super().__init__()
        self.slept_s: list[float | None] = []

    def wait(self, timeout: float | None = None) -> bool:
        self.slept_s.append(timeout)
        return True


@every_row(
    ("due_s", "slept_s"),
    [
        (None, [1.0]),
        (100.25, [0.25]),
        (101.0, [1.0]),
        (109.0, [1.0]),
        (100.0, []),
        (99.0, []),
    ],
)
def test_it_sleeps_until_something_is_due_but_no_longer_than_its_patience(
    due_s: float | None, slept_s: list[float]
) -> None:
    changed = Noted()
    wait_until(changed, due_s, lambda: 100.0, 1.0)
    assert changed.slept_s == slept_s


class Drive:
    """A drive whose azimuth is measured at 123.4°, and whose elevation does not answer."""

    angle_source = AngleSource.MEASURED

    def angle_deg(self, axis: Axis) -> float:
        if axis is Axis.AZIMUTH:
            return 123.4
        raise HardwareError("elevation does not answer")


def test_a_sensor_reads_its_own_axis_as_the_drive_knows_it() -> None:
    azimuth = DriveAngle(Drive(), Axis.AZIMUTH)
    assert (azimuth.read(), azimuth.source) == (123.4, AngleSource.MEASURED)
    with pytest.raises(HardwareError, match="elevation does not answer"):
        DriveAngle(Drive(), Axis.ELEVATION).read()
