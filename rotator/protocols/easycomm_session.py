"""One EasyComm connection: what each command makes the box do, and the answer.

Knows the meaning of the commands. Does not know the bytes (`easycomm` does), nor how the box carries out an order.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from hw.ports import Axis, Direction
from rotator import __version__
from rotator.exchange.faults import EasycommError
from rotator.exchange.orders import Jog, Order, Park, Stop
from rotator.protocols import easycomm
from rotator.protocols.aiming import aim
from rotator.protocols.easycomm import Level, Word
from rotator.protocols.lines import OVERLONG, LineTalk
from rotator.protocols.session import Box

NO_LINE_END_S = 0.2

_STOPS = {"SA": Axis.AZIMUTH, "SE": Axis.ELEVATION}
_TURNS = {
    "L": (Axis.AZIMUTH, Direction.MINUS),
    "R": (Axis.AZIMUTH, Direction.PLUS),
    "U": (Axis.ELEVATION, Direction.PLUS),
    "D": (Axis.ELEVATION, Direction.MINUS),
}
"""The second letter of a move or velocity command."""
_IDLE, _MOVING, _POINTING, _FAULT = 1, 2, 4, 8


class EasycommSession(LineTalk):
    """EasyComm on one connection. `pstrotator`: `AZ EL` is answered as PstRotator reads it.

    A refused order gets no alarm, although the standard has one: no client waits for an answer to an order, and over
    TCP Hamlib would take the alarm for the answer to its next question.
    """

    max_line = easycomm.MAX_LINE
    idle_s = NO_LINE_END_S

    def __init__(self, box: Box, level: Level, *, pstrotator: bool = False) -> None:
        self._box = box
        self._level = level
        self._pstrotator = pstrotator
        super().__init__()

    def idle(self) -> list[bytes]:
        return self._answers(self._lines.flush()) if easycomm.is_whole(self._lines.pending) else []

    def _answers(self, line: bytes | None) -> list[bytes]:
        words = easycomm.parse(line, self._level) if line else ()
        if line is None or (not words and easycomm.is_order(line)):
            self._box.note_refused(OVERLONG if line is None else line)
        replies = [self._obey(kind, list(group)) for kind, group in groupby(words, _kind)]
        return [reply for reply in replies if reply]

    def _obey(self, kind: str, words: list[Word]) -> bytes:
        match kind:
            case "ask":
                return self._position({word.verb for word in words})
            case "VE":
                return easycomm.reply("VE", __version__)
            case "GS":
                return easycomm.reply("GS", self._state())
            case "GE":
                return easycomm.reply("GE", self._faults())
        for order in _orders(kind, words):
            self._box.order(order)
        return b""

    def _position(self, asked: set[str]) -> bytes:
        status = self._box.status()
        azimuth_deg, elevation_deg = status.azimuth.points_deg, status.elevation.points_deg
        both = len(asked) > 1
        if (azimuth_deg is None and "AZ" in asked) or (elevation_deg is None and "EL" in asked):
            # EasyComm I has no message for this.
            return b"" if self._level is Level.I else easycomm.alarm("position not known")
        if self._pstrotator and both and azimuth_deg is not None and elevation_deg is not None:
            return easycomm.pstrotator_reply(azimuth_deg, elevation_deg)
        return easycomm.position_reply(azimuth_deg if "AZ" in asked else None, elevation_deg if "EL" in asked else None)

    def _state(self) -> int:
        status = self._box.status()
        targets = (status.azimuth.target_deg, status.elevation.target_deg)
        state = _MOVING if status.moving else 0
        state += _POINTING if targets != (None, None) else 0
        return (state or _IDLE) + (_FAULT if status.faults else 0)

    def _faults(self) -> int:
        status = self._box.status()
        errors = (
            EasycommError.NOT_CALIBRATED if status.azimuth.missing or status.elevation.missing else EasycommError(0)
        )
        for fault in status.faults:
            errors |= fault.kind.easycomm
        return int(errors)


def _orders(kind: str, words: list[Word]) -> Iterator[Order]:
    match kind:
        case "aim":
            angles_deg = {word.verb: word.value for word in words}
            yield aim(angles_deg.get("AZ"), angles_deg.get("EL"))
        case "stop":
            axes = {_STOPS[word.verb] for word in words}
            yield Stop() if len(axes) == len(_STOPS) else Stop(tuple(axes))
        case "PARK":
            yield Park()
        case "RESET":
            yield Stop()
        case _:
            for word in words:
                axis, direction = _TURNS[word.verb[1]]
                yield Stop((axis,)) if word.value == 0 else Jog(axis, direction)


def _kind(word: Word) -> str:
    """Words of one kind next to each other are one order, or one question."""
    match word:
        case Word("AZ" | "EL", None):
            return "ask"
        case Word("AZ" | "EL"):
            return "aim"
        case Word("SA" | "SE"):
            return "stop"
        case _:
            return word.verb
