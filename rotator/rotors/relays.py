"""Motors on relays, with a sensor for each angle: a pot on a converter, or another sensor from the configuration.

Knows that relays take a direction, not an angle. Does not know when a relay may close: `hw.drives.relays` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.drives.relays import RelayBank
from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.commands import Command, Feed, Run, Unfed
from rotator.rotors.common import BlockedDirections, GuardedRotor, no_switches


class RelayRotor(GuardedRotor):
    """Two motors on a bank of relays. `sensors`: the angle sensor of each axis."""

    def __init__(
        self, bank: RelayBank, sensors: Mapping[Axis, AngleSensor], ends: BlockedDirections = no_switches
    ) -> None:
        super().__init__(bank, sensors, ends, operator_must="CUT THE MOTOR POWER")
        self.bank = bank

    def obey(self, axis: Axis, command: Command) -> Direction:
        match command:
            case Run(direction, until_s):
                return self.bank.drive(axis, direction, until_s)
            case Feed(until_s):
                self.bank.feed(axis, until_s)
                return Direction.OFF
            case Unfed():
                self.bank.unfeed(axis)
                return Direction.OFF
            case _:
                raise AssertionError("relays take directions only")

    def driven(self, axis: Axis) -> Direction:
        return self.bank.driven()[axis]

    def condition(self, axis: Axis) -> Condition:
        condition = super().condition(axis)
        return condition if self.bank.supplied else replace(condition, supplied=False)

    def cut(self) -> bool:
        return self.bank.cut()

    def restore(self) -> None:
        self.bank.restore()
