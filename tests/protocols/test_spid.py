"""SPID's frames, both ways, as LA6YKA's description and recordings of Hamlib have them; and among other bytes."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rotator.protocols import spid
from rotator.protocols.spid import TURNS, Command, Frame, FrameReader, Model, Turn, decode, encode
from tests.tables import every_row

Feed = Callable[[FrameReader, bytes], list[Frame]]
ROT1, ROT2, MD01 = Model.ROT1PROG, Model.ROT2PROG, Model.MD01


def octets(text: str) -> bytes:
    return bytes.fromhex(text)


STATUS = octets("57 00 00 00 00 00 00 00 00 00 00 1F 20")
STOP = octets("57 00 00 00 00 00 00 00 00 00 00 0F 20")
SET_123_77 = octets("57 30 39 36 37 02 30 38 37 34 02 2F 20")
LEFT = octets("57 01 00 00 00 00 00 00 00 00 00 14 20")

RECORDED = [
    (ROT1, 1, STATUS, Frame(Command.STATUS)),
    (ROT2, 2, STATUS, Frame(Command.STATUS)),
    (MD01, 10, STATUS, Frame(Command.STATUS)),
    (ROT1, 1, STOP, Frame(Command.STOP)),
    (ROT2, 2, STOP, Frame(Command.STOP)),
    (MD01, 10, STOP, Frame(Command.STOP)),
    (ROT1, 1, octets("57 34 38 33 30 00 00 00 00 00 00 2F 20"), Frame(Command.SET, 123)),
    (ROT2, 1, octets("57 30 34 38 33 01 30 34 33 37 01 2F 20"), Frame(Command.SET, 123, 77)),
    (ROT2, 2, SET_123_77, Frame(Command.SET, 123.5, 77)),
    (ROT2, 4, octets("57 31 39 33 35 04 31 37 34 39 04 2F 20"), Frame(Command.SET, 123.75, 77.25)),
    (MD01, 10, octets("57 34 38 33 33 0A 34 33 37 33 0A 2F 20"), Frame(Command.SET, 483.3 - 360, 437.3 - 360)),
    (MD01, 10, octets("57 31 38 30 30 0A 33 34 30 30 0A 2F 20"), Frame(Command.SET, -180, -20)),
    (MD01, 10, LEFT, Frame(Command.MOVE, turn=Turn.LEFT)),
    (MD01, 10, octets("57 06 00 00 00 00 00 00 00 00 00 14 20"), Frame(Command.MOVE, turn=Turn.RIGHT | Turn.UP)),
]


@every_row(("model", "pulses", "wire", "frame"), RECORDED)
def test_reads_what_it_writes_and_writes_what_it_reads(model: Model, pulses: int, wire: bytes, frame: Frame) -> None:
    assert decode(wire, model, pulses) == frame
    assert encode(frame, model, pulses) == wire


def test_every_row_of_the_table_is_written_and_read_above() -> None:
    assert {(row.command, model) for row in spid.ROWS for model in row.models} == {
        (frame.command, model) for model, _, _, frame in RECORDED
    }


@pytest.mark.parametrize(
    ("model", "pulses", "azimuth_deg", "digits"),
    [(ROT2, 1, 123.3, b"0483"), (ROT2, 2, 123.7, b"0967"), (ROT1, 1, 123.7, b"4830")],
)
def test_angles_are_cut_as_hamlib_cuts_them(model: Model, pulses: int, azimuth_deg: float, digits: bytes) -> None:
    assert encode(Frame(Command.SET, azimuth_deg, 0), model, pulses)[1:5] == digits


@every_row("garbage", [0x00, 0x7F, 0xAC, 0x57, 0x20])
def test_what_hamlib_leaves_in_a_moves_fifth_and_tenth_byte_means_nothing(garbage: int) -> None:
    wire = bytearray(LEFT)
    wire[5] = wire[10] = garbage
    assert FrameReader(MD01, 10).feed(bytes(wire)) == [Frame(Command.MOVE, turn=Turn.LEFT)]


@every_row("pulses_sent", [0, 1, 2, 10, 0xFF])
def test_a_controller_counts_its_own_pulses_not_the_clients(pulses_sent: int) -> None:
    wire = bytearray(SET_123_77)
    wire[5] = wire[10] = pulses_sent
    assert decode(bytes(wire), ROT2, 2) == Frame(Command.SET, 123.5, 77)


def test_a_move_names_no_opposites() -> None:
    assert [turn.value for turn in TURNS] == [4, 8, 1, 5, 9, 2, 6, 10]
    for first in range(256):
        wire = octets("57") + bytes([first]) + LEFT[2:]
        assert (decode(wire, MD01, 10) is not None) == (first in {1, 2, 4, 8, 5, 9, 6, 10})


NO_FRAMES = [
    SET_123_77[:-1] + b"\x21",  # no end byte
    SET_123_77[:-1] + b"\x57",
    b"\x58" + SET_123_77[1:],  # no start byte
    SET_123_77[:11] + b"\x3f\x20",  # no such command
    SET_123_77[:1] + b"\x00" + SET_123_77[2:],  # values for digits
    SET_123_77[:2] + b"\x3a" + SET_123_77[3:],
    SET_123_77[:6] + b"-" + SET_123_77[7:],
    SET_123_77[:6] + b" " + SET_123_77[7:],
    SET_123_77[:3] + SET_123_77[4:],  # one byte lost
    SET_123_77[:3] + b"0" + SET_123_77[3:],  # one too many
    b"W235 025\rW23",
    b"W" * 30,
    b"",
]


@pytest.fixture(params=[13, 1, 3], ids=["whole", "byte by byte", "in threes"])
def feed(request: pytest.FixtureRequest) -> Feed:
    def pieces(reader: FrameReader, data: bytes) -> list[Frame]:
        size = request.param
        return [frame for at in range(0, len(data), size) for frame in reader.feed(data[at : at + size])]

    return pieces


@every_row("junk", NO_FRAMES)
@every_row("model", [ROT2, MD01])
def test_what_is_no_frame_is_passed_over_and_the_next_is_found(feed: Feed, model: Model, junk: bytes) -> None:
    reader = FrameReader(model, 2)
    assert feed(reader, junk) == []
    assert feed(reader, SET_123_77 + STOP) == [Frame(Command.SET, 123.5, 77), Frame(Command.STOP)]


@every_row("kept", range(13))
def test_a_frame_that_was_cut_off_spoils_no_other_and_becomes_none(feed: Feed, kept: int) -> None:
    reader = FrameReader(ROT2, 2)
    assert feed(reader, SET_123_77[:kept] + STOP + STATUS) == [Frame(Command.STOP), Frame(Command.STATUS)]


@every_row(
    ("azimuth_deg", "elevation_deg", "pulses", "reply"),
    [
        (12.5, 34.0, 2, "57 03 07 02 05 02 03 09 04 00 02 20"),
        (123.5, 77.0, 2, "57 04 08 03 05 02 04 03 07 00 02 20"),
        (123.34, 77.35, 10, "57 04 08 03 03 0A 04 03 07 04 0A 20"),
        (-180.0, -20.0, 1, "57 01 08 00 00 01 03 04 00 00 01 20"),
        (-0.04, 0.0, 1, "57 03 06 00 00 01 03 06 00 00 01 20"),
        (700.0, -400.0, 1, "57 09 09 09 09 01 00 00 00 00 01 20"),
    ],
)
def test_positions(azimuth_deg: float, elevation_deg: float, pulses: int, reply: str) -> None:
    assert spid.position_reply(azimuth_deg, elevation_deg, pulses) == octets(reply)


@pytest.mark.parametrize(
    ("azimuth_deg", "reply"), [(12.0, "57 03 07 02 20"), (12.5, "57 03 07 03 20"), (-0.6, "57 03 05 09 20")]
)
def test_rot1progs_positions(azimuth_deg: float, reply: str) -> None:
    assert spid.azimuth_reply(azimuth_deg) == octets(reply)
