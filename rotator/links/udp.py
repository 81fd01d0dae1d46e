"""A UDP socket: each datagram is a message, and each sender has a separate conversation.

Knows datagrams, their senders, and where answers and reports go. Does not know what a datagram means.

A sender is an address without its port: many programs send each datagram from another port, and a stop must also hold
for the next datagram of the same program. UDP has no end of a connection, so a silent sender is forgotten.
"""

from __future__ import annotations

import asyncio
import logging
import socket
import time
from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from typing import Any

from rotator.links.listening import Allowed, cannot_listen
from rotator.links.wire import Conversation, LinkError, Wire, reason
from rotator.protocols.lines import STOP
from rotator.protocols.session import Session
from rotator.runtime.log_limit import LogLimit

log = logging.getLogger(__name__)

MOST_BYTES = 4096
MOST_SENDERS = 64
FORGOTTEN_AFTER_S = 60.0
"""Longer than the pause after which a stopped stream may move the antenna again. A shorter time would cancel a stop."""
LOOK_EVERY_S = 1.0
"""The time, in seconds, between two checks for a report that is due and for silent senders."""

Address = tuple[Any, ...]
"""(host, port); for IPv6 (host, port, flow, scope)."""


@dataclass(slots=True)
class _Sender:
    conversation: Conversation
    heard_s: float


@dataclass(frozen=True, slots=True)
class Report:
    """Datagrams that the box sends without a question.

    `due` is called once a second with the time in seconds. It returns a datagram for the address `to`, or None.
    """

    to: tuple[str, int]
    due: Callable[[float], bytes | None]


@dataclass(eq=False)
class UdpLink:
    """`session` makes the protocol's side for a new sender.

    `answer_port`: the port on which senders listen for answers; None: the protocol has no answers.
    """

    wire: Wire
    host: str
    port: int
    session: Callable[[], Session]
    _: KW_ONLY
    answer_port: int | None = None
    report: Report | None = None
    allowed: Allowed = field(default_factory=Allowed)
    clock: Callable[[], float] = time.monotonic
    _complaints: LogLimit = field(init=False)
    _senders: dict[str, _Sender] = field(default_factory=dict, init=False)
    _transport: asyncio.DatagramTransport | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        self._complaints = LogLimit(self.clock)

    async def open(self) -> None:
        """Raises LinkError."""
        try:
            transport, _ = await asyncio.get_running_loop().create_datagram_endpoint(
                lambda: _Socket(self.received, self._failed),
                local_addr=(self.host, self.port),
                # A name such as localhost may stand for both families; the programs that send here use IPv4 only.
                family=socket.AF_INET6 if ":" in self.host else socket.AF_INET,
                allow_broadcast=True,
            )
        except (OSError, UnicodeError) as fault:
            raise LinkError(cannot_listen(fault, self.host, self.port)) from fault
        self._transport = transport
        self.wire.state = "listening"

    async def run(self) -> None:
        assert self._transport is not None, "open() comes first"
        try:
            while True:
                self._forget_the_silent()
                self._send_report()
                await asyncio.sleep(LOOK_EVERY_S)
        finally:
            self.close()

    def close(self) -> None:
        """Give the port back. May be called twice."""
        if self._transport is not None:
            self._transport.abort()
        for sender in self._senders.values():
            sender.conversation.close()
        self.wire.state = "closed"

    def received(self, data: bytes, address: Address) -> None:
        """Pass one datagram from `address` to its sender's conversation."""
        host = str(address[0])
        if not self.allowed(host):
            self._complain(f"{host} is not in allow: not heard")
            return
        if len(data) > MOST_BYTES and STOP in data.upper():
            data = STOP
        if len(data) > MOST_BYTES:
            self._complain(f"{host}: a datagram of more than {MOST_BYTES} bytes is dropped")
            return
        sender = self._senders.get(host)
        if sender is None:
            if len(self._senders) >= MOST_SENDERS:
                self._complain(f"{MOST_SENDERS} senders already, {host} is not heard")
                return
            conversation = Conversation(self.session(), self.wire, lambda reply: self._answer(reply, address))
            sender = self._senders[host] = _Sender(conversation, self.clock())
            self._note()
        sender.heard_s = self.clock()
        sender.conversation.received(data)

    def _answer(self, reply: bytes, address: Address) -> None:
        if self._transport is not None and self.answer_port is not None:
            self._transport.sendto(reply, (address[0], self.answer_port, *address[2:]))

    def _send_report(self) -> None:
        """Send the report's datagram, if one is due."""
        if self.report is None or self._transport is None:
            return
        if datagram := self.report.due(self.clock()):
            self._transport.sendto(datagram, self.report.to)

    def _failed(self, fault: OSError) -> None:
        self._complain(f"cannot send: {reason(fault)}")

    def _forget_the_silent(self) -> None:
        now_s = self.clock()
        for host, sender in list(self._senders.items()):
            if now_s - sender.heard_s >= FORGOTTEN_AFTER_S:
                sender.conversation.close()
                del self._senders[host]
        self._note()

    def _complain(self, text: str) -> None:
        if line := self._complaints.admit(text):
            log.warning("%s: %s", self.wire.name, line)

    def _note(self) -> None:
        count = len(self._senders)
        self.wire.state = f"{count} sender{'s' if count != 1 else ''}" if count else "listening"


class _Socket(asyncio.DatagramProtocol):
    def __init__(self, received: Callable[[bytes, Address], None], failed: Callable[[OSError], None]) -> None:
        self._received = received
        self._failed = failed

    def datagram_received(self, data: bytes, addr: Address) -> None:
        self._received(data, addr)

    def error_received(self, exc: Exception) -> None:
        if isinstance(exc, OSError) and not isinstance(exc, ConnectionError):
            # A ConnectionError is not logged: it only means that the sender does not listen for answers.
            self._failed(exc)
