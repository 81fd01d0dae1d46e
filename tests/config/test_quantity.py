"""What people type where a number belongs: the advice keeps the whole of it, or names no number."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.config.load import parse
from rotator.config.quantity import numbers
from tests.config.texts import faults

STATION = "[station]\nlongitude_deg = 2\nlatitude_deg = "


@pytest.mark.parametrize(
    ("typed", "key", "meant"),
    [
        ("48°12'30", "latitude_deg", ["48.208333"]),
        ("48°12'30\" S", "latitude_deg", ["-48.208333"]),
        ("48 12 30", "latitude_deg", ["48.208333"]),
        ("48:12:30", "latitude_deg", ["48.208333"]),
        ("48 12 30 S", "latitude_deg", ["-48.208333"]),  # the S is no second
        ("N48°12.5'", "latitude_deg", ["48.208333"]),
        ("-0°30'", "latitude_deg", ["-0.5"]),
        ("48,2 North", "latitude_deg", ["48.2"]),
        ("2.35 W", "longitude_deg", ["-2.35"]),
        ("2.35 O", "longitude_deg", []),  # east in German, west in French
        ("48.2 E", "latitude_deg", []),
        ("-48.2 S", "latitude_deg", []),
        ("48°72'", "latitude_deg", []),
        ("48.12.30", "latitude_deg", []),
        ("48d12m30s", "latitude_deg", []),
        ("1°30'", "min_deg", ["1.5"]),
        ("4 50", "min_deg", []),
        ("4o", "min_deg", []),
        ("−10", "min_deg", ["-10"]),
        ("48,208", "min_deg", ["48.208"]),
        ("1,200", "altitude_m", ["1.2", "1200"]),
        ("1.200", "altitude_m", ["1.2", "1200"]),
        ("1'200", "altitude_m", ["1200"]),
        ("1 200 m", "altitude_m", ["1200"]),
        ("1,200.5", "altitude_m", ["1200.5"]),
        ("1000 ft", "altitude_m", ["304.8"]),
        ("10-20", "altitude_m", []),
        ("10..20", "altitude_m", []),
        ("10/2", "altitude_m", []),
        ("1e3 m", "altitude_m", ["1000"]),
        ("5 m", "rest_s", []),  # metres or minutes
        ("40 mHz", "osc_hz", []),
        ("40 MHz", "osc_hz", ["40000000"]),
    ],
)
def test_what_it_means(typed: str, key: str, meant: list[str]) -> None:
    assert numbers(typed, key) == meant


@pytest.mark.parametrize(
    ("typed", "key", "meant"),
    [
        ("9.600", "baud", ["9600"]),
        ("9600 baud", "baud", ["9600"]),
        ("1,2", "baud", []),
        ("GPIO23", "azimuth_ccw", ["23"]),
        ("pin 16", "azimuth_ccw", []),  # of the header, perhaps: that is GPIO 23
        ("A0", "azimuth_channel", ["0"]),
        ("0x48", "address", ["0x48"]),
        ("48h", "address", ["0x48"]),
        ("4A", "address", ["0x4a"]),
        ("48", "address", ["0x48"]),
        ("72", "address", ["72"]),
        ("38", "address", ["0x38", "38"]),
    ],
)
def test_whole_numbers(typed: str, key: str, meant: list[str]) -> None:
    assert numbers(typed, key, whole=True) == meant


@pytest.mark.parametrize("quotes", ['"', "'", ""])
@pytest.mark.parametrize("typed", ["48°12'30", "48 12 30", "48°12'30''N", "48°12'30\" N", "N 48 12 30"])
def test_a_latitude_as_on_a_map_gets_one_line_that_works(typed: str, quotes: str) -> None:
    if quotes and quotes in typed:
        quotes = "'" if '"' in typed else '"'
    (said,) = faults(f"{STATION}{quotes}{typed}{quotes}\n")
    assert "write latitude_deg = 48.208333" in said.replace("\u00a0", " ")
    parse(f"{STATION}48.208333\n", "x")


@pytest.mark.parametrize(
    ("text", "ends"),
    [
        ('[adc]\naddress = "0x48"\n', "write address = 0x48"),
        ('[relays]\nazimuth_ccw = "GPIO23"\n', "write azimuth_ccw = 23"),
        ("[relays]\nazimuth_ccw = GPIO23\n", "write azimuth_ccw = 23"),
        ('[station]\naltitude_m = "1,200"\n', "write altitude_m = 1.2 or altitude_m = 1200"),
        ("[station]\naltitude_m = 1,200\n", "may be 1.2 or 1200: write the one that you mean"),
        ('[azimuth]\nmin_deg = "4o"\n', "write one number alone, in degrees"),
        ("[azimuth]\nmin_deg = 10-20\n", "write one number alone, in degrees"),
        ('[azimuth]\ncalibration = "[[0, 0], [1, 360]]"\n', "write it without quotes"),
        ('[sky]\nelements = "my sets.tle"\n', 'write ["my sets.tle"]'),
        ("[sky]\nelements = sets.tle\n", 'write ["sets.tle"]'),
        ('[page]\nallow = "10.0.0.0/8, 192.168.1.0/24"\n', 'write ["10.0.0.0/8", "192.168.1.0/24"]'),
        ("[[link]]\nprotocol = rotctld\nname = 2m Yagi\ntcp = 'a:1'\n", 'write name = "2m Yagi"'),
        ("[[link]]\nprotocol = 'rotctld'\nname = 007\ntcp = 'a:1'\n", 'write name = "007"'),
    ],
)
def test_the_advice_in_a_file(text: str, ends: str) -> None:
    assert faults(text)[-1].replace("\u00a0", " ").endswith(ends)


digits = st.integers(0, 999).map(str)
glue = st.sampled_from(["", " ", ".", ",", "'", "°", '"', "-", " m", "N ", "_", "/", " V", "k", " ms", " MHz", ";"])
KEYS = ("altitude_m", "supply_v", "rest_s", "osc_hz", "priority")


@settings(deadline=None)
@given(st.lists(st.tuples(digits, glue), min_size=1, max_size=4), glue, st.sampled_from(KEYS))
def test_no_digit_is_lost(pieces: list[tuple[str, str]], before: str, key: str) -> None:
    typed = before + "".join(number + mark for number, mark in pieces)
    whole = Fraction("".join(re.findall(r"\d", typed)))
    shifted = {whole * Fraction(10) ** shift for shift in range(-15, 7)}
    for meant in numbers(typed, key):
        assert abs(Fraction(meant)) in shifted, typed
        assert (Fraction(meant) < 0) is ("-" in typed and whole > 0)


@settings(deadline=None)
@given(
    st.integers(0, 89), st.integers(0, 59), st.one_of(st.none(), st.integers(0, 59)),
    st.sampled_from(["°'\"", "   ", ":: ", "°′″"]), st.sampled_from(["", "N", "S", " S", " South", "-", "s"]),
)  # fmt: skip
def test_a_place_as_maps_write_it(deg: int, minutes: int, seconds: int | None, marks: str, way: str) -> None:
    last = f"{seconds}{marks[2]}".rstrip(" ") if seconds is not None else ""
    typed = f"{deg}{marks[0]}{minutes}{marks[1]}{last}".rstrip(" :")
    typed = f"-{typed}" if way == "-" else f"{typed}{way}"
    exact = deg + Fraction(minutes, 60) + Fraction(seconds or 0, 3600)
    meant = numbers(typed, "latitude_deg")
    assert len(meant) == 1, typed
    assert abs(Fraction(meant[0]) - (-exact if way.strip().lower()[:1] in ("-", "s") else exact)) < Fraction(1, 10**6)
