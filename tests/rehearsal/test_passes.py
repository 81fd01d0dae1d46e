"""A pass from a file: read, interpolated the short way round, or refused with the line that is wrong."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.protocols.table_text import FORM
from rotator.rehearsal.passes import SHIPPED, Pass, PassError, find_pass, read_pass, shipped_names
from tests.tables import every_row

PASSES = sorted(SHIPPED.glob("*.csv"))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "iss.csv"


# --- reading


def test_read(path: Path) -> None:
    path.write_text("t,az,el\n0,274.609,0.001\n1.5,274.638,-0.2\n")
    assert read_pass(path) == Pass("iss", ((0.0, 274.609, 0.001), (1.5, 274.638, -0.2)), lines=(2, 3))


def test_columns_in_any_order_and_more_of_them(path: Path) -> None:
    path.write_text("el,range_km,az,t\n5,1200,10,0\n6,1190,11,1\n")
    assert read_pass(path).rows == ((0.0, 10.0, 5.0), (1.0, 11.0, 6.0))


def test_a_table_that_names_its_turn_keeps_its_angles(path: Path) -> None:
    path.write_text("t,az,el\n0,358,89\n1,364,91\n")
    flown = read_pass(path)
    assert flown.turns
    assert flown.sent_at(0.5) == (361.0, 90.0)
    assert flown.at(1.0) == pytest.approx((184.0, 89.0)), "on the sky"


def test_lines_as_windows_ends_them(path: Path) -> None:
    path.write_bytes(b"t,az,el\r\n0,10,5\r\n1,11,6\r\n")
    assert read_pass(path).end_s == 1.0


def test_time_starts_at_the_first_row(path: Path) -> None:
    path.write_text("t,az,el\n1700000000,10,5\n1700000002,12,7\n")
    flown = read_pass(path)
    assert flown.end_s == 2.0
    assert flown.at(1.0) == (11.0, 6.0)


def test_a_negative_azimuth_is_the_direction_it_means(path: Path) -> None:
    path.write_text("t,az,el\n0,-30,5\n1,360,6\n")
    assert [row[1] for row in read_pass(path).rows] == [330.0, 0.0]


@every_row("shipped", PASSES)
def test_the_twelve_passes(shipped: Path) -> None:
    flown = read_pass(shipped)
    assert flown.name == shipped.stem
    assert all(0 <= az < 360 and -1 < el <= 90 for _, az, el in flown.rows)
    assert all(b[0] - a[0] == 1 for a, b in pairwise(flown.rows))


def test_there_are_twelve() -> None:
    assert len(PASSES) == 12


# --- in between


@every_row(
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


COLUMNS = ": the first line must name the columns t,az,el"
APART = (
    "on the sky from the row before, and which way between them is not told: write rows nearer to each other, "
    "45° at most"
)
KINDS = "in the row before: write each t in seconds, or each in UTC"
POINTS = "commas stand between values, and decimals have a point: 12.5,274.6,8.1"


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", f": is empty. {FORM}"),
        ("0,10,5\n1,11,6\n", f"{COLUMNS}. {FORM}"),
        ("t,az\n0,10\n1,11\n", f"{COLUMNS}. {FORM}"),
        ("t;az;el\n0;10;5\n1;11;6\n", f"{COLUMNS} with commas between; a semicolon stands there. {FORM}"),
        ("t\taz\tel\n0\t10\t5\n", f"{COLUMNS} with commas between; a tab stands there. {FORM}"),
        ("t,az,el\n", f": a pass needs two rows or more. {FORM}"),
        ("t,az,el\n0,10,5\n", f": a pass needs two rows or more. {FORM}"),
        ("t,az,el\n0,10,5\n0,11,6\n", ":3: t must rise from row to row: 0 comes after 0"),
        (
            "t,az,el\n5,10,20\n5.00000000000001,10,20\n60,20,30\n",
            ":3: is less than 0.001 s after the row before: leave one of them out",
        ),
        ("t,az,el\n1,10,5\n\n0,11,6\n", ":4: t must rise from row to row: 0 comes after 1"),
        (
            "t,az,el\n2026-11-22T18:30:01Z,10,5\n2026-11-22T18:30:00Z,11,6\n",
            ":3: t must rise from row to row: 2026-11-22T18:30:00Z comes after 2026-11-22T18:30:01Z",
        ),
        (
            "t,az,el\n1795372201.5,10,5\n1795372200.5,11,6\n",
            ":3: t must rise from row to row: 1795372200.5 comes after 1795372201.5",
        ),
        ("t,az,el\n2026-11-22T18:30:01Z,10,5\n60,11,6\n", f":3: t is 60, and 2026-11-22T18:30:01Z {KINDS}"),
        ("t,az,el\n0,10,5\n20261122T183001Z,11,6\n", f":3: t is 20261122T183001Z, and 0 {KINDS}"),
        ("t,az,el\n0,10,5\n1,east,6\n", ":3: az is 'east': t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1,11\n", f":3: has 2 values, and the first line names 3: {POINTS}"),
        ("t,az,el\n0,5,274,6,8,1\n", f":2: has 6 values, and the first line names 3: {POINTS}"),
        ("t,az,el\n0,274,6,8\n", f":2: has 4 values, and the first line names 3: {POINTS}"),
        ("t,az,el\n0;274,6;8\n", f":2: has 2 values, and the first line names 3: {POINTS}"),
        ('t,az,el\n0,"274,6",8\n', ":2: az is 274,6: write it with a point, 274.6"),
        ("t,az,el\n0,,5\n1,11,6\n", ":2: az is '': t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1,nan,6\n", ":3: az is 'nan': t, az and el must be numbers"),
        ("t,az,el\n0,10,5\ninf,11,6\n", ":3: t is 'inf': t, az and el must be numbers"),
        ("t,az,el\n0,10,5\n1_0,11,6\n", ":3: t is '1_0': t, az and el must be numbers"),
        ("t,az,el\n0,0,5\n1,721,6\n", ":3: azimuth 721, elevation 6 is no direction"),
        ("t,az,el\n0,10,181\n1,11,179\n", ":2: azimuth 10, elevation 181 is no direction"),
        ("t,az,el\n0,0,10\n600,180,10\n", f":3: is 160° {APART}"),
        ("t,az,el\n0,0,0\n300,40,0\n600,180,0\n", f":4: is 140° {APART}"),
        ("t,az,el\n0,10,5\n1e6,11,6\n", ": lasts 278 h; t is in seconds, and a day is the most"),
    ],
)
def test_what_is_no_pass_is_refused_with_its_line(path: Path, text: str, fault: str) -> None:
    path.write_text(text)
    with pytest.raises(PassError) as refused:
        read_pass(path)
    assert str(refused.value) == f"{path}{fault}"


@every_row("name", shipped_names())
def test_a_shipped_pass_has_a_name(name: str) -> None:
    assert find_pass(name) == read_pass(SHIPPED / f"{name}.csv")


def test_a_file_comes_before_a_shipped_pass_of_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("low-1-iss").write_text("t,az,el\n0,10,5\n1,11,6\n")
    assert find_pass("low-1-iss").rows == ((0.0, 10.0, 5.0), (1.0, 11.0, 6.0))


def test_a_name_that_is_almost_right(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(PassError, match="no pass of that name; did you mean north-1-iss"):
        find_pass("north-iss")


@pytest.mark.parametrize("axes", [(0, 1), (1, 2), (0, 2), (0, 1, 2)], ids=str)
@given(
    rows=st.lists(st.tuples(st.integers(0, 9), st.integers(0, 359), st.integers(0, 89), *[st.integers(0, 99)] * 3)),
    mark=st.sampled_from([",", ";", "\t", ", "]),
)
def test_a_decimal_comma_is_never_read_as_another_number(
    tmp_path_factory: pytest.TempPathFactory, rows: list[tuple[int, ...]], mark: str, axes: tuple[int, ...]
) -> None:
    """As a program writes it whose country has decimal commas: refused, whatever stands between the values."""
    path = tmp_path_factory.mktemp("pass") / "comma.csv"
    lines = []
    for number, row in enumerate(rows):
        whole = (10 * number + row[0], *row[1:3])
        lines.append(mark.join(f"{whole[at]},{row[3 + at]:02}" if at in axes else f"{whole[at]}" for at in range(3)))
    path.write_text("\n".join(("t,az,el", *lines)))
    with pytest.raises(PassError):
        read_pass(path)


def test_a_file_that_is_not_there(path: Path) -> None:
    with pytest.raises(PassError, match=r"iss\.csv: cannot be read: .*No such file or directory"):
        read_pass(path)


@pytest.mark.parametrize("data", [b"t,az,el\n0,10,5\n1,\xb0,6\n", b"\xff\xfe\x00"])
def test_a_file_that_is_no_text(path: Path, data: bytes) -> None:
    path.write_bytes(data)
    with pytest.raises(PassError, match=r"iss\.csv: is no text file \(UTF-8\)"):
        read_pass(path)


def test_a_quote_that_never_ends(path: Path) -> None:
    path.write_text('t,az,el\n0,10,5\n"' + "1,11,6\n" * 30_000)
    with pytest.raises(PassError, match=r"iss\.csv"):
        read_pass(path)
