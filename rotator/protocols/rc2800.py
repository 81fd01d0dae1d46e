"""M2's RC2800PX: azimuth and elevation, one letter for each axis, ended by CR.

Knows the command table, its codec and what each command makes the box do. Does not know how the box does it. Source:
what Hamlib 4.5 and 5.0 send to model 1001 and read from it (see docs/reference/wire.md). The older RC2800, to which an
angle is sent without its letter, is not spoken here: a lost letter would turn the wrong axis.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from hw.ports import Axis
from rotator.exchange.orders import Stop
from rotator.protocols.aiming import SURE_NUMBER, aim, degrees
from rotator.protocols.damaged import NOISE, is_stop
from rotator.protocols.lines import OVERLONG, LineTalk
from rotator.protocols.session import Box

MAX_LINE = 64


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list. `takes`: an example of what follows the letter."""

    text: str
    help: str
    takes: str = ""


VERBS = (
    Verb("A", "Read azimuth; S: stands, M: moves"),
    Verb("E", "Read elevation"),
    Verb("A", "Azimuth: go there", "235.0"),
    Verb("E", "Elevation: go there", "25"),
    Verb("S", "Stop everything"),
)
_COMMAND = re.compile(rf"([AE])({SURE_NUMBER})?|S")
_AXES = {"A": Axis.AZIMUTH, "E": Axis.ELEVATION}


@dataclass(frozen=True, slots=True)
class Command:
    """A question, an angle, or, without an axis, the stop."""

    axis: Axis | None
    angle_deg: float | None = None


def parse(line: bytes) -> Command | None:
    """The command in one line, without its end; None: the line is no command. Noise before it is skipped."""
    text = line.decode("latin-1").lstrip(NOISE)
    found = _COMMAND.fullmatch(text)
    if found is None or not found[1]:
        return Command(None) if is_stop(line) else None
    angle_deg = degrees(found[2] or "")
    return None if found[2] and angle_deg is None else Command(_AXES[found[1]], angle_deg)


def reply(axis: Axis, angle_deg: float, *, moving: bool) -> bytes:
    """`A P= 235.0 S=9 S`: the angle in six places, the speed 9, and whether it stands or moves."""
    letter = next(letter for letter, each in _AXES.items() if each is axis)
    return f"{letter} P={angle_deg:6.1f} S=9 {'M' if moving else 'S'}\r".encode()


def fault_reply(axis: Axis) -> bytes:
    """The controller's error, in place of an angle."""
    return f"{axis.value[0].upper()} ERR=05\r".encode()


class Rc2800Session(LineTalk):
    """An RC2800PX on one connection. Each command is answered with the axis' angle; a refused order with an error."""

    max_line = MAX_LINE

    def __init__(self, box: Box) -> None:
        self._box = box
        super().__init__()
        self._axis = Axis.AZIMUTH
        """The axis of the last command, which the answer to a stop shows."""

    def _answers(self, line: bytes | None) -> list[bytes]:
        command = parse(line) if line else None
        if command is None and line != b"":
            self._box.note_refused(OVERLONG if line is None else line)
        return [self._obey(command)] if command else []

    def _obey(self, command: Command) -> bytes:
        refused = None
        match command:
            case Command(None):
                self._box.order(Stop())
            case Command(Axis() as axis, angle_deg):
                self._axis = axis
                if angle_deg is not None:
                    order = aim(angle_deg, None) if axis is Axis.AZIMUTH else aim(None, angle_deg)
                    refused = self._box.order(order)
        status = self._box.status().axis(self._axis)
        if refused or status.angle_deg is None:
            return fault_reply(self._axis)
        return reply(self._axis, status.angle_deg, moving=status.moving)
