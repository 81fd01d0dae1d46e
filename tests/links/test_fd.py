"""Bytes over a file descriptor: sockets, pipes and terminals that break, or that another reads too."""

from __future__ import annotations

import asyncio
import os
import socket
from typing import Any

from rotator.links.fd import converse, writer
from rotator.links.wire import Conversation, Wire

PATIENCE_S = 30.0


async def test_a_descriptor_that_fails_says_why(wire: Wire, new_ear: type[Any]) -> None:
    master, slave = os.openpty()
    os.set_blocking(master, False)
    os.close(slave)
    try:
        why = await asyncio.wait_for(converse(master, Conversation(new_ear(), wire, writer(master))), PATIENCE_S)
    finally:
        os.close(master)
    assert why == "Input/output error"


async def test_bytes_that_somebody_else_has_taken_are_not_missed(wire: Wire, new_ear: type[Any]) -> None:
    """Woken for bytes that are gone again, as happens with two readers: it goes on waiting."""

    ours, theirs = socket.socketpair()
    with ours, theirs, ours.dup() as copy:
        ear = new_ear()
        talking = []
        for reader in (ours, copy):
            reader.setblocking(False)
            conversation = Conversation(ear, wire, writer(reader.fileno()))
            talking.append(asyncio.create_task(converse(reader.fileno(), conversation)))
        for count in range(1, 20):
            theirs.send(b"C2\r")
            await ear.hears(3 * count)
        assert ear.heard == b"C2\r" * 19
        theirs.close()
        assert await asyncio.wait_for(asyncio.gather(*talking), PATIENCE_S) == ["hung up", "hung up"]
