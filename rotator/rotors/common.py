"""What several kinds of rotor share: default answers, and a drive with a guard. Does not know a kind."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

from hw.ports import AngleSensor, Axis, Direction
from hw.safety.guard import Expiring, Guard
from rotator.control.axis.readings import Condition
from rotator.control.commands import Errand
from rotator.rotors.port import AddAlarm

BlockedDirections = Callable[[Axis], frozenset[Direction]]
"""For an axis: the directions that an open limit switch blocks now."""

NOTHING_TO_REPORT = Condition()
DriveT = TypeVar("DriveT", bound=Expiring)


def no_switches(_axis: Axis) -> frozenset[Direction]:
    """A rotor without limit switches: no direction is blocked."""
    return frozenset()


class PlainRotor:
    """Default answers: no relays, no switched supply, no index contact, no counted coast, no thread to check."""

    def driven(self, _axis: Axis) -> Direction:
        return Direction.OFF

    def closed_contacts(self) -> frozenset[Axis]:
        return frozenset()

    def cut(self) -> bool:
        return False

    def restore(self) -> None:
        pass

    def check(self) -> None:
        pass

    def coasts(self) -> bool:
        return False


class GuardedRotor(PlainRotor, Generic[DriveT]):
    """A drive whose commands expire, and the guard that ends them: a thread, or a call by the simulated clock.

    `operator_must`: for the log: the operator's immediate action if the drive cannot be switched off.
    """

    def __init__(
        self,
        drive: DriveT,
        sensors: Mapping[Axis, AngleSensor],
        ends: BlockedDirections = no_switches,
        *,
        operator_must: str = "",
    ) -> None:
        self.sensors = sensors
        self._drive = drive
        self._ends = ends
        # Only the guard's thread reads this clock, and it runs only in real time. A simulated clock passes its own time
        # to `enforce`.
        self._guard = Guard(drive, time.monotonic, operator_must=operator_must)

    def condition(self, axis: Axis) -> Condition:
        ends = self._ends(axis)
        return Condition(ends=ends) if ends else NOTHING_TO_REPORT

    def run(self, errand: Errand) -> None:
        """Does nothing. A kind that takes errands overrides this."""

    def off(self) -> None:
        self._drive.off()

    def start(self) -> None:
        self._guard.start()

    def begin(self, add_alarm: AddAlarm) -> None:
        add_alarm(self._drive.due_s, self._guard.enforce)

    def check(self) -> None:
        self._guard.check()

    def close(self) -> None:
        self._guard.stop()
