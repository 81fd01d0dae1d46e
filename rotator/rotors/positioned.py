"""Motors that go to an angle by themselves: servos, and control boxes that follow a digital pot.

Knows that the angles of a drive are on the rotor's own scale. Knows no drive.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from hw.ports import AngleSensor, Axis, Direction, PositionedDrive
from hw.safety.guard import Expiring
from rotator.control.commands import Command, Errand, Steer
from rotator.control.sky.offsets import Offsets
from rotator.orders import LetGo
from rotator.rotors.common import Ends, GuardedRotor, no_switches


def steered(drive: PositionedDrive, shift: Offsets, axis: Axis, command: Command) -> Direction:
    """Pass the command to the drive, on the rotor's own scale. Returns OFF: it has no relays. Raises HardwareError."""
    if isinstance(command, Steer):
        drive.aim(axis, command.angle_deg - shift.of(axis), command.rate_dps, command.until_s)
    else:
        drive.hold(axis)
    return Direction.OFF


class GuardedDrive(PositionedDrive, Expiring, Protocol):
    """A positioned drive whose commands a guard lets expire."""


class PositionedRotor(GuardedRotor):
    def __init__(
        self, drive: GuardedDrive, sensors: Mapping[Axis, AngleSensor], shift: Offsets, ends: Ends = no_switches
    ) -> None:
        super().__init__(drive, sensors, ends)
        self._motors = drive
        self._shift = shift

    def obey(self, axis: Axis, command: Command) -> Direction:
        return steered(self._motors, self._shift, axis, command)

    def run(self, errand: Errand) -> None:
        if isinstance(errand, LetGo):
            self._motors.release()
