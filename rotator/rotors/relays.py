"""Motors on relays, with a sensor for each angle: a pot on a converter, or another sensor from the configuration.

Knows that relays take a direction, not an angle. Does not know when a relay may close: `hw.drives.relays` does.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, Axis, Direction
from rotator.control.commands import Command, Run
from rotator.rotors.common import BlockedDirections, GuardedRotor, no_switches


class RelayRotor(GuardedRotor):
    """Two motors on a bank of relays. `sensors`: the angle sensor of each axis."""

    def __init__(
        self, bank: RelayBank, sensors: Mapping[Axis, AngleSensor], ends: BlockedDirections = no_switches
    ) -> None:
        super().__init__(bank, sensors, ends, operator_must="CUT THE MOTOR POWER")
        self.bank = bank

    def obey(self, axis: Axis, command: Command) -> Direction:
        assert isinstance(command, Run), "relays take directions only"
        return self.bank.drive(axis, command.direction, command.until_s)

    def cut(self) -> bool:
        return self.bank.cut()

    def restore(self) -> None:
        self.bank.restore()
