"""Where the boom points beside what the axes read, on a mount that leans.

Knows the mount and the status of both axes. Knows no order and no time.
"""

from __future__ import annotations

from dataclasses import replace

from rotator.control.sky.mount import Mount
from rotator.exchange.status import AxisStatus


def with_boom(mount: Mount, azimuth: AxisStatus, elevation: AxisStatus) -> tuple[AxisStatus, AxisStatus]:
    """The status of both axes, each with the correction that the mount needs."""
    if mount.model.perfect:
        return azimuth, elevation
    axis_deg, raised_deg = azimuth.shown_deg, elevation.shown_deg
    if axis_deg is None:
        return azimuth, elevation
    raised_deg = elevation.min_deg if raised_deg is None else raised_deg
    there_azimuth_deg, there_elevation_deg = mount.pointed(axis_deg, raised_deg)
    return (
        replace(azimuth, correction_deg=there_azimuth_deg - axis_deg),
        replace(elevation, correction_deg=there_elevation_deg - raised_deg),
    )
