"""The SPID controllers Rot1Prog, Rot2Prog and MD-01: the frames, and what each makes the box do.

A client sends 13 bytes; a Rot1Prog answers with 5, the other models with 12. Knows the command table, its codec, and
how to find a frame among other bytes. Does not know how the box carries out an order. Sources: LA6YKA's description of
the protocol, and what Hamlib 4.5 and 4.6 send to models 901, 902 and 903 (see docs/reference/wire.md).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum, IntEnum, IntFlag

from hw.ports import Axis, Direction
from rotator.exchange.orders import Jog, Stop
from rotator.protocols.aiming import aim, whole
from rotator.protocols.session import Box, Talk

START, END = 0x57, 0x20
LENGTH = 13
OFFSET_DEG = 360
"""SPID adds this to every angle on the line, so that no number is negative."""
_COMMAND_AT, _END_AT = 11, 12
_AZIMUTH, _ELEVATION = slice(1, 5), slice(6, 10)
_AZIMUTH_PULSES_AT, _ELEVATION_PULSES_AT = 5, 10
_MOST_TENTHS = 9999


class Model(Enum):
    ROT1PROG = "Rot1Prog"
    """Azimuth only, whole degrees."""
    ROT2PROG = "Rot2Prog"
    MD01 = "MD-01"
    """As Rot2Prog, but it also answers SET, and it has the command MOVE."""


class Command(IntEnum):
    """The command byte; K in LA6YKA's description."""

    STOP = 0x0F
    STATUS = 0x1F
    SET = 0x2F
    MOVE = 0x14


@dataclass(frozen=True, slots=True)
class Row:
    """One row of the command list."""

    command: Command
    help: str
    models: tuple[Model, ...] = tuple(Model)
    answered: tuple[Model, ...] = ()
    """The models that answer with their position."""


ROWS = (
    Row(Command.STATUS, "Read the position", answered=tuple(Model)),
    Row(Command.SET, "Go there", answered=(Model.MD01,)),
    Row(Command.STOP, "Stop everything", answered=tuple(Model)),
    Row(Command.MOVE, "Turn until stopped: 1 left, 2 right, 4 up, 8 down, or a sum", models=(Model.MD01,)),
)
_BY_COMMAND: dict[int, Row] = {row.command: row for row in ROWS}


class Turn(IntFlag):
    """The first byte after START in a MOVE: one direction of an axis, or the sum of one for each axis."""

    LEFT = 1
    RIGHT = 2
    UP = 4
    DOWN = 8


TURNS = (
    *(Turn.UP, Turn.DOWN),
    *(Turn.LEFT, Turn.LEFT | Turn.UP, Turn.LEFT | Turn.DOWN),
    *(Turn.RIGHT, Turn.RIGHT | Turn.UP, Turn.RIGHT | Turn.DOWN),
)
"""Every turn that a MOVE may ask for. Opposite directions of one axis are no turn."""


@dataclass(frozen=True, slots=True)
class Frame:
    """One command. SET has angles in degrees; MOVE has a turn; the other commands have neither."""

    command: Command
    azimuth_deg: float | None = None
    elevation_deg: float | None = None
    turn: Turn | None = None


def answers(model: Model, command: Command) -> bool:
    """Whether this model answers this command with its position."""
    return model in _BY_COMMAND[command].answered


@dataclass(slots=True)
class FrameReader:
    """Finds whole frames in a stream of bytes. It skips bytes that do not belong to a frame."""

    model: Model
    pulses: int
    """The controller's pulses per degree: the resolution of the angles in a SET."""
    _buffer: bytearray = field(default_factory=bytearray)

    def feed(self, data: bytes) -> list[Frame]:
        """The frames that end in `data`, which may be any piece of the stream."""
        self._buffer += data
        frames = []
        start = 0
        while (start := self._buffer.find(START, start)) >= 0 and len(self._buffer) - start >= LENGTH:
            frame = decode(bytes(self._buffer[start : start + LENGTH]), self.model, self.pulses)
            if frame:
                frames.append(frame)
            start += LENGTH if frame else 1
        del self._buffer[: len(self._buffer) if start < 0 else start]
        return frames


def decode(octets: bytes, model: Model, pulses: int) -> Frame | None:
    """The command in 13 bytes; None: these bytes are no command for this model. `pulses`: pulses per degree.

    A SET also holds the client's own pulses per degree. They are ignored, as in a real controller: a client must use
    the number that the controller sends in its answers.
    """
    row = _BY_COMMAND.get(octets[_COMMAND_AT])
    if octets[0] == START and _is_damaged_stop(octets):
        return Frame(Command.STOP)
    if octets[0] != START or octets[_END_AT] != END or row is None or model not in row.models:
        return None
    match row.command:
        case Command.SET:
            azimuth, elevation = octets[_AZIMUTH], octets[_ELEVATION]
            if model is Model.ROT1PROG:
                # Three digits of whole degrees, then always 0. The other models count pulses.
                return Frame(Command.SET, int(azimuth[:3]) - OFFSET_DEG) if azimuth.isdigit() else None
            if not (azimuth.isdigit() and elevation.isdigit()):
                return None
            return Frame(Command.SET, int(azimuth) / pulses - OFFSET_DEG, int(elevation) / pulses - OFFSET_DEG)
        case Command.MOVE:
            # The bytes after the turn are not checked: Hamlib sends random memory in the two for the pulses.
            turn = Turn(octets[1])
            return Frame(Command.MOVE, turn=turn) if turn in TURNS else None
        case _:
            return Frame(row.command)


