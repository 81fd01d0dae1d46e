"""One connection to a SPID controller: what each frame makes the box do, and the answer.

Knows the meaning of the frames. Does not know the bytes (`spid` does), nor how the box carries out an order.
"""

from __future__ import annotations

from hw.ports import Axis, Direction
from rotator.exchange.orders import Jog, Stop
from rotator.protocols import spid
from rotator.protocols.aiming import aim
from rotator.protocols.session import Box, Talk
from rotator.protocols.spid import Command, Frame, FrameReader, Model, Turn

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
        return self._position() if spid.answers(self._model, frame.command) else b""

    def _position(self) -> bytes:
        """No answer while the position is not known: the client then reports a controller without power."""
        status = self._box.status()
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        if azimuth_deg is None:
            return b""
        if self._model is Model.ROT1PROG:
            return spid.azimuth_reply(azimuth_deg)
        return b"" if elevation_deg is None else spid.position_reply(azimuth_deg, elevation_deg, self._pulses)
