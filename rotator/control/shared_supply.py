"""The motors have one supply, and a master relay switches it for both: what feeds one motor turns the other one through
a relay that was found closed.

Knows the commands of both axes, and which relay was found closed. Does not know how that was found. A relay that is
only in doubt forbids the other axis nothing: most axes that stand at a stop have an open relay.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.port import ControlledAxis
from rotator.control.commands import Command, Feed, Run
from rotator.exchange.faults import Fault, FaultKind


def kept_off(axes: Mapping[Axis, ControlledAxis], commands: Mapping[Axis, Command]) -> list[Fault]:
    """For each axis whose command would feed the motor of the other one too: the fault that stops it."""
    faults = []
    for axis, other in ((Axis.AZIMUTH, Axis.ELEVATION), (Axis.ELEVATION, Axis.AZIMUTH)):
        if axis in commands and axes[other].turns_when_fed and _feeds(commands[axis]):
            measured = f"a relay of {other.value} was found closed, and the motors' supply would turn {other.value} too"
            advice = f"Replace that relay, then: rotator relays-checked {other.value}"
            faults.append(Fault(FaultKind.RELAY_WELDED, axis, measured, advice=advice))
    return faults


def _feeds(command: Command) -> bool:
    return isinstance(command, Feed) or (isinstance(command, Run) and command.direction is not Direction.OFF)
