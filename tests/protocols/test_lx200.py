"""LX200's numbers and commands: what real programs write, what is damaged, and what other programs read."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.protocols import lx200
from rotator.protocols.lx200 import Command, CommandReader, Kind
from tests.tables import every_row


@every_row(
    ("text", "degrees"),
    [
        ("15:44:00", 236.0),
        (" 15:44:00", 236.0),
        ("15:44.0", 236.0),
        ("00:00:04", 4 * 15 / 3600),
        ("23:59:59.5", (24 * 3600 - 1) / 240),
        ("9:05.5", 136.375),
    ],
)
def test_hours(text: str, degrees: float) -> None:
    assert lx200.hours(text) == pytest.approx(degrees)


@every_row("text", ["", "15", "15:4", "24:00:00", "12:60:00", "12:00:61", "12:00:0x", "-1:00:00", "1e:00"])
def test_no_hours(text: str) -> None:
    assert lx200.hours(text) is None


@every_row(
    ("text", "degrees"),
    [
        ("+19*10:00", 19 + 1 / 6),
        (" +19\xdf10:00", 19 + 1 / 6),
        ("-05*30", -5.5),
        ("-00*30", -0.5),
        ("19:10", 19 + 1 / 6),
        ("+19*10'30", 19.175),
        ("+89*60", 90.0),
        ("+25*00", 25.0),
    ],
)
def test_signed(text: str, degrees: float) -> None:
    assert lx200.signed(text) == pytest.approx(degrees)


@every_row("text", ["", "+", "+91*00", "+90*01", "+1x*00", "+19*61", "+19 10", "++19*10", "+119*10"])
def test_not_signed(text: str) -> None:
    assert lx200.signed(text) is None


@pytest.mark.parametrize(("text", "degrees"), [(" 075*00", 75.0), ("235*30", 235.5), ("5*00", 5.0), ("360*00", 360.0)])
def test_around(text: str, degrees: float) -> None:
    assert lx200.around(text) == pytest.approx(degrees)


@every_row("text", ["", "361*00", "-10*00", "1234*00", "12*", "360*01"])
def test_not_around(text: str) -> None:
    assert lx200.around(text) is None


@given(st.floats(0, 359.9999), st.booleans())
def test_hours_are_read_again(degrees: float, long: bool) -> None:
    said = lx200.hours_reply(degrees, long=long).decode().removesuffix("#")
    again = lx200.hours(said)
    assert again is not None
    assert abs((again - degrees + 180) % 360 - 180) <= (15 / 7200 if long else 15 / 1200) + 1e-9
    assert re.fullmatch(r"\d\d:\d\d:\d\d" if long else r"\d\d:\d\d\.\d", said)


@given(st.floats(-90, 90), st.booleans())
def test_signed_angles_are_read_again(degrees: float, long: bool) -> None:
    said = lx200.signed_reply(degrees, long=long).decode("latin-1").removesuffix("#")
    again = lx200.signed(said)
    assert again == pytest.approx(degrees, abs=(1 / 7200 if long else 1 / 120) + 1e-9)
    assert re.fullmatch("[+-]\\d\\d\xdf\\d\\d(:\\d\\d)?", said)


@given(st.floats(-10, 500), st.booleans())
def test_azimuths_are_read_again(degrees: float, long: bool) -> None:
    said = lx200.around_reply(degrees, long=long).decode("latin-1").removesuffix("#")
    again = lx200.around(said)
    assert again is not None
    assert again < 360
    assert abs((again - degrees + 180) % 360 - 180) <= (1 / 7200 if long else 1 / 120) + 1e-9


@every_row("verb", lx200.VERBS)
def test_every_verb_is_found_in_any_pieces(verb: lx200.Verb) -> None:
    said = b"\xff#" + lx200.encode(verb)
    reader = CommandReader()
    found = [each for octet in said for each in reader.feed(bytes((octet,)))]
    assert found == [Command(verb.text, verb.takes)]


@every_row("text", [b"", b"M", b"MSS", b"MX", b"GRR", b"mS", b"x" * 100, b"Xr 12:00:00"])
def test_what_is_no_command(text: bytes) -> None:
    assert CommandReader().feed(b":" + text + b"#") == [Kind.UNKNOWN]


def test_the_question_for_the_mount() -> None:
    assert CommandReader().feed(b"\x06:GR#\x06") == [Kind.MOUNT, Command("GR"), Kind.MOUNT]
