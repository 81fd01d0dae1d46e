"""A link on a file descriptor: what serial ports and pseudo-terminals share.

Knows non-blocking reading and writing on the event loop. Does not know how the descriptor was opened.
"""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable

from rotator.links.wire import Conversation

READ_BYTES = 4096


async def converse(fd: int, conversation: Conversation) -> str:
    """Pass the descriptor's bytes to `conversation` until reading fails. Returns the system's text for the failure."""
    loop = asyncio.get_running_loop()
    ended: asyncio.Future[str] = loop.create_future()

    def readable() -> None:
        try:
            data = os.read(fd, READ_BYTES)
        except BlockingIOError:
            return
        except OSError as fault:
            _end(ended, fault.strerror or str(fault))
            return
        if data:
            conversation.received(data)
        else:
            _end(ended, "hung up")

    loop.add_reader(fd, readable)
    try:
        return await ended
    finally:
        loop.remove_reader(fd)
        conversation.close()


def writer(fd: int) -> Callable[[bytes], None]:
    """The `write` of a conversation: one system call for each reply. Raises nothing: the reader notices a failure.

    When the program at the other end does not read, the kernel's buffer fills up. Then whole replies are dropped: a
    real controller's replies are lost too. If the kernel takes only a part of a reply, the rest is sent before the next
    reply.
    """
    rest = b""

    def write(data: bytes) -> None:
        nonlocal rest
        rest = rest[_put(fd, rest) :] if rest else b""
        if not rest:
            taken = _put(fd, data)
            rest = data[taken:] if taken else b""

    return write


def _put(fd: int, data: bytes) -> int:
    """Write what the kernel takes. Returns the number of bytes; 0 after an error."""
    try:
        return os.write(fd, data)
    except OSError:
        return 0


def _end(ended: asyncio.Future[str], why: str) -> None:
    if not ended.done():
        ended.set_result(why)
