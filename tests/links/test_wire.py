"""A conversation: bytes in, each reply in one write, and silence told to those who want to know of it."""

from __future__ import annotations

import asyncio
import logging
from typing import Any

import pytest

from rotator.links.wire import Conversation, Wire

PATIENCE_S = 30.0


class Parrot:
    """Answers every byte with itself; `q` ends the connection, `!` is more than it can take."""

    def __init__(self, idle_s: float | None = None) -> None:
        self.idle_s = idle_s
        self.closed = False

    def receive(self, data: bytes) -> list[bytes]:
        if b"!" in data:
            raise ZeroDivisionError("a bug in a protocol")
        self.closed = b"q" in data
        return [bytes([byte]) * 3 for byte in data if byte != ord("q")]

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return [b"silence"]


class Clock(Parrot):
    """Also speaks unasked."""

    def __init__(self, every_s: float | None) -> None:
        super().__init__()
        self.every_s = every_s
        self.beats = 0

    def beat(self) -> list[bytes]:
        self.beats += 1
        if self.beats == 2:
            raise ZeroDivisionError("a bug in a protocol")
        self.closed = self.beats == 5
        return [b"tick"]


async def test_a_session_that_beats_speaks_unasked_until_the_end(wire: Wire) -> None:
    sent: asyncio.Queue[bytes] = asyncio.Queue()
    ended = asyncio.Event()
    clock = Clock(0.01)
    conversation = Conversation(clock, wire, sent.put_nowait, ended.set)
    await asyncio.wait_for(ended.wait(), PATIENCE_S)
    conversation.close()
    beats = clock.beats
    assert sent.qsize() >= 4, "the second beat fails, and the others go on"
    # What is closed beats no more, while another does.
    other: asyncio.Queue[bytes] = asyncio.Queue()
    later = Conversation(Clock(0.02), wire, other.put_nowait)
    await asyncio.wait_for(other.get(), PATIENCE_S)
    later.close()
    assert clock.beats == beats


def test_a_session_may_have_no_beat_and_needs_no_loop_then(wire: Wire) -> None:
    sent: list[bytes] = []
    Conversation(Clock(None), wire, sent.append).received(b"a")
    assert sent == [b"aaa"]


def test_replies_go_out_before_the_line_is_hung_up(wire: Wire) -> None:
    done: list[Any] = []
    conversation = Conversation(Parrot(), wire, done.append, lambda: done.append("hang up"))
    conversation.received(b"a")
    assert done == [b"aaa"]
    conversation.received(b"bq")
    assert done == [b"aaa", b"bbb", "hang up"]


def test_a_bug_in_a_protocol_costs_the_bytes_and_not_the_link(wire: Wire, caplog: pytest.LogCaptureFixture) -> None:
    sent: list[bytes] = []
    conversation = Conversation(Parrot(), wire, sent.append)
    conversation.received(b"a!")
    conversation.received(b"b")
    assert sent == [b"bbb"]
    (record,) = caplog.records
    assert record.levelno == logging.ERROR
    assert record.message == "link: the protocol failed; the bytes are dropped"


async def test_silence_is_told_once(wire: Wire) -> None:
    sent: asyncio.Queue[bytes] = asyncio.Queue()
    conversation = Conversation(Parrot(idle_s=0.01), wire, sent.put_nowait)
    for _ in range(3):
        conversation.received(b"a")
        assert await asyncio.wait_for(sent.get(), PATIENCE_S) == b"aaa"
        assert await asyncio.wait_for(sent.get(), PATIENCE_S) == b"silence"
    assert sent.empty()


async def test_silence_begins_anew_with_every_byte(wire: Wire) -> None:
    sent: asyncio.Queue[bytes] = asyncio.Queue()
    conversation = Conversation(Parrot(idle_s=0.01), wire, sent.put_nowait)
    conversation.received(b"a")
    conversation.received(b"b")
    replies = [await asyncio.wait_for(sent.get(), PATIENCE_S) for _ in range(3)]
    assert replies == [b"aaa", b"bbb", b"silence"]
    assert sent.empty()


async def test_a_closed_conversation_says_no_more(wire: Wire) -> None:
    first: asyncio.Queue[bytes] = asyncio.Queue()
    second: asyncio.Queue[bytes] = asyncio.Queue()
    closed = Conversation(Parrot(idle_s=0.01), wire, first.put_nowait)
    closed.received(b"a")
    closed.close()
    # Its silence would have come before this one's.
    other = Conversation(Parrot(idle_s=0.02), wire, second.put_nowait)
    other.received(b"b")
    assert [await asyncio.wait_for(second.get(), PATIENCE_S) for _ in range(2)] == [b"bbb", b"silence"]
    assert first.get_nowait() == b"aaa"
    assert first.empty()
