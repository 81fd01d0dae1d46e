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
    """Carry bytes both ways until the descriptor fails. Returns why, in the system's words."""
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
    """A `write` for a conversation: one system call for each reply. Raises nothing: the reader notices a failure.

    When the program at the other end does not read, the kernel's buffer fills. Then replies are dropped, as those of a
    real unit are lost. A reply of which the kernel took only the beginning is completed before the next one.
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
    try:
        return os.write(fd, data)
    except OSError:
        return 0


def _end(ended: asyncio.Future[str], why: str) -> None:
    if not ended.done():
        ended.set_result(why)
