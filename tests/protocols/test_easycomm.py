"""EasyComm's words, both ways: as the standard writes them, as Hamlib does, and as they come damaged."""

from __future__ import annotations

import pytest

from rotator.protocols import easycomm
from rotator.protocols.easycomm import VERBS, Level, Word, is_whole, parse
from tests.tables import every_row


@every_row(
    "line",
    [
        b"AZ235.5 EL25.0",
        b"EL25.0 AZ235.5",
        b"AZ235.5 EL25.0 ",  # WispDDE
        b"AZ235,5 EL25,0",  # a European desktop
        b"AZ+235.5 EL+25",
        b"AZ235.50000 EL25.",
        b"AZ2.355e+02 EL250e-1",  # a Java client
        b"AZ235.50000000000000001 EL25.000000000000000001",
        b"AZ 235.5 EL 25.0",  # the builder of the servos
        b"EL  25 AZ 235.5",
        b"az235.5 el25.0",  # by hand
        b"\tAZ235.5\tEL25.0",
        b"AZ235.5;EL25.0",
        b";AZ235.5 EL25.0",  # Hamlib leaves the `;` of `GS\n;` in front of the next command
        b"\0\xff AZ235.5 EL25.0",  # a port being plugged in
        b"AZ235.5EL25.0",
        b"AZ235.5 EL25.0 \x00",
        b"AZ235.5 EL25.0\x00",
        b"AZ235.5\xff EL25.0",
        b"12:30:01 AZ235.5 / EL25.0",
        b"SAT-1 (HAZEL) AZ235.5 [DELTA] EL25.0 ok",
        b"x\x80#AZ235.5 \x07 17 EL25.0",
        b"EL25.0 km 1200 AZ235.5 12.5",
        b"UP145900000AZ235.5EL25.0DN435800000",
        b"to:AZ235.5 EL25.0 !",
        b"AZ235.5 EL25.0 UP000 XXX DN000 XXX",  # Hamlib's EasyComm I
        b"AZ235.5 EL25.0 UP145900000 USB DN435800000 CW",
        b"UP145900000 UMFM DN435800000 DMFM DR1 UR2 AZ235.5 EL25.0 AO ST26:11:21:18:00:00 OP1 IP1 AN2",
    ],
)
@every_row("level", Level)
def test_however_it_is_written(line: bytes, level: Level) -> None:
    assert {word.verb: word.value for word in parse(line, level)} == {"AZ": 235.5, "EL": 25.0}


@every_row(("text", "value"), [(b".5", 0.5), (b"-.5", -0.5), (b",5", 0.5), (b"5", 5.0), (b"0", 0.0)])
def test_visual_basics_numbers(text: bytes, value: float) -> None:
    assert parse(b"EL" + text, Level.I) == (Word("EL", value),)


@every_row(
    "line",
    [b"AZ1x0 EL20.0", b"AZ1 20.5 EL20.0", b"AZ1 20.5EL20.0", b"AZ235.5 EL2\xff.0", b"AZ2\xff35.5 EL25.0", b"AZ235.5 EL",
     b"AZ235.5 E", b"AZ235.5EL EL25.0", b"AZ235.5 L25.0", b"AZ235.5 EX25.0", b"Z235.5 EL25.0", b"5.5 EL25.0",
     b"AZ235.5 \xff\xfe", b"AZ235.5 EL25x", b"AZ235.5 EL25. 0", b"AZ235.5 EL2 5.0", b"xxAZ235.5 EL",
     b"AZ=235.5 EL=25.0", b"AZx35.5 EL20.0", b"AZnan EL20.0", b"AZ1e999 EL20.0", b"AZ 1 20.5 EL 20.0", b"AZ- EL20.0",
     b"AZ.  EL20.0", b"MR 5", b"PARK \xb2"],
)  # fmt: skip
def test_a_damaged_line_is_good_for_its_stops_only(line: bytes) -> None:
    assert parse(line, Level.III) == ()
    assert parse(line + b" SA SE", Level.III) == (Word("SA"), Word("SE"))


