"""The interface of a rotor to the control loop, the same for every kind.

Knows no kind: each has a file beside this one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.sensing import Condition
from rotator.control.commands import Command, Errand

AddAlarm = Callable[[Callable[[], float | None], Callable[[float], None]], None]
"""Of a simulated clock: a function with the moment at which something is due, and the function to call then."""


class Rotor(Protocol):
    """Only the control loop drives it; any thread may call `off` at any time."""

    sensors: Mapping[Axis, AngleSensor]
    """Read in a thread of their own."""

    def condition(self, axis: Axis) -> Condition:
        """The condition of the axis; called right after its sensor has been read, in the same thread."""

    def obey(self, axis: Axis, command: Command) -> Direction:
        """Returns the direction whose relay is closed now, OFF without relays. Raises HardwareError."""

    def run(self, errand: Errand) -> None:
        """Do this once. Raises HardwareError."""

    def closed_contacts(self) -> frozenset[Axis]:
        """The axes whose index contact is closed now, for a lamp; from any thread. Raises HardwareError."""

    def off(self) -> None:
        """The safe state, from any thread: relays open; a motor that holds its place decelerates and holds."""

    def cut(self) -> bool:
        """Everything off and the motors' supply too; False: no output switches the supply. Raises HardwareError."""

    def restore(self) -> None:
        """The supply may come back."""

    def start(self) -> None:
        """Begin in real time: start the guard and the other threads."""

    def begin(self, add_alarm: AddAlarm) -> None:
        """Begin on a simulated clock, without threads."""

    def check(self) -> None:
        """Raises HardwareError when the thread that ends expired commands has died: nothing may move without it."""

    def close(self) -> None:
        """Switch everything off and join the threads. May be called twice. Raises HardwareError if a line fails."""
