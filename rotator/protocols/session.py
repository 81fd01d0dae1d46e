"""The interfaces between links, protocols and the box.

Knows how a protocol sees the box, and how a link sees a protocol. Does not know any protocol or link.
"""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from rotator.control.sky.timed_table import TimedTable
from rotator.exchange.orders import Order
from rotator.exchange.sources import Refusal
from rotator.exchange.status import Status


class Box(Protocol):
    """The box, as one connection sees it."""

    def status(self) -> Status:
        """The latest status: a stored value, so the call never waits."""

    def order(self, order: Order) -> Refusal | None:
        """Hand over an order. A Refusal: the order has no effect, with the reason; it is in the log already."""

    def note_refused(self, refused: Refusal | bytes) -> None:
        """For the log: why the protocol itself refuses an order, or the bytes that it does not understand."""


class Tracking(Protocol):
    """What tracks targets of the sky by itself. No call waits."""

    def track(self, words: str) -> str:
        """Begin to track. Returns why not; empty: it does."""

    def program(self, table: TimedTable) -> str:
        """Begin to track a timed table. Returns why not; empty: it does."""

    def demo(self, zone: str, times: int) -> str:
        """Begin to fly the demo pass over the continent of this time zone. Returns why not; empty: it does."""

    def follow_plan(self) -> str:
        """Leave the antenna to the plan of many passes. Returns why not; empty: it has it."""

    def off(self) -> None:
        """End it; the antenna stops."""

    @property
    def goes_on_with(self) -> str:
        """What a stop or another sender has ended, in a person's words; empty: nothing."""

    def clock_is_right(self) -> None:
        """A person says that this computer's clock is right."""

    @property
    def state(self) -> str:
        """`off`, `planning`, `tracking`; `ended: `, `refused: ` or `rests: `, and the reason."""


class Pairing(Protocol):
    """Who may use the page to move the antenna. Any thread may call it; no call waits for longer than a disk."""

    def begin(self) -> str:
        """A new code of six digits, for a browser that shall be paired."""

    def paired(self) -> list[str]:
        """A line for each browser and program that is paired: its number first."""

    def token(self, name: str) -> str:
        """A token for a program of this name, shown this once."""

    def revoke(self, number: int) -> str:
        """Pair this one no more. Returns why not; empty: done."""


class Session(Protocol):
    """One connection's side of a protocol: bytes in, replies out."""

    @property
    def idle_s(self) -> float | None:
        """After this silence the link calls `idle`, for clients that send no line end. None: never."""

    @property
    def closed(self) -> bool:
        """The client asked to end the connection."""

    def receive(self, data: bytes) -> list[bytes]:
        """Take bytes as they arrive, in any pieces. Returns replies; the link sends each in one write."""

    def idle(self) -> list[bytes]:
        """The line has been silent for `idle_s`: the buffered bytes are all that will come."""

    def finish(self) -> list[bytes]:
        """The client has ended the connection: the end of a line too, as of `echo -n "P 180 45" | nc`."""


class Talk:
    """What a session is as long as it does not say otherwise: nothing happens in a silence, nor at the end."""

    idle_s: float | None = None
    closed = False

    def idle(self) -> list[bytes]:
        return []

    def finish(self) -> list[bytes]:
        return []


@runtime_checkable
class Ending(Protocol):
    """A session that has something to do when its connection ends."""

    def ended(self) -> None:
        """The connection has ended: the client has left, or its cable is out."""


@runtime_checkable
class Addressed(Protocol):
    """A session that may know the machine at the other end."""

    def comes_from(self, host: str) -> None:
        """The client's machine has this address."""


@runtime_checkable
class ClockedSession(Protocol):
    """A session that also works without bytes from its program: it sends unasked, or follows a moving target."""

    @property
    def every_s(self) -> float | None:
        """The time between two calls of `beat`, as long as the connection lasts. None: never."""

    def beat(self) -> list[bytes]:
        """Do what is due now. Returns bytes for the program; the link sends each in one write."""


class NotUnderstood(Exception):  # noqa: N818 - a fact about the other end; the program has not failed
    """The other end does not speak this protocol; the text shows its bytes."""


class Inquiry(Protocol):
    """One connection's side of a protocol in which the box asks, and the other end answers."""

    @property
    def trouble(self) -> str:
        """What is wrong with the last answer, though it was complete; empty: nothing."""

    def ask(self) -> bytes:
        """The next question. The rest of an earlier answer is dropped."""

    def receive(self, data: bytes) -> bool:
        """Take bytes as they arrive, in any pieces. True: the answer is whole. Raises NotUnderstood."""
