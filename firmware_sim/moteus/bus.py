"""The CAN bus between a computer and its controllers: the controllers that get a frame, and their replies.

Knows CAN ids as moteus uses them, and controllers without supply. Knows neither the adapter's text lines nor what a
frame means. `SimTransport` has the shape of the library's own transport, so that the library runs on it in simulated
time. Not simulated: the time of a frame, arbitration, and bus errors.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from firmware_sim.moteus.controller import SimController
from firmware_sim.sporadic import Sporadic

WANTS_REPLY = 0x8000
EVERYBODY = 0x7F
NOP = b"\x50"
LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
"""Lengths that the data of a CAN-FD frame can have, in bytes."""


@dataclass(frozen=True, slots=True)
class Frame:
    """A CAN-FD frame."""

    arbitration_id: int
    data: bytes


class SimCan:
    """`controllers` by CAN id. Those in `muted` get no frame and send none: no supply, or a broken wire."""

    def __init__(self, controllers: Mapping[int, SimController]) -> None:
        self.controllers = controllers
        self.muted: set[int] = set()
        self.lapses: dict[int, tuple[Sporadic, ...]] = dict.fromkeys(controllers, ())
        """Fault: by CAN id, replies that are lost now and then."""

    def send(self, frame: Frame) -> list[Frame]:
        """Put a frame on the bus. Returns the replies."""
        destination, source = frame.arbitration_id & 0x7F, frame.arbitration_id >> 8 & 0x7F
        prefix = frame.arbitration_id >> 16
        replies = []
        for can_id, controller in self.controllers.items():
            if destination not in (can_id, EVERYBODY) or can_id in self.muted:
                continue
            answer = controller.handle(frame.data)
            lost = any(lapse.strikes() for lapse in self.lapses[can_id])
            if answer is not None and frame.arbitration_id & WANTS_REPLY and not lost:
                replies.append(Frame(prefix << 16 | can_id << 8 | source, answer))
        return replies


@dataclass(slots=True)
class _Received:
    """A reply in the shape that the library's parser needs."""

    arbitration_id: int
    data: bytes
    bus: int = 1


class SimTransport:
    """Takes the place of `moteus.Fdcanusb`. Each command is answered at once, except by a muted controller."""

    def __init__(self, can: SimCan) -> None:
        self._can = can
        self._parsed: dict[int, tuple[bytes, Any]] = {}
        """The latest reply of each controller, and what the library made of it: most are the same again."""

    async def cycle(self, commands: Sequence[Any]) -> list[Any]:
        results = []
        for command in commands:
            reply = WANTS_REPLY if command.reply_required else 0
            wanted = command.can_prefix << 16 | reply | command.source << 8 | command.destination
            replies = self._can.send(Frame(wanted, padded(command.data)))
            results += [self._parse(command, reply) for reply in replies]
        return results

    def _parse(self, command: Any, reply: Frame) -> Any:
        data, result = self._parsed.get(reply.arbitration_id, (b"", None))
        if data != reply.data or not data:
            result = command.parse(_Received(reply.arbitration_id, padded(reply.data)))
            self._parsed[reply.arbitration_id] = reply.data, result
        return result

    def close(self) -> None:
        pass


def padded(data: bytes) -> bytes:
    """`data` filled up to the next length that a CAN-FD frame can have."""
    return data.ljust(LENGTHS[bisect_left(LENGTHS, len(data))], NOP)
