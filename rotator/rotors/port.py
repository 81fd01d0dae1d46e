"""What the control loop drives and reads, whichever kind of rotor it is.

Knows the shape that all of them have. Knows none of them: those are in `rotator.rotors`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from hw.ports import AngleSensor, Axis, Direction
from rotator.control.axis.sensing import Condition
from rotator.control.commands import Command, Errand

AddAlarm = Callable[[Callable[[], float | None], Callable[[float], None]], None]
"""A simulated clock's: when something is due, and what is to be called then."""


class Rotor(Protocol):
    """Only the control loop drives it. `off` may be called from any thread at any time."""

    sensors: Mapping[Axis, AngleSensor]
    """Read in a thread of their own."""

    def condition(self, axis: Axis) -> Condition:
        """How the axis is, beside its angle: asked for right after its sensor has been read, in the same thread."""

    def obey(self, axis: Axis, command: Command) -> Direction:
        """Do that. Returns which way a relay is closed now; OFF where there are none. Raises HardwareError."""

    def run(self, errand: Errand) -> None:
        """Something that is to be done once. Raises HardwareError."""

    def closed_contacts(self) -> frozenset[Axis]:
        """The axes whose index contact is closed now, for a lamp; from any thread. Raises HardwareError."""

    def off(self) -> None:
        """The safe state, from any thread: relays open; a motor that holds its place decelerates and holds."""

    def cut(self) -> bool:
        """Everything off and the motors' supply with it; False: nothing here can switch it. Raises HardwareError."""

    def restore(self) -> None:
        """The supply may come back."""

    def start(self) -> None:
        """Begin in real time: start the guard and all other threads."""

    def begin(self, add_alarm: AddAlarm) -> None:
        """In place of `start` on a simulated clock, where there are no threads."""

    def check(self) -> None:
        """Raises HardwareError when the thread that ends expired commands has died: nothing may move without it."""

    def close(self) -> None:
        """Switch everything off and join the threads. May be called twice. Raises HardwareError if a line fails."""
