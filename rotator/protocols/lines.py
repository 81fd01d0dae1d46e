"""Cuts a stream of bytes into lines, in bounded memory. Of a line that is too long a stop remains.

Knows the line ends CR, LF and CR LF; CR LF is one end, also where a pause separates the two. Does not know what the
lines mean.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from rotator.exchange.sources import Refusal
from rotator.protocols.damaged import is_stop
from rotator.protocols.session import Talk

OVERLONG = Refusal("a line is too long")
STOP = b"STOP"
"""What every protocol of lines understands as a damaged stop."""
CR = 0x0D
LF = 0x0A


@dataclass(slots=True)
class LineReader:
    """Feed it pieces; it returns whole lines without their ends. An empty line is b""."""

    limit: int
    """Longest line in bytes. A longer line is dropped to its end and returned as None; as STOP where it begins as one.
    """
    _buffer: bytearray = field(default_factory=bytearray)
    _overlong: bool = False
    _after_cr: bool = False
    """The last byte was a CR: an LF now is the second half of the same end."""

    def feed(self, data: bytes) -> list[bytes | None]:
        lines: list[bytes | None] = []
        start = 0
        for index, byte in enumerate(data):
            second_half, self._after_cr = byte == LF and self._after_cr, byte == CR
            if byte not in (CR, LF):
                continue
            if not second_half:
                self._take(data[start:index])
                lines.append(self.flush())
            start = index + 1
        self._take(data[start:])
        return lines

    def flush(self) -> bytes | None:
        """End the line here, as if a line end had come."""
        line = bytes(self._buffer)
        overlong, self._overlong = self._overlong, False
        self._buffer.clear()
        if overlong:
            return STOP if is_stop(line) else None
        return line

    def finish(self) -> list[bytes | None]:
        """The connection has ended: what has come of a line is a whole one."""
        return [self.flush()] if self._buffer else []

    @property
    def pending(self) -> bytes:
        """The bytes of a line whose end has not come yet."""
        return b"" if self._overlong else bytes(self._buffer)

    def _take(self, piece: bytes) -> None:
        room = self.limit - len(self._buffer)
        self._overlong = self._overlong or len(piece) > room
        self._buffer += piece[:room]


class LineTalk(Talk):
    """A session whose protocol is lines. It answers each, also None: one that was too long."""

    max_line = 0

    def __init__(self) -> None:
        self._lines = LineReader(self.max_line)

    def receive(self, data: bytes) -> list[bytes]:
        return [reply for line in self._lines.feed(data) for reply in self._answers(line)]

    def finish(self) -> list[bytes]:
        return [reply for line in self._lines.finish() for reply in self._answers(line)]

    def _answers(self, line: bytes | None) -> list[bytes]:
        raise NotImplementedError
