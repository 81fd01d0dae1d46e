"""Motors that go to an angle by themselves: servos, and control boxes that follow a digital pot.

Knows that a drive takes angles on the rotor's own scale, and shifts the controller's angles to that scale. Does not
know the kind of drive.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, TypeVar

from hw.ports import AngleSensor, Axis, Direction, PositionedDrive
from hw.safety.guard import Expiring
from rotator.control.commands import Command, Errand, Steer
from rotator.control.sky.offsets import Offsets
from rotator.exchange.orders import LetGo
from rotator.rotors.common import BlockedDirections, GuardedRotor, no_switches


def steered(drive: PositionedDrive, shift: Offsets, axis: Axis, command: Command) -> Direction:
    """Pass the command to the drive, on the rotor's own scale. Returns OFF: no relay. Raises HardwareError."""
    if isinstance(command, Steer):
        drive.aim(axis, command.angle_deg - shift.deg(axis), command.rate_dps, command.until_s)
    else:
        drive.hold(axis)
    return Direction.OFF


class GuardedDrive(PositionedDrive, Expiring, Protocol):
    """A positioned drive with commands that a guard ends when they expire."""


MotorsT = TypeVar("MotorsT", bound=GuardedDrive)


class PositionedRotor(GuardedRotor[MotorsT]):
    """`shift`: the offset of each axis, from the rotor's own scale to the controller's angles."""

    def __init__(
        self,
        drive: MotorsT,
        sensors: Mapping[Axis, AngleSensor],
        shift: Offsets,
        ends: BlockedDirections = no_switches,
    ) -> None:
        super().__init__(drive, sensors, ends)
        self._shift = shift

    def obey(self, axis: Axis, command: Command) -> Direction:
        return steered(self._drive, self._shift, axis, command)

    def run(self, errand: Errand) -> None:
        if isinstance(errand, LetGo):
            self._drive.release()
