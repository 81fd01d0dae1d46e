"""Motors on relays, with a sensor for each angle: a pot on a converter, or another sensor from the configuration.

Knows that relays take a direction, not an angle. Does not know when a relay may close: `hw.drives.relays` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.drives.relays import RelayBank
from hw.drives.speed import Paced, SpeedOutput
from hw.ports import AngleSensor, Axis, Direction
from hw.safety.off_at_once import BRAKE_AFTER_S
from rotator.control.axis.readings import Condition
from rotator.control.commands import Command, Errand, Feed, Run, Turns, Unfed
from rotator.exchange.faults import Fault, FaultKind
from rotator.rotors.common import BlockedDirections, GuardedRotor, no_switches


class RelayRotor(GuardedRotor[RelayBank]):
    """Two motors on a bank of relays. `sensors`: the angle sensor of each axis. `speeds`: the output for the speed of
    each motor that has one.
    """

    def __init__(
        self,
        bank: RelayBank,
        sensors: Mapping[Axis, AngleSensor],
        ends: BlockedDirections = no_switches,
        speeds: Mapping[Axis, SpeedOutput] | None = None,
    ) -> None:
        self._speeds = speeds or {}
        paced = {axis: Paced(sensors[axis], speed) for axis, speed in self._speeds.items()}
        super().__init__(bank, {**sensors, **paced}, ends, operator_must="CUT THE MOTOR POWER")
        self.bank = bank

    def obey(self, axis: Axis, command: Command) -> Direction:
        match command:
            case Run(direction, until_s, pace):
                driven = self.bank.drive(axis, direction, until_s)
                if axis in self._speeds:
                    self._speeds[axis].want(pace if driven else 0.0, until_s)
                return driven
            case Feed(until_s):
                self.bank.feed(axis, until_s)
                return Direction.OFF
            case Unfed():
                self.bank.unfeed(axis)
                return Direction.OFF
            case _:
                raise AssertionError("relays take directions only")

    def run(self, errand: Errand) -> None:
        match errand:
            case Turns(axis):
                self.bank.seen_turning(axis)
            case _:
                super().run(errand)

    def driven(self, axis: Axis) -> Direction:
        return self.bank.driven()[axis]

    def condition(self, axis: Axis) -> Condition:
        condition = super().condition(axis)
        if axis in self._speeds and (failure := self._speeds[axis].failure):
            condition = replace(condition, fault=Fault(FaultKind.SPEED_OUTPUT, axis, failure, passing=True))
        return condition if self.bank.supplied else replace(condition, supplied=False)

    def cut(self) -> bool:
        return self.bank.cut()

    def restore(self) -> None:
        self.bank.restore()

    def close(self) -> None:
        """Ends the motors at once; the guard still engages the brakes, some seconds later. Raises HardwareError."""
        try:
            self.bank.leave(BRAKE_AFTER_S)
            self._guard.linger(lambda: self.bank.released, 2 * BRAKE_AFTER_S)
        finally:
            super().close()
