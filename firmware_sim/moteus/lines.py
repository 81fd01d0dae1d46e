"""The text protocol of an mjbots CAN-FD adapter, as a moteus controller's own UART speaks it.

Knows lines, checksums, the answers to `can send`, and the faults of the lines. Bytes go in; lines come out, each with
the moment when it is due. Knows no port and no other command. After the first line with a good checksum, each line must
have one.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field

from firmware_sim.moteus.bus import Frame, SimCan

LONGEST_LINE = 512
_SEND = re.compile(rb"can send ([0-9a-fA-F]+) ((?:[0-9a-fA-F]{2})*)((?: [BbFfRr]+)?)")
_SUM = re.compile(rb"(.*)\*([0-9a-fA-F]{2})", re.DOTALL)


def crc8(data: bytes) -> int:
    """Polynomial 0x97, from 0, most significant bit first."""
    crc = 0
    for octet in data:
        crc ^= octet
        for _ in range(8):
            crc = (crc << 1 ^ 0x97 if crc & 0x80 else crc << 1) & 0xFF
    return crc


@dataclass(slots=True)
class Mishaps:
    """Faults of the lines to the computer. They can be combined."""

    deaf: bool = False
    """The adapter does not handle the received lines, and sends none."""
    dropped: bool = False
    """The replies are lost; the adapter still sends its own OK."""
    garbled: bool = False
    """One character of each reply is wrong."""
    late_s: float = 0.0
    """The delay of each reply."""


@dataclass(slots=True)
class LineServer:
    """The adapter. `transcript` has the last 1000 lines without line ends: `>` from the computer, `<` to it."""

    can: SimCan
    clock: Callable[[], float]
    mishaps: Mishaps = field(default_factory=Mishaps)
    transcript: list[str] = field(default_factory=list)
    _pending: bytes = b""
    _summed: bool = False

    def receive(self, data: bytes) -> list[tuple[float, bytes]]:
        """Handle bytes from the computer. Returns the lines to it, each with the moment when it is due."""
        *lines, self._pending = re.split(rb"[\r\n]", self._pending + data)
        self._pending = self._pending if len(self._pending) <= LONGEST_LINE else b""
        return [] if self.mishaps.deaf else [due for line in lines if line for due in self._answer(line)]

    def _answer(self, line: bytes) -> list[tuple[float, bytes]]:
        self._note(">", line)
        now_s = self.clock()
        if found := _SUM.fullmatch(line):
            line, claimed = found[1], int(found[2], 16)
            if crc8(line) != claimed:
                return [(now_s, self._ended(b"ERR checksum"))]
            self._summed = True
        elif self._summed:
            return [(now_s, self._ended(b"ERR checksum"))]
        command = _SEND.fullmatch(line.rstrip(b" "))
        if command is None:
            return [(now_s, self._ended(b"ERR unknown command"))]
        replies = self.can.send(Frame(int(command[1], 16), bytes.fromhex(command[2].decode("ascii"))))
        ok = self._ended(b"OK")  # always before the replies
        heard = [] if self.mishaps.dropped else [self._reply(reply) for reply in replies]
        return [(now_s, ok), *((now_s + self.mishaps.late_s, line) for line in heard)]

    def _reply(self, reply: Frame) -> bytes:
        line = self._ended(f"rcv {reply.arbitration_id:08x} {reply.data.hex()}".encode("ascii"))
        if self.mishaps.garbled:
            return line[:14] + (b"0" if line[14:15] != b"0" else b"f") + line[15:]
        return line

    def _ended(self, line: bytes) -> bytes:
        if self._summed:
            line += b" "
            line += b"*%02X" % crc8(line)
        self._note("<", line)
        return line + b"\r\n"

    def _note(self, arrow: str, line: bytes) -> None:
        self.transcript.append(f"{arrow} {line.decode('latin1')}")
        del self.transcript[:-1000]
