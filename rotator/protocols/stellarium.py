"""Stellarium's telescope protocol: 20 bytes are a target, 24 bytes are where the antenna points, twice a second.

Knows the frames, in right ascension and declination J2000, and what a target makes the box do. Does not know where a
star stands: `sky` does. Source: Stellarium's description of the protocol, and what its telescope plug-in sends and
reads (see docs/reference/wire.md).
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass

from rotator.control.sky.angles import direction
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.protocols.session import Box, Talk
from rotator.protocols.star_follower import StarFollower

POSITION_EVERY_S = 0.5
_HEAD = struct.Struct("<HH")
_GOTO = struct.Struct("<HHqIi")
_POSITION = struct.Struct("<HHqIii")
_TYPE = 0
"""Of a target and of a position alike."""
_HALF_TURN = 0x8000_0000
_QUARTER_TURN = 0x4000_0000
_MICROSECONDS = 1_000_000


@dataclass(frozen=True, slots=True)
class Goto:
    """A target, and the sender's time in seconds since 1970."""

    star: Star
    at_s: float


def decode(frame: bytes) -> Goto | None:
    """The target in a frame of 20 bytes; None: it is no target."""
    if len(frame) != _GOTO.size:
        return None
    size, kind, micros, right_ascension, declination = _GOTO.unpack(frame)
    if size != _GOTO.size or kind != _TYPE or abs(declination) > _QUARTER_TURN:
        return None
    star = Star(right_ascension / _HALF_TURN * 180.0, declination / _HALF_TURN * 180.0, Equinox.J2000)
    return Goto(star, micros / _MICROSECONDS)


def encode(goto: Goto) -> bytes:
    """A target as Stellarium sends it."""
    return _GOTO.pack(_GOTO.size, _TYPE, round(goto.at_s * _MICROSECONDS), *_turns(goto.star))


def position(star: Star, at_s: float) -> bytes:
    """Where the antenna points, with the time and a zero for a good state."""
    return _POSITION.pack(_POSITION.size, _TYPE, round(at_s * _MICROSECONDS), *_turns(star), 0)


def _turns(star: Star) -> tuple[int, int]:
    right_ascension = round(star.right_ascension_deg / 180.0 * _HALF_TURN) % (2 * _HALF_TURN)
    return right_ascension, round(star.declination_deg / 180.0 * _HALF_TURN)


class StellariumSession(Talk):
    """Stellarium on one connection. A frame that is no target ends the connection, and the rest is not read.

    `remark` takes a line for the log: the protocol has no answer for a refusal.
    """

    every_s = POSITION_EVERY_S

    def __init__(self, box: Box, sky: Sky, remark: Callable[[str], None] = lambda _text: None) -> None:
        self._box = box
        self._sky = sky
        self._remark = remark
        self._follower = StarFollower(box, sky, remark)
        self._buffer = bytearray()

    def receive(self, data: bytes) -> list[bytes]:
        self._buffer += b"" if self.closed else data
        while len(self._buffer) >= _HEAD.size and not self.closed:
            if _HEAD.unpack_from(self._buffer) != (_GOTO.size, _TYPE):
                self._damaged()
            elif len(self._buffer) < _GOTO.size:
                break
            elif goto := decode(bytes(self._buffer[: _GOTO.size])):
                del self._buffer[: _GOTO.size]
                self._follower.go(goto.star)
            else:
                self._damaged()
        return []

    def beat(self) -> list[bytes]:
        """Where the antenna points; nothing while that is not known."""
        self._follower.beat()
        status = self._box.status()
        if status.azimuth.points_deg is None or status.elevation.points_deg is None or self.closed:
            return []
        pointing = direction(status.azimuth.points_deg, status.elevation.points_deg)
        return [position(self._sky.star(*pointing, Equinox.J2000), self._sky.utc())]

    def _damaged(self) -> None:
        self._remark(f"this is not Stellarium's telescope protocol: {bytes(self._buffer[:8]).hex(' ')}")
        self._buffer.clear()
        self.closed = True
