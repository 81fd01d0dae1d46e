"""The register protocol inside a moteus's CAN-FD frame: subframes that write, read and answer.

Knows opcodes, number formats and varuints (mjbots, "moteus reference", subframes). Does not know what a register does;
the integer scales come from `registers`. Streams (opcodes 0x40 to 0x44) are not simulated: a frame ends where one
begins.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from enum import IntEnum
from functools import lru_cache
from typing import NamedTuple

from firmware_sim.moteus.registers import steps_of

WRITE, READ, REPLY = 0x00, 0x10, 0x20
WRITE_ERROR, READ_ERROR = 0x30, 0x31
NOP = 0x50

UNKNOWN_REGISTER, NOT_WRITEABLE = 1, 2


class Kind(IntEnum):
    """The format of a number; bits 2 and 3 of the opcode."""

    INT8 = 0
    INT16 = 1
    INT32 = 2
    F32 = 3


_KINDS = tuple(Kind)
_FORMATS = {
    Kind.INT8: struct.Struct("<b"),
    Kind.INT16: struct.Struct("<h"),
    Kind.INT32: struct.Struct("<i"),
    Kind.F32: struct.Struct("<f"),
}
_LARGEST = {Kind.INT8: 0x7F, Kind.INT16: 0x7FFF, Kind.INT32: 0x7FFFFFFF}


class Write(NamedTuple):  # a dozen of these a frame, 200 frames a second: a tuple is made faster
    """A subframe that writes one register."""

    register: int
    value: float
    """In the register's own unit; NaN where the sender gave the format's NaN."""


class Read(NamedTuple):
    """A subframe that asks for `length` registers from `first` on."""

    first: int
    length: int
    kind: Kind


class ShortFrameError(ValueError):
    """The frame ends in the middle of a subframe."""


def subframes(data: bytes) -> Iterator[Write | Read]:
    """The subframes of a frame, in order. Ends at an unknown opcode, as the firmware does. Raises ShortFrameError."""
    at = 0
    while at < len(data):
        opcode = data[at]
        at += 1
        if opcode == NOP:
            continue
        if opcode & 0xF0 not in (WRITE, READ):
            return
        kind = _KINDS[opcode >> 2 & 0b11]
        count = opcode & 0b11
        if not count:
            count, at = _varuint(data, at)
        first, at = _varuint(data, at)
        if opcode & 0xF0 == READ:
            yield Read(first, count, kind)
            continue
        for register in range(first, first + count):
            number, at = _number(kind, data, at)
            yield Write(register, from_wire(register, kind, number))


@lru_cache(maxsize=64)
def decoded(data: bytes) -> tuple[tuple[Write | Read, ...], bool]:
    """The subframes of a frame, and whether the last one is whole. A motor that holds gets the same frame each time."""
    parts: list[Write | Read] = []
    try:
        for part in subframes(data):
            parts.append(part)
    except ShortFrameError:
        return tuple(parts), False
    return tuple(parts), True


@lru_cache(maxsize=64)
def reply(read: Read, values: tuple[float, ...]) -> bytes:
    """The answer to a read, with the same opcode bits; `values` are in the registers' own units."""
    head = (
        bytes([REPLY | read.kind << 2 | read.length])
        if 1 <= read.length <= 3
        else bytes([REPLY | read.kind << 2, read.length])
    )
    body = b"".join([to_wire(register, read.kind, value) for register, value in enumerate(values, read.first)])
    return head + varuint(read.first) + body


def error(opcode: int, register: int, code: int) -> bytes:
    """The answer to a read or a write that failed."""
    return bytes([opcode]) + varuint(register) + varuint(code)


def from_wire(register: int, kind: Kind, number: float) -> float:
    """A number of the frame in the register's own unit."""
    step = steps_of(register)[kind] if kind is not Kind.F32 else 1
    if step == 1:  # a whole number has no NaN
        return number
    if number == -_LARGEST[kind] - 1:
        return math.nan
    return number * step


def to_wire(register: int, kind: Kind, value: float) -> bytes:
    """A value in the register's own unit as bytes of the frame."""
    if kind is Kind.F32:
        return _FORMATS[kind].pack(value)
    largest = _LARGEST[kind]
    step = steps_of(register)[kind]
    if step == 1:  # a whole number: its bits as they are
        width = largest + 1
        return _FORMATS[kind].pack((int(value) + width) % (2 * width) - width)
    if not math.isfinite(value):
        return _FORMATS[kind].pack(-largest - 1)
    return _FORMATS[kind].pack(max(-largest, min(largest, round(value / step))))


def varuint(value: int) -> bytes:
    """A number in groups of seven bits, lowest first; bit 7 is set on all bytes but the last."""
    if value < 0x80:
        return bytes((value,))
    octets = bytearray()
    while True:
        value, low = value >> 7, value & 0x7F
        octets.append(low | (0x80 if value else 0))
        if not value:
            return bytes(octets)


def _varuint(data: bytes, at: int) -> tuple[int, int]:
    if at < len(data) and data[at] < 0x80:
        return data[at], at + 1
    value = 0
    for shift in range(0, 35, 7):
        if at >= len(data):
            raise ShortFrameError
        value |= (data[at] & 0x7F) << shift
        at += 1
        if not data[at - 1] & 0x80:
            return value, at
    raise ShortFrameError


def _number(kind: Kind, data: bytes, at: int) -> tuple[float, int]:
    layout = _FORMATS[kind]
    if at + layout.size > len(data):
        raise ShortFrameError
    return layout.unpack_from(data, at)[0], at + layout.size
