"""The interface between the control loop and a rotor, the same for every kind of rotor.

Knows what the control loop may call and in which thread. Does not know a kind: the modules beside this one do.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.commands import Command, Errand

AddAlarm = Callable[[Callable[[], float | None], Callable[[float], None]], None]
"""`add_alarm(due_s, ring)` of a simulated clock: the clock calls `ring(now_s)` when it reaches `due_s()`."""


class Rotor(Protocol):
    """Only the control loop gives commands. `off` may be called from any thread at any time."""

    sensors: Mapping[Axis, AngleSensor]
    """The angle sensor of each axis. The sensor thread reads them, not the control thread."""

    def condition(self, axis: Axis) -> Condition:
        """The state of the axis, without its angle. The sensor thread calls this right after each reading."""

    def obey(self, axis: Axis, command: Command) -> Direction:
        """Carry out the command. Raises HardwareError.

        Returns the direction whose relay is closed now; OFF for a rotor without relays.
        """

    def driven(self, axis: Axis) -> Direction:
        """The direction whose relay may be closed now, also after an `obey` that failed; OFF for a rotor without
        relays."""

    def run(self, errand: Errand) -> None:
        """Carry out an errand. The controller gives each errand once. Raises HardwareError."""

    def closed_contacts(self) -> frozenset[Axis]:
        """The axes whose index contact is closed now, for a lamp. From any thread. Raises HardwareError."""

    def off(self) -> None:
        """The safe state, from any thread: relays open; a motor that holds its position decelerates and holds."""

    def cut(self) -> bool:
        """Switch off all motors and their supply. False: no relay switches the supply. Raises HardwareError."""

    def restore(self) -> None:
        """Allow the motors' supply again. It is switched on with the next motor."""

    def coasts(self) -> bool:
        """Whether a motor still turns after `off` and its sensor still counts. From any thread."""

    def start(self) -> None:
        """Begin in real time: start the guard and all other threads."""

    def begin(self, add_alarm: AddAlarm) -> None:
        """Begin on a simulated clock, without threads. Called in place of `start`."""

    def check(self) -> None:
        """Raises HardwareError when the guard's thread has died: nothing may move, as no command would expire."""

    def close(self) -> None:
        """Switch everything off and join the threads. May be called twice. Raises HardwareError if a line fails."""