def _is_damaged_stop(octets: bytes) -> bool:
    """A stop with another last byte, or nothing but zeros and a command byte that has only lower bits."""
    zeros = not any(octets[1:_COMMAND_AT]) and octets[_END_AT] == END
    return octets[_COMMAND_AT] == Command.STOP or (zeros and octets[_COMMAND_AT] <= Command.STOP)


def encode(frame: Frame, model: Model, pulses: int) -> bytes:
    """The 13 bytes of a command as Hamlib sends it. Angles are rounded down to a pulse. `pulses`: pulses per degree."""
    octets = bytearray(LENGTH)
    octets[0], octets[_COMMAND_AT], octets[_END_AT] = START, frame.command, END
    if frame.turn is not None:
        octets[1] = frame.turn
    if frame.azimuth_deg is not None and model is Model.ROT1PROG:
        octets[_AZIMUTH] = b"%03d0" % int(frame.azimuth_deg + OFFSET_DEG)
    elif frame.azimuth_deg is not None and frame.elevation_deg is not None:
        octets[_AZIMUTH] = b"%04d" % int(pulses * (frame.azimuth_deg + OFFSET_DEG))
        octets[_ELEVATION] = b"%04d" % int(pulses * (frame.elevation_deg + OFFSET_DEG))
        octets[_AZIMUTH_PULSES_AT] = octets[_ELEVATION_PULSES_AT] = pulses
    return bytes(octets)


def azimuth_reply(azimuth_deg: float) -> bytes:
    """A Rot1Prog's five bytes: whole degrees in three bytes. The byte of a digit is its value 0 to 9, not ASCII."""
    return bytes([START, *_digits(whole(azimuth_deg))[:3], END])


def position_reply(azimuth_deg: float, elevation_deg: float, pulses: int) -> bytes:
    """The 12 bytes of the other models. Angles are in tenths of a degree, also where `pulses` per degree is not 10."""
    return bytes([START, *_digits(azimuth_deg), pulses, *_digits(elevation_deg), pulses, END])


def _digits(angle_deg: float) -> list[int]:
    """The four digits of an angle in tenths of a degree, with the offset."""
    tenths = whole((angle_deg + OFFSET_DEG) * 10)
    return [int(digit) for digit in f"{min(max(tenths, 0), _MOST_TENTHS):04d}"]


PULSES = {Model.ROT1PROG: 1, Model.ROT2PROG: 2, Model.MD01: 10}
"""Pulses a degree unless configured: Rot2Prog counts half degrees, MD-01 tenths."""

_TURNS = {
    Turn.LEFT: Jog(Axis.AZIMUTH, Direction.MINUS),
    Turn.RIGHT: Jog(Axis.AZIMUTH, Direction.PLUS),
    Turn.UP: Jog(Axis.ELEVATION, Direction.PLUS),
    Turn.DOWN: Jog(Axis.ELEVATION, Direction.MINUS),
}


class SpidSession(Talk):
    """A SPID controller on one connection. The protocol has no reply for a refusal: the box is silent and stands."""

    def __init__(self, box: Box, model: Model, pulses: int | None = None) -> None:
        self._box = box
        self._model = model
        self._pulses = pulses or PULSES[model]
        self._frames = FrameReader(model, self._pulses)

    def receive(self, data: bytes) -> list[bytes]:
        replies = [self._answer(frame) for frame in self._frames.feed(data)]
        return [reply for reply in replies if reply]

    def _answer(self, frame: Frame) -> bytes:
        match frame:
            case Frame(Command.STOP):
                self._box.order(Stop())
            case Frame(Command.SET, azimuth_deg, elevation_deg):
                if azimuth_deg is not None:
                    self._box.order(aim(azimuth_deg, elevation_deg))
            case Frame(Command.MOVE, turn=Turn() as turn):
                for part, jog in _TURNS.items():
                    if part in turn:
                        self._box.order(jog)
        return self._position() if answers(self._model, frame.command) else b""

    def _position(self) -> bytes:
        """No answer while the position is not known: the client then reports a controller without power."""
        status = self._box.status()
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        if azimuth_deg is None:
            return b""
        if self._model is Model.ROT1PROG:
            return azimuth_reply(azimuth_deg)
        return b"" if elevation_deg is None else position_reply(azimuth_deg, elevation_deg, self._pulses)
