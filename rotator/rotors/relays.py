"""Motors on relays, with a sensor for each angle: pots on a converter, or the sensor that the file names.

Knows that a bank of relays takes directions. What the bank refuses is in `hw.drives.relays`.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, Axis, Direction
from rotator.control.commands import Command, Run
from rotator.rotors.common import Ends, GuardedRotor, no_switches


class RelayRotor(GuardedRotor):
    def __init__(self, bank: RelayBank, sensors: Mapping[Axis, AngleSensor], ends: Ends = no_switches) -> None:
        super().__init__(bank, sensors, ends, alarm="CUT THE MOTOR POWER")
        self.bank = bank

    def obey(self, axis: Axis, command: Command) -> Direction:
        assert isinstance(command, Run), "relays know directions only"
        return self.bank.drive(axis, command.direction, command.until_s)

    def cut(self) -> bool:
        return self.bank.cut()

    def restore(self) -> None:
        self.bank.restore()
