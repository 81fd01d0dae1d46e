"""What all kinds of rotor share: where limit switches stand, and how a drive is guarded.

Knows threads and alarms. Knows no kind of rotor.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from hw.ports import AngleSensor, Axis, Direction
from hw.safety.guard import Expiring, Guard
from rotator.control.axis.sensing import Condition
from rotator.control.commands import Errand
from rotator.rotors.port import AddAlarm

Ends = Callable[[Axis], frozenset[Direction]]
"""The ways in which the limit switches let an axis go no further."""


def no_switches(_axis: Axis) -> frozenset[Direction]:
    return frozenset()


class PlainRotor:
    """The answers of a kind without a switched supply, without counted contacts and without a guard."""

    def closed_contacts(self) -> frozenset[Axis]:
        return frozenset()

    def cut(self) -> bool:
        return False

    def restore(self) -> None:
        pass

    def check(self) -> None:
        pass


class GuardedRotor(PlainRotor):
    """A drive whose commands expire, and its guard: a thread, or the alarms of a simulated clock."""

    def __init__(
        self, drive: Expiring, sensors: Mapping[Axis, AngleSensor], ends: Ends = no_switches, *, alarm: str = ""
    ) -> None:
        self.sensors = sensors
        self._drive = drive
        self._ends = ends
        self._guard = Guard(drive, time.monotonic, alarm=alarm)

    def condition(self, axis: Axis) -> Condition:
        return Condition(ends=self._ends(axis))

    def run(self, errand: Errand) -> None:
        """Nothing to do: a kind for which there is something overrides this."""

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
