"""The cable to a controller: a serial port, a URL of pyserial such as rfc2217://, or a TCP connection.

Knows how to open it and how bytes go through it. Does not know what they mean, nor when to try again.
"""

from __future__ import annotations

import errno
import os
import select
import socket
from typing import Any, Protocol

OPEN_S = 3.0
"""A machine that is off is given up after this time."""
WRITE_S = 0.3
"""A peer that takes no byte for this long is lost. The lines are short: they fit into any buffer."""


class Port(Protocol):
    """An open connection. `read` and `write` are for one thread each; a failure of either is an OSError."""

    def read(self, patience_s: float) -> bytes:
        """What has come, after `patience_s` seconds at most; empty: nothing has come."""

    def write(self, data: bytes) -> None: ...

    def close(self) -> None: ...


class TcpPort:
    """A stop leaves at once: without TCP_NODELAY it would wait until the answer to the question before it is there."""

    def __init__(self, host: str, port: int) -> None:
        self._socket = socket.create_connection((host, port), OPEN_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket.settimeout(WRITE_S)

    def read(self, patience_s: float) -> bytes:
        if not select.select([self._socket], [], [], patience_s)[0]:
            return b""
        data = self._socket.recv(4096)
        if not data:
            raise ConnectionError("the other end has closed the connection")
        return data

    def write(self, data: bytes) -> None:
        self._socket.sendall(data)

    def close(self) -> None:
        self._socket.close()


class SerialPort:
    """`name`: a device, or a URL of pyserial."""

    def __init__(self, name: str, baud: int) -> None:
        import serial  # noqa: PLC0415 - only a box with such a controller needs it here

        # pyserial's rfc2217:// takes no time limit for writing.
        limit: dict[str, Any] = {} if "://" in name else {"write_timeout": WRITE_S}
        self._port: Any = serial.serial_for_url(name, baud, timeout=0.1, **limit)

    def read(self, patience_s: float) -> bytes:
        # Over rfc2217:// each change of a setting is a negotiation with the other end: the timeout stays as it is.
        del patience_s
        try:
            data: bytes = self._port.read(1)
            return data + self._port.read(self._port.in_waiting) if data else data
        except (TypeError, ValueError) as closed:  # pyserial's way to say that `close` came meanwhile
            raise OSError("closed") from closed

    def write(self, data: bytes) -> None:
        self._port.write(data)

    def close(self) -> None:
        self._port.close()


def why(fault: Exception) -> str:
    """A failure in words for the user."""
    match fault:
        case OSError(errno=errno.ENOENT):
            return "there is no such port: is it plugged in? `ls /dev/serial/by-id` shows what is"
        case OSError(errno=errno.EACCES):
            return "no permission: `sudo usermod -aG dialout $USER`, then log in again"
        case ConnectionRefusedError():
            return "nobody listens there: start the program that should"
        case TimeoutError():
            return "no answer from that machine: see whether it is on, and in this network"
        case OSError(errno=int() as number):
            return os.strerror(number)
        case _:
            return str(fault)
