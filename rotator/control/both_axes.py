"""What concerns both axes at once: where the boom points on a mount that leans, and the one supply of the motors.

A master relay switches the supply for both: what feeds one motor turns the other one through a relay that was found
closed. Knows the mount, the status and the commands of both axes. Does not know how a relay was found closed. One that
is only in doubt forbids the other axis nothing: most axes that stand at a stop have an open relay.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.control.axis.port import ControlledAxis
from rotator.control.commands import Command, Feed, Run
from rotator.control.sky.mount import Mount
from rotator.exchange.faults import Fault, FaultKind
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


def kept_off(axes: Mapping[Axis, ControlledAxis], commands: Mapping[Axis, Command]) -> list[Fault]:
    """For each axis whose command would feed the motor of the other one too: the fault that stops it."""
    faults = []
    for axis, other in ((Axis.AZIMUTH, Axis.ELEVATION), (Axis.ELEVATION, Axis.AZIMUTH)):
        if axis in commands and axes[other].turns_when_fed and _feeds(commands[axis]):
            measured = f"a relay of {other.value} was found closed, and the motors' supply would turn {other.value} too"
            advice = f"Replace that relay, then: rotator relays-checked {other.value}"
            faults.append(Fault(FaultKind.RELAY_WELDED, axis, measured, advice=advice))
    return faults


def _feeds(command: Command) -> bool:
    return isinstance(command, Feed) or (isinstance(command, Run) and command.direction is not Direction.OFF)
