"""The bytes of each controller, as its manual prints them: question, order, stop, answer."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from hw.controllers.codecs import Place, codec
from hw.ports import Axis, HardwareError

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
STATUS = bytes.fromhex("57 00000000 00 00000000 00 1f 20")
STOP = bytes.fromhex("57 00000000 00 00000000 00 0f 20")


@dataclass(frozen=True)
class Row:
    protocol: str
    axes: tuple[Axis, ...]
    ask: bytes
    answer: bytes
    place: Place
    order: bytes
    """To twice that place."""
    stop: bytes

    def __str__(self) -> str:
        return f"{self.protocol}-{'-'.join(axis.value for axis in self.axes)}"


# SPID: 360 + 123.5 are the digits 4 8 3 5; its order is (360 + 247) × 2 pulses, in ASCII.
ROT2PROG = bytes.fromhex("57 04080305 02 04000205 02 20")
ROWS = [
    Row("gs232a", (AZ, EL), b"C2\r", b"+0123+0040\r\n", (123, 40), b"W246 080\r", b"S\r"),
    Row("gs232b", (AZ, EL), b"C2\r", b"AZ=123  EL=040\r\n", (123, 40), b"W246 080\r", b"S\r"),
    Row("gs232b", (AZ,), b"C\r", b"AZ=123\r\n", (123,), b"M246\r", b"S\r"),
    Row("gs232a", (EL,), b"B\r", b"+0040\r\n", (40,), b"W000 080\r", b"S\r"),
    Row("easycomm2", (AZ, EL), b"AZ EL\n", b"AZ123.5 EL40.2\n", (123.5, 40.2), b"AZ247.0 EL80.4\n", b"SA SE\n"),
    Row("easycomm3", (EL,), b"EL\n", b"EL40.2\n", (40.2,), b"EL80.4\n", b"SA SE\n"),
    Row("rotctld", (AZ, EL), b"p\n", b"123.50\n40.25\n", (123.5, 40.25), b"P 247.00 80.50\n", b"S\n"),
    Row("rotctld", (EL,), b"p\n", b"0.000000\n40.250000\n", (40.25,), b"P 0.00 80.50\n", b"S\n"),
    Row("dcu1", (AZ,), b"AI1;", b";123", (123,), b"AP1246;AM1;", b";"),
    Row("rot2prog", (AZ, EL), STATUS, ROT2PROG, (123.5, 42.5),
        b"\x571214\x020890\x02\x2f\x20", STOP),
    Row("rot1prog", (AZ,), STATUS, bytes.fromhex("57 040803 20"), (123,), b"\x576060\x01\0\0\0\0\0\x2f\x20", STOP),
]  # fmt: skip
EACH_ROW = pytest.mark.parametrize("row", ROWS, ids=str)


@EACH_ROW
def test_what_it_is_asked_and_told(row: Row) -> None:
    spoken = codec(row.protocol, row.axes)
    spoken.feed(row.answer)
    assert spoken.ask() == row.ask
    assert spoken.move(tuple(2 * part for part in row.place)) == row.order
    assert spoken.stop() == row.stop


@EACH_ROW
def test_an_answer_whole_in_pieces_and_among_noise(row: Row) -> None:
    spoken = codec(row.protocol, row.axes)
    assert spoken.feed(row.answer) == [row.place]
    found = [place for octet in row.answer for place in spoken.feed(bytes([octet]))]
    assert found == [row.place]
    assert spoken.feed(b"\xff\x00?>\r\n" + row.answer + row.answer + row.answer[:3]) == [row.place, row.place]
    assert spoken.feed(row.answer[3:]) == [row.place]
    spoken.begin()
    assert spoken.junk == b""


@EACH_ROW
def test_another_baud_rate_is_no_answer(row: Row) -> None:
    spoken = codec(row.protocol, row.axes)
    assert spoken.feed(bytes(octet ^ 0xD5 for octet in 40 * row.answer)) == []
    assert spoken.junk


def test_a_rotctld_acknowledges_between_the_answers() -> None:
    assert codec("rotctld", (AZ, EL)).feed(b"RPRT 0\n123.00\n40.00\nRPRT 0\n124.00\n41.00\n") == [(123, 40), (124, 41)]


def test_a_rot2prog_is_told_nothing_before_it_has_said_its_pulses() -> None:
    assert codec("rot2prog", (AZ, EL)).move((10.0, 10.0)) == b""


@pytest.mark.parametrize("protocol", ["dcu1", "rot1prog"])
def test_a_protocol_of_one_axis_turns_one(protocol: str) -> None:
    with pytest.raises(HardwareError, match="controller of its own"):
        codec(protocol, (AZ, EL))
    assert codec(protocol, (EL,)).ask() == codec(protocol, (AZ,)).ask()