@every_row("line", [b"", b" ", b";", b"XX", b"UP145900000", b"PARKED", b"MRx", b"VR", b"VR-5"])
def test_what_is_not_for_a_rotor_is_passed_over(line: bytes) -> None:
    assert parse(line, Level.III) == ()


@pytest.mark.parametrize(
    ("level", "known"),
    [
        (Level.I, {"AZ", "EL", "SA", "SE"}),
        (Level.II, {"AZ", "EL", "SA", "SE", "ML", "MR", "MU", "MD", "VE", "PARK", "RESET"}),
        (Level.III, {verb.text for verb in VERBS}),
    ],
)
def test_each_level_has_the_commands_of_those_below(level: Level, known: set[str]) -> None:
    line = b" ".join(b"VL5 VR5 VU5 VD5".split() + [verb.text.encode() for verb in VERBS])
    assert {word.verb for word in parse(line, level)} == known


@every_row("line", [b"DELTA 12", b"HAZEL", b"HAZEL 3.5 DELTA4", b"HAZEL5", b"AaAZ0", b"XAZ1.5 YEL2.5", b"AZ5 HAZEL5"])
def test_letters_within_a_word_are_no_angle(line: bytes) -> None:
    assert parse(line, Level.III) == ()


@every_row("line", [b"UP145AZ5.5", b"AZ5.5DN435", b"VR5AZ5.5", b"#AZ5.5", b"AZ5.5UP1 MR", b"AZ5.5\x00"])
def test_a_single_angle_that_is_joined_to_something_moves_nothing(line: bytes) -> None:
    assert parse(line, Level.III) == ()
    assert parse(line + b" SA SE", Level.III) == (Word("SA"), Word("SE"))


def test_a_turn_that_is_joined_to_a_pair_is_none() -> None:
    assert parse(b"VR5AZ235.5EL25.0", Level.III) == (Word("AZ", 235.5), Word("EL", 25.0))


@pytest.mark.parametrize("line", [b"AZ235.5 EL25.0", b"EL25.0 AZ235.5", b"AZ9.05EL114.8"])
def test_a_byte_that_is_lost_or_wrong_or_one_too_many_never_leaves_half_of_a_pair(line: bytes) -> None:
    for at in range(len(line)):
        for byte in (b"", *(bytes([code]) for code in range(256) if code not in b"\r\n")):
            for damaged in (line[:at] + byte + line[at + 1 :], line[:at] + byte + line[at:]):
                assert {word.verb for word in parse(damaged, Level.III)} in (set(), {"AZ", "EL"}), damaged


@every_row(
    "begun", [b"AZ235.5 EL25.0", b"EL25.0 AZ235.5 ", b"AZ114.8 EL9.05", b"AZ1.0EL2.0", b"AZ235.5", b"EL-5.0", b"az45.0"]
)
def test_whole_without_an_end(begun: bytes) -> None:
    assert is_whole(begun)


@every_row(
    "begun", [b"", b"AZ", b"AZ2", b"AZ235", b"AZ235.", b"AZ235.5 EL", b"AZ235.5 EL2", b"AZ EL", b"PARK", b"xAZ1.0"]
)
def test_only_begun(begun: bytes) -> None:
    assert not is_whole(begun)


@every_row(
    ("azimuth_deg", "elevation_deg", "reply"),
    [
        (235.55, 25.04, b"AZ235.6 EL25.0\n"),
        (-10.5, -5.5, b"AZ-10.5 EL-5.5\n"),
        (-0.04, 0.0, b"AZ0.0 EL0.0\n"),
        (400.0, 7.0, b"AZ400.0 EL7.0\n"),
        (235.0, None, b"AZ235.0\n"),
        (None, 25.0, b"EL25.0\n"),
    ],
)
def test_positions(azimuth_deg: float | None, elevation_deg: float | None, reply: bytes) -> None:
    assert easycomm.position_reply(azimuth_deg, elevation_deg) == reply
