"""The adapter's lines and the multiplex protocol inside them, against what mjbots' library was recorded to say.

`>` is what the library writes, `<` what comes back; the checksums were recorded too.
"""

from __future__ import annotations

import math

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.moteus import multiplex
from firmware_sim.moteus.bus import SimCan
from firmware_sim.moteus.controller import SimController
from firmware_sim.moteus.lines import LineServer, crc8
from firmware_sim.moteus.multiplex import Kind, Read, Write
from tests.tables import every_row

RESTING = "2100002f010000803e0000000000000000230d301900"
"""Stopped at 0.25 revolutions, 24 V, 25 degrees, no fault."""


class Bench:
    def __init__(self) -> None:
        self.clock = SimClock()
        self.first = SimController(self.clock, shaft_rev=0.25, serial=1)
        self.second = SimController(self.clock, shaft_rev=-1.5, serial=2)
        self.can = SimCan({1: self.first, 2: self.second})
        self.server = LineServer(self.can, self.clock)

    def say(self, line: str) -> list[str]:
        return [answer.decode().removesuffix("\r\n") for _, answer in self.server.receive(line.encode() + b"\n")]


# --- recorded


@pytest.mark.parametrize(
    ("line", "answers"),
    [
        ("can send 8001 11001F01130D BF *AD", ["OK *BD", f"rcv 00000100 {RESTING} *3D"]),
        (
            "can send 8002 11001F01130D BF *8C",
            ["OK *BD", "rcv 00000200 2100002f010000c0bf0000000000000000230d301900 *73"],
        ),
        ("can send 0001 010000 BF *FE", ["OK *BD"]),
    ],
    ids=["query 1", "query 2", "stop, no answer asked"],
)
def test_recorded_with_sums(line: str, answers: list[str]) -> None:
    assert Bench().say(line) == answers


def test_discovery_everybody_says_who_he_is() -> None:
    bench = Bench()
    ok, *answers = bench.say("can send 807f 1804D00211D802 BF")
    assert ok == "OK"
    assert answers == [
        f"rcv 0000{can_id:02x}00 2804d002{controller.uuid.hex()}21d80201"
        for can_id, controller in bench.can.controllers.items()
    ]


# --- lines that are no good


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("can send 8001 11001F01130D BF *AE", "ERR checksum"),
        ("can spend 8001 1100 BF", "ERR unknown command"),
        ("can send 8001 110 BF", "ERR unknown command"),
        ("tel stop", "ERR unknown command"),
    ],
)
def test_nonsense_is_answered_and_moves_nothing(line: str, answer: str) -> None:
    assert Bench().say(line) == [answer]


# --- mishaps, as the computer sees them


def test_dropped_garbled_and_late() -> None:
    bench = Bench()
    query = "can send 8001 11001F01130D BF *AD"
    bench.server.mishaps.dropped = True
    assert bench.say(query) == ["OK *BD"]
    bench.server.mishaps.dropped, bench.server.mishaps.garbled = False, True
    body, claimed = bench.say(query)[1].split("*")
    assert crc8(body.encode()) != int(claimed, 16)
    bench.server.mishaps.garbled, bench.server.mishaps.late_s = False, 0.3
    assert [due_s for due_s, _ in bench.server.receive(query.encode() + b"\n")] == [0.0, 0.3]


# --- the frame


@every_row(
    ("frame", "parts"),
    [
        ("01000A0D200000003F", [Write(0, 10), Write(0x20, 0.5)]),
        ("01000A0E200000C07F00000000", [Write(0, 10), Write(0x20, math.nan), Write(0x21, 0.0)]),
        ("0DB10200000000", [Write(0x131, 0.0)]),
        ("01272A", [Write(0x27, 0.42)]),
        ("052010275050", [Write(0x20, 1.0)]),
        ("092000000080", [Write(0x20, math.nan)]),
        ("1804D002", [Read(0x150, 4, Kind.INT32)]),
        ("5050", []),
        ("40010011", []),
    ],
)
def test_subframes(frame: str, parts: list[Write | Read]) -> None:
    assert str(list(multiplex.subframes(bytes.fromhex(frame)))) == str(parts)
