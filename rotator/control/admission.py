"""Which orders are refused outright, so that the sender can be told in its protocol's own words.

Knows the mount and the latest status. An order that is admitted may still have no effect (a latch, a silenced stream):
those are answered like any other, as a person at the box expects. The controller asks here too, a moment later.
"""

from __future__ import annotations

from rotator.control.mount import Mount, Unreachable
from rotator.orders import Aim, Calibrate, LoadTimed, Order, Park, Refusal
from rotator.status import Status


def refusal(order: Order, status: Status, mount: Mount) -> Refusal | None:
    """Why `order` will not be obeyed, or None."""
    match order:
        case Aim(azimuth_deg, elevation_deg):
            return _uncalibrated(order, status) or _unreachable(((azimuth_deg, elevation_deg),), mount)
        case LoadTimed(_, points):
            return _uncalibrated(order, status) or _unreachable(points, mount)
        case Park():
            return _uncalibrated(order, status)
        case Calibrate(axis) if status.moving:
            return Refusal(f"{axis.value} cannot be calibrated while the antenna moves")
        case _:
            return None


def _uncalibrated(order: Order, status: Status) -> Refusal | None:
    """One axis that nobody has commissioned keeps the other from nothing; two keep all."""
    azimuth_only = isinstance(order, Aim) and order.elevation_deg is None
    if status.azimuth.uncalibrated and (azimuth_only or status.elevation.uncalibrated):
        return Refusal(f"UNCALIBRATED: azimuth needs {status.azimuth.uncalibrated}")
    return None


def _unreachable(points: tuple[tuple[float | None, float | None], ...], mount: Mount) -> Refusal | None:
    try:
        for azimuth_deg, elevation_deg in points:
            if azimuth_deg is not None:
                mount.axis_angles(azimuth_deg, elevation_deg, 0.0)
    except Unreachable as reason:
        return Refusal(str(reason))
    return None
