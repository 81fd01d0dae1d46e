"""A pass from a file: read, interpolated the short way round, or refused with the line that is wrong."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from rotator.rehearsal.passes import Pass, PassError, read_pass

PASSES = sorted((Path(__file__).parents[1] / "passes").glob("*.csv"))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "iss.csv"


# --- reading


def test_read(path: Path) -> None:
    path.write_text("t,az,el\n0,274.609,0.001\n1.5,274.638,-0.2\n")
    assert read_pass(path) == Pass("iss", ((0.0, 274.609, 0.001), (1.5, 274.638, -0.2)))


def test_columns_in_any_order_and_more_of_them(path: Path) -> None:
    path.write_text("el,range_km,az,t\n5,1200,10,0\n6,1190,11,1\n")
    assert read_pass(path).rows == ((0.0, 10.0, 5.0), (1.0, 11.0, 6.0))


def test_lines_as_windows_ends_them(path: Path) -> None:
    path.write_bytes(b"t,az,el\r\n0,10,5\r\n1,11,6\r\n")
    assert read_pass(path).end_s == 1.0


def test_time_starts_at_the_first_row(path: Path) -> None:
    path.write_text("t,az,el\n1700000000,10,5\n1700000002,12,7\n")
    flown = read_pass(path)
    assert flown.end_s == 2.0
    assert flown.at(1.0) == (11.0, 6.0)


def test_a_negative_azimuth_is_the_direction_it_means(path: Path) -> None:
    path.write_text("t,az,el\n0,-90,5\n1,360,6\n")
    assert [row[1] for row in read_pass(path).rows] == [270.0, 0.0]


@pytest.mark.parametrize("shipped", PASSES, ids=lambda path: path.stem)
def test_the_twelve_passes(shipped: Path) -> None:
    flown = read_pass(shipped)
    assert flown.name == shipped.stem
    assert all(0 <= az < 360 and -1 < el <= 90 for _, az, el in flown.rows)
    assert all(b[0] - a[0] == 1 for a, b in pairwise(flown.rows))


def test_there_are_twelve() -> None:
    assert len(PASSES) == 12


# --- in between


@pytest.mark.parametrize(
    ("azimuths_deg", "half_way_deg"),
    [
        ((10, 20), 15),
        ((20, 10), 15),
        ((350, 10), 0),
        ((10, 350), 0),
        ((355, 15), 5),
        ((90, 268), 179),
        ((92, 270), 181),
    ],
)
def test_azimuth_goes_the_short_way_round(azimuths_deg: tuple[float, float], half_way_deg: float) -> None:
    start, end = azimuths_deg
    flown = Pass("test", ((0.0, start, 10.0), (2.0, end, 20.0)))
    assert flown.at(1.0) == pytest.approx((half_way_deg, 15.0))


def test_through_north_it_never_points_south() -> None:
    flown = Pass("test", ((0.0, 340.0, 10.0), (10.0, 20.0, 10.0)))
    azimuths_deg = [flown.at(t / 10)[0] for t in range(101)]
    assert all(azimuth >= 340 or azimuth <= 20 for azimuth in azimuths_deg)
    assert all(0 <= azimuth < 360 for azimuth in azimuths_deg)


def test_at_its_rows_it_is_its_rows() -> None:
    flown = read_pass(PASSES[0])
    for t_s, azimuth_deg, elevation_deg in flown.rows:
        assert flown.at(t_s) == pytest.approx((azimuth_deg, elevation_deg))


def test_before_and_after_it_stays_at_its_ends() -> None:
    flown = Pass("test", ((0.0, 10.0, 0.0), (5.0, 20.0, 9.0), (6.0, 21.0, 8.0)))
    assert flown.at(-3.0) == (10.0, 0.0)
    assert flown.at(99.0) == pytest.approx((21.0, 8.0))


# --- no pass


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", ": the first line must name the columns t,az,el"),
        ("0,10,5\n1,11,6\n", ": the first line must name the columns t,az,el"),
        ("t,az\n0,10\n1,11\n", ": the first line must name the columns t,az,el"),
        ("t,az,el\n", ": a pass needs two rows or more"),
        ("t,az,el\n0,10,5\n", ": a pass needs two rows or more"),
        ("t,az,el\n0,10,5\n0,11,6\n", ": t must rise from row to row"),
        ("t,az,el\n1,10,5\n0,11,6\n", ": t must rise from row to row"),
        ("t,az,el\n0,10,5\n1,east,6\n", ":3: t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1,11\n", ":3: t, az and el must be numbers"),
        ("t,az,el\n0,,5\n1,11,6\n", ":2: t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1,nan,6\n", ":3: t, az and el must be numbers"),
        ("t,az,el\n0,10,5\ninf,11,6\n", ":3: t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1,361,6\n", ":3: azimuth 361, elevation 6 is no direction"),
        ("t,az,el\n0,10,91\n1,11,6\n", ":2: azimuth 10, elevation 91 is no direction"),
    ],
)
def test_what_is_no_pass_is_refused_with_its_line(path: Path, text: str, fault: str) -> None:
    path.write_text(text)
    with pytest.raises(PassError) as refused:
        read_pass(path)
    assert str(refused.value) == f"{path}{fault}"


def test_a_file_that_is_not_there(path: Path) -> None:
    with pytest.raises(PassError, match=r"iss\.csv: cannot be read: .*No such file or directory"):
        read_pass(path)


@pytest.mark.parametrize("data", [b"t,az,el\n0,10,5\n1,\xb0,6\n", b"\xff\xfe\x00"])
def test_a_file_that_is_no_text(path: Path, data: bytes) -> None:
    path.write_bytes(data)
    with pytest.raises(PassError, match=r"iss\.csv: cannot be read: "):
        read_pass(path)


def test_a_quote_that_never_ends(path: Path) -> None:
    path.write_text('t,az,el\n0,10,5\n"' + "1,11,6\n" * 30_000)
    with pytest.raises(PassError, match=r"iss\.csv"):
        read_pass(path)
