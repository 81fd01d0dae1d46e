"""CAN FD through the kernel's own sockets: what a moteus controller is spoken to with."""

from __future__ import annotations

import socket
import struct
from collections.abc import Iterator

import pytest

from tests.kernel.bench.can import can_bus
from tests.kernel.bench.waiting import PATIENCE_S

FRAME = struct.Struct("<IBBxx64s")
BIT_RATE_SWITCH = 0x01  # CANFD_BRS, linux/can.h


def node(interface: str) -> socket.socket:
    node = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    node.setsockopt(socket.SOL_CAN_RAW, socket.CAN_RAW_FD_FRAMES, 1)
    node.bind((interface,))
    node.settimeout(PATIENCE_S)
    return node


@pytest.fixture
def bus() -> Iterator[str]:
    with can_bus() as name:
        yield name


@pytest.mark.parametrize("identifier", [0x001, 0x8001 | socket.CAN_EFF_FLAG], ids=["standard", "extended"])
def test_a_frame_of_64_bytes_arrives_with_its_flags(bus: str, identifier: int) -> None:
    data = bytes(range(64))
    with node(bus) as one, node(bus) as other:
        one.send(FRAME.pack(identifier, len(data), BIT_RATE_SWITCH, data))
        got, length, flags, payload = FRAME.unpack(other.recv(FRAME.size))
        assert (got, length, payload) == (identifier, 64, data)
        assert flags & BIT_RATE_SWITCH
