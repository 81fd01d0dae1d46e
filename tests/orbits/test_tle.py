"""Two-line elements as they are published, and as they get damaged."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits import tle
from rotator.orbits.elements import Elements
from tests.tables import every_row

ISS = """\
ISS (ZARYA)
1 25544U 98067A   25059.54152977  .00022226  00000-0  40176-3 0  9996
2 25544  51.6353 125.1519 0006135 326.8326  33.2278 15.49597200498316
"""
FILE = Path(__file__).parent / "elements-2025.tle"


def sums_up(line: str) -> str:
    """The line with its checksum made right."""
    return line[:68] + str(sum(int(c) if c.isdecimal() else c == "-" for c in line[:68]) % 10)


def with_number(number: str) -> str:
    one, two = ISS.splitlines()[1:]
    return "\n".join(sums_up(line[:2] + number + line[7:]) for line in (one, two))


def test_every_column_is_read() -> None:
    (iss,) = tle.read(ISS)
    assert isinstance(iss, Elements)
    assert (iss.name, iss.catalogue_number) == ("ISS (ZARYA)", 25544)
    assert iss.epoch_utc_s == pytest.approx(datetime(2025, 2, 28, 12, 59, 48, 172128, UTC).timestamp(), abs=1e-4)
    assert (iss.mean_motion_rev_per_day, iss.mean_motion_dot, iss.mean_motion_ddot) == (15.49597200, 0.00022226, 0.0)
    assert (iss.eccentricity, iss.inclination_deg, iss.ascending_node_deg) == (0.0006135, 51.6353, 125.1519)
    assert (iss.perigee_argument_deg, iss.mean_anomaly_deg) == (326.8326, 33.2278)
    assert iss.drag_per_earth_radius == pytest.approx(0.40176e-3)


def test_without_names_the_number_is_the_name() -> None:
    (iss,) = tle.read(ISS.partition("\n")[2])
    assert isinstance(iss, Elements)
    assert iss.name == "25544"


@pytest.mark.parametrize("indent", [" ", "    ", "\t"])
def test_lines_that_were_copied_with_an_indent_are_read(indent: str) -> None:
    text = "".join(f"{indent}{line}  \r\n" for line in ISS.splitlines())
    assert tle.looks_like_tle(text)
    assert list(tle.read(text)) == list(tle.read(ISS))


def test_space_track_writes_a_zero_before_the_name() -> None:
    (iss,) = tle.read("0 " + ISS)
    assert isinstance(iss, Elements)
    assert iss.name == "ISS (ZARYA)"


@every_row(
    ("written", "number"),
    [("00005", 5), ("    5", 5), ("99999", 99999), ("A0000", 100000), ("Z9999", 339999), ("J2931", 182931)],
)
def test_alpha_5(written: str, number: int) -> None:
    (found,) = tle.read(with_number(written))
    assert isinstance(found, Elements)
    assert found.catalogue_number == number


def test_a_satellite_launched_in_1958_has_an_epoch_of_that_century() -> None:
    one, two = ISS.splitlines()[1:]
    (found,) = tle.read("\n".join((sums_up(one[:18] + "58001.00000000" + one[32:]), two)))
    assert isinstance(found, Elements)
    assert datetime.fromtimestamp(found.epoch_utc_s, UTC) == datetime(1958, 1, 1, tzinfo=UTC)


@every_row(
    ("text", "told"),
    [
        (ISS.replace("9996", "9995"), "line 2: the checksum of its first line is 6, not 5"),
        (ISS.replace(" 9996", "9996"), "line 2: its first line has 68 characters in place of 69"),
        (ISS.rpartition("2 25544")[0], "line 2: its second line is missing"),
        (ISS.replace("2 25544 ", "2 25545 ").replace("498316", "498317"), "line 2: its lines are of 25544 and 25545"),
        ("NOAA 15\nNOAA 19\n" + ISS, 'line 2: "NOAA 19" has no element set'),
        (ISS + "NOAA 19\n", 'line 4: "NOAA 19" has no element set'),
    ],
)
def test_what_is_wrong_is_named_with_its_line(text: str, told: str) -> None:
    assert told in list(tle.read(text))


@given(st.data())
def test_a_damaged_text_gives_sentences_never_another_orbit(data: st.DataObject) -> None:
    """One character is changed: the checksum finds it, or it was in a name, or it means the same."""
    text = FILE.read_text(encoding="utf-8")
    at = data.draw(st.integers(0, len(text) - 1))
    found = list(tle.read(text[:at] + data.draw(st.sampled_from("0123456789 -+.AZ\n")) + text[at + 1 :]))
    true = {each.catalogue_number: each for each in tle.read(text) if isinstance(each, Elements)}
    for each in found:
        if isinstance(each, Elements) and each.catalogue_number in true:
            known = true[each.catalogue_number]
            assert each.epoch_utc_s == known.epoch_utc_s
            assert each.mean_anomaly_deg == known.mean_anomaly_deg


@given(st.text())
def test_no_text_is_too_odd(text: str) -> None:
    list(tle.read(text))


@given(st.integers(1, 339_999))
def test_alpha5_goes_both_ways(number: int) -> None:
    assert tle.catalogue_number(tle.alpha5(number)) == number
    assert len(tle.alpha5(number)) == 5


@pytest.mark.parametrize("number", [340_000, 900_000_000])
def test_a_number_that_alpha5_cannot_write_has_none(number: int) -> None:
    assert tle.alpha5(number) == ""
