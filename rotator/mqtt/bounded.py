"""The library's client with a limit: a message that is too long is not read, whatever the broker keeps or passes on.

MQTT 3.1.1 has no Maximum Packet Size that a broker would keep to, and the library asks the system for a whole message
at once: 250 MB where a message has them. Its length comes before it. Knows the library and the beginning of a message.
"""

from __future__ import annotations

from dataclasses import dataclass

from paho.mqtt.client import Client
from paho.mqtt.enums import CallbackAPIVersion, MessageType

MOST_BYTES = 65_536
"""Sixteen times the longest order, so that a stop counts with nearly any content; small beside the program itself."""
BEGINNING_BYTES = 1024
"""Read of a longer message at a time, to learn its topic. The box's own topics are shorter."""


@dataclass(frozen=True, slots=True)
class TooLong:
    """`topic`: empty where the message names none. `kept`: it comes again with each new connection."""

    topic: str
    kept: bool


class BoundedClient(Client):
    """`too_long`: the message for which the connection was ended; None: none was."""

    def __init__(self) -> None:
        # A clean session at QoS 0: the broker keeps no order for a box that is away.
        super().__init__(CallbackAPIVersion.VERSION2, clean_session=True, reconnect_on_failure=False)
        self.too_long: TooLong | None = None
        self._beginning = b""

    def _sock_recv(self, bufsize: int) -> bytes:
        """The library asks for single bytes of the header, then for all that is missing of the message."""
        if bufsize <= MOST_BYTES:
            self._beginning = b""
            data: bytes = super()._sock_recv(bufsize)
            return data
        data = super()._sock_recv(BEGINNING_BYTES)
        self._beginning += data
        command, said = self._in_packet["command"], self._beginning
        published = command & 0xF0 == MessageType.PUBLISH
        ends = 2 + int.from_bytes(said[:2], "big")
        if published and data and len(said) < min(ends, BEGINNING_BYTES):
            return data
        topic = said[2:ends].decode("utf-8", "replace") if published else ""
        self.too_long = TooLong(topic, kept=published and bool(command & 1))
        raise ConnectionAbortedError("a message is too long")
