"""What a protocol sees of the box, and what a link sees of a protocol.

Knows the two narrow interfaces between links, protocols and the box. Knows no protocol and no link.
"""

from __future__ import annotations

from typing import Protocol

from rotator.orders import Order, Refusal
from rotator.status import Status


class Box(Protocol):
    """The box, as one connection sees it."""

    def status(self) -> Status:
        """The latest status: a stored value, so asking costs nothing and never waits."""

    def order(self, order: Order) -> Refusal | None:
        """Hand over an order. A Refusal means that nothing will come of it, and why; the log has it already."""


class Session(Protocol):
    """One connection's side of a protocol: bytes in, replies out."""

    @property
    def idle_s(self) -> float | None:
        """After so long a silence the link calls `idle` (None: never): for clients that end no line."""

    @property
    def closed(self) -> bool:
        """The client asked to end the connection."""

    def receive(self, data: bytes) -> list[bytes]:
        """Take bytes as they arrive, in any pieces. Returns replies; each is to be sent in one write."""

    def idle(self) -> list[bytes]:
        """The line has been silent for `idle_s`: what is buffered is all that will come."""


class NotUnderstood(Exception):  # noqa: N818 - what the other end says, no failure of the program
    """The other end does not speak this protocol; the text says what it said."""


class Inquiry(Protocol):
    """One connection's side of a protocol in which the box asks, and the other end answers."""

    @property
    def trouble(self) -> str:
        """What is wrong with the last answer, though it was one; empty: nothing."""

    def ask(self) -> bytes:
        """The next question. What is left of an earlier answer is forgotten."""

    def receive(self, data: bytes) -> bool:
        """Take bytes as they arrive, in any pieces. True: the answer is whole. Raises NotUnderstood."""
