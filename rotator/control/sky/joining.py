"""One coordinate alone (`AZ200`, `M200`, `EL20`): joined with the other one, on the sky, before it becomes axis angles.

An antenna over the top has its boom on the other side: its elevation axis stands at 150° while it points 30° high. An
order for one coordinate then changes both axes; so it does on a mount that leans. Where the mount stands upright and
the antenna is not over the top, and cannot go there, the order moves one axis; so does an elevation above 90°, and so
does a knob of the panel. Knows directions and the mount. Knows nothing of goals, motors or time.
"""

from __future__ import annotations

from dataclasses import replace

from rotator.control.sky.angles import ZENITH_DEG, Coordinates, direction
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import Aim


def joined(mount: Mount, aim: Aim, wanted: Coordinates, axes: Coordinates) -> Aim:
    """The order with both coordinates, where the mount needs both; else the order as it is.

    `wanted`: the direction in force, as ordered; `axes`: where the axes go, or stand, on their own scale.
    """
    if (aim.azimuth_deg is None) is (aim.elevation_deg is None) or aim.place:
        return aim
    axis_azimuth_deg, axis_elevation_deg = axes
    if axis_azimuth_deg is None or axis_elevation_deg is None:
        return aim
    if mount.model.perfect and not mount.flip and axis_elevation_deg <= ZENITH_DEG:
        return aim
    there_azimuth_deg, there_elevation_deg = mount.pointed(axis_azimuth_deg, axis_elevation_deg)
    if aim.elevation_deg is not None and ZENITH_DEG < aim.elevation_deg <= mount.elevation.max_deg:
        # Above 90° it names the axis's own angle: the azimuth axis stays.
        return replace(aim, azimuth_deg=there_azimuth_deg)
    azimuth_deg, elevation_deg = wanted
    if azimuth_deg is None or elevation_deg is None:
        azimuth_deg, elevation_deg = direction(there_azimuth_deg, there_elevation_deg)
    if aim.azimuth_deg is None:
        return replace(aim, azimuth_deg=azimuth_deg)
    return replace(aim, elevation_deg=elevation_deg)


def places(*axes: tuple[float | None, float | None]) -> Coordinates:
    """Where azimuth and elevation go, or stand if they have no target. `axes`: of each its target and its angle."""
    azimuth_deg, elevation_deg = (angle_deg if target_deg is None else target_deg for target_deg, angle_deg in axes)
    return azimuth_deg, elevation_deg
