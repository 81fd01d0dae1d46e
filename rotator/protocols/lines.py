"""Cuts a stream of bytes into lines, whatever ends them, in bounded memory.

Knows CR, LF and CR LF. Knows nothing of what the lines say.
"""

from __future__ import annotations

from dataclasses import dataclass, field

CR = 0x0D
LF = 0x0A


@dataclass(slots=True)
class LineReader:
    """Feed it pieces; it gives whole lines without their ends. An empty line comes as b""."""

    limit: int
    """Longest line in bytes. A longer one is swallowed to its end and comes as None: something, but no line."""
    _buffer: bytearray = field(default_factory=bytearray)
    _overlong: bool = False

    def feed(self, data: bytes) -> list[bytes | None]:
        lines: list[bytes | None] = []
        start = 0
        for at, byte in enumerate(data):
            if byte not in (CR, LF):
                continue
            self._take(data[start:at])
            lines.append(self.flush())
            start = at + 1
        self._take(data[start:])
        return lines

    def flush(self) -> bytes | None:
        """End the line here, as if its end had come."""
        line = None if self._overlong else bytes(self._buffer)
        self._buffer.clear()
        self._overlong = False
        return line

    @property
    def pending(self) -> bytes:
        """What has come of a line whose end has not."""
        return bytes(self._buffer)

    def _take(self, piece: bytes) -> None:
        if self._overlong or len(self._buffer) + len(piece) > self.limit:
            self._overlong = True
            self._buffer.clear()
        else:
            self._buffer += piece
