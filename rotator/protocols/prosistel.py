"""Prosistel's control boxes: the D box (whole degrees, axes A and E) and the Combi-Track (tenths, axes A and B).

A command is STX, the axis, a letter, and CR. Knows the command table, its codec, and what a command makes the box do.
Does not know how the box does it. Source: what Hamlib 4.5 sends to models 1701 to 1704 and reads from them (see
docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum

from hw.ports import Axis
from rotator.exchange.orders import Stop
from rotator.protocols.aiming import aim, whole
from rotator.protocols.damaged import is_stop
from rotator.protocols.session import Box, Talk

STX, CR = 0x02, 0x0D
MAX_COMMAND = 8
UNKNOWN = "E,00003"
"""The box's error in place of an angle or a state."""


class Model(Enum):
    D = "D"
    COMBI_TRACK = "Combi-Track"


@dataclass(frozen=True, slots=True)
class Form:
    """How a model writes axes and angles."""

    axes: dict[str, Axis]
    per_degree: int


FORMS = {
    Model.D: Form({"A": Axis.AZIMUTH, "E": Axis.ELEVATION}, 1),
    Model.COMBI_TRACK: Form({"A": Axis.AZIMUTH, "B": Axis.ELEVATION}, 10),
}
STOPS_DEG = 900
"""977, 997 and 999 mean a stop: with a ramp, and at once. No rotor has an angle from here on, so what is damaged of
them is a stop too."""
_DAMAGED_STOP = re.compile(r"G9..")


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str


VERBS = (
    Verb("?", "Read the angle; R: at rest, B: it turns"),
    Verb("G", "Go there"),
    Verb("G999", "Stop this axis; both stopped: faults acknowledged"),
    Verb("S", "Position only when asked: always so"),
)
_COMMAND = re.compile(r"([A-Z])(?:(G)(\d{1,4})|([?S]))")


@dataclass(frozen=True, slots=True)
class Command:
    """`number` is the angle in the model's own unit, or a stop."""

    axis: Axis
    verb: str
    number: int | None = None


def parse(text: bytes, model: Model) -> Command | None:
    """The command between STX and CR; None: the text is no command for this model."""
    found = _COMMAND.fullmatch(text.decode("latin-1"))
    axis = FORMS[model].axes.get(found[1]) if found else None
    if found is None or axis is None:
        return None
    return Command(axis, "G", int(found[3])) if found[2] else Command(axis, found[4])


def reply(axis: Axis, verb: str, value: str, model: Model) -> bytes:
    """STX, axis, the command's letter, and `value`: the state, and before it an angle where it was asked for."""
    return b"\x02" + f"{_letter(axis, model)},{verb},{value}\r".encode()


def _letter(axis: Axis, model: Model) -> str:
    return next(letter for letter, each in FORMS[model].axes.items() if each is axis)


class ProsistelSession(Talk):
    """A Prosistel box on one connection. A refused order is answered with the box's error."""

    def __init__(self, box: Box, model: Model) -> None:
        self._box = box
        self._model = model
        self._form = FORMS[model]
        self._begun = bytearray()
        self._headed = False
        """The bytes begun have their STX. Without it only a stop counts."""
        self._stopped: Axis | None = None
        """The axis that the command before this one stopped."""

    def receive(self, data: bytes) -> list[bytes]:
        replies = [self._take(octet) for octet in data]
        return [each for each in replies if each]

    def finish(self) -> list[bytes]:
        answer = self._take(CR)
        return [answer] if answer else []

    def _take(self, octet: int) -> bytes:
        if octet in (STX, CR):
            text, headed = bytes(self._begun), self._headed
            self._begun, self._headed = bytearray(), octet == STX
            command = parse(text, self._model) if headed and octet == CR else None
            if command is None and text:
                self._damaged(text, headed=headed)
            return self._obey(command) if command else b""
        self._begun.append(octet)
        if len(self._begun) > MAX_COMMAND:
            del self._begun[0]
            self._headed = False
        return b""

    def _damaged(self, text: bytes, *, headed: bool) -> None:
        if _DAMAGED_STOP.search(text.decode("latin-1")) or is_stop(text):
            self._box.order(Stop())
        elif headed:
            self._box.note_refused(text)

    def _obey(self, command: Command) -> bytes:
        stopped, self._stopped = self._stopped, None
        match command:
            case Command(axis, "?"):
                self._stopped = stopped
                value = self._angle(axis)
            case Command(axis, "G", int() as number) if number >= STOPS_DEG * self._form.per_degree:
                self._box.order(Stop() if stopped not in (None, axis) else Stop((axis,)))
                self._stopped = axis
                value = "R"
            case Command(axis, "G", int() as number):
                angle_deg = number / self._form.per_degree
                order = aim(angle_deg, None) if axis is Axis.AZIMUTH else aim(None, angle_deg)
                value = UNKNOWN if self._box.order(order) else "R"
            case Command(axis):
                value = "R"
        return reply(axis, command.verb, value, self._model)

    def _angle(self, axis: Axis) -> str:
        status = self._box.status().axis(axis)
        if status.angle_deg is None:
            return UNKNOWN
        angle = max(0, whole(status.angle_deg * self._form.per_degree))
        return f"{angle:0{3 if self._form.per_degree == 1 else 4}d},{'B' if status.moving else 'R'}"
