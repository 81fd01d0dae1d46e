"""Bytes over a file descriptor: sockets, pipes and terminals that end, fill up and break."""

from __future__ import annotations

import asyncio
import os
import socket
from collections.abc import Callable
from typing import Any

from rotator.links.fd import converse, writer
from rotator.links.wire import Conversation, Wire

PATIENCE_S = 30.0


async def test_both_ways_until_the_other_end_hangs_up(bench: Any, wire: Wire, end: Callable[..., Any]) -> None:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        ours.setblocking(False)
        conversation = Conversation(bench.gs232(), wire, writer(ours.fileno()))
        talking = asyncio.create_task(converse(ours.fileno(), conversation))
        client = end(os.dup(theirs.fileno()))
        assert await client.ask(b"C2\r") == b"AZ=235  EL=025\r\n"
        theirs.shutdown(socket.SHUT_RDWR)
        assert await asyncio.wait_for(talking, PATIENCE_S) == "hung up"
        assert not asyncio.get_running_loop().remove_reader(ours.fileno()), "nobody listens to it any more"


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


def test_where_nobody_reads_replies_are_dropped() -> None:
    reading, writing = os.pipe()
    try:
        os.set_blocking(writing, False)
        write = writer(writing)
        for _ in range(100_000):
            write(b"AZ=235  EL=025\r\n")
        assert os.read(reading, 32) == b"AZ=235  EL=025\r\n" * 2
    finally:
        os.close(reading)
        os.close(writing)


def test_writing_to_who_has_gone_is_nothing() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    writer(writing)(b"AZ=235  EL=025\r\n")
    os.close(writing)
