"""Values written into the user's file: its comments stay, a copy is kept, and nothing bad is ever written."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.load import ConfigError, load
from rotator.config.save import changed, save_table

STATION = """# My station.
[azimuth]                     # a G-5500
min_deg = 0                   # north
max_deg = 450
calibration = [[0.1, 0], [0.9, 450]]   # by hand

# The tower.
[mount]
park_azimuth_deg = 180        # south

[[link]]
protocol = "rotctld"          # Gpredict
tcp = "127.0.0.1:4533"
"""
POINTS = ((0.051234567, -1.5), (0.4, 200.0), (0.949, 451.25))


@pytest.fixture
def station(tmp_path: Path) -> Path:
    path = tmp_path / "station.toml"
    path.write_text(STATION)
    return path


def test_all_keys_are_in_the_file(station: Path) -> None:
    save_table(station, "azimuth", calibration=POINTS, min_deg=0.0, max_deg=450.0, direction_checked=True)
    azimuth = load(station).azimuth
    assert azimuth.calibration == [(0.05123, -1.5), (0.4, 200.0), (0.949, 451.25)]
    assert (azimuth.min_deg, azimuth.max_deg, azimuth.direction_checked) == (0.0, 450.0, True)


def test_comments_and_everything_else_stay(station: Path) -> None:
    save_table(station, "azimuth", calibration=POINTS, direction_checked=True)
    after = station.read_text().splitlines()
    untouched = [line for line in STATION.splitlines() if not line.startswith("calibration")]
    assert [line for line in after if line in untouched] == untouched
    assert "# by hand" in station.read_text()


def test_a_range_that_leaves_the_park_position_out_takes_it_along(station: Path) -> None:
    """Else the file would be refused, and the calibration lost."""
    save_table(station, "azimuth", calibration=POINTS, min_deg=200.0, max_deg=451.0)
    assert load(station).park_deg == (200.0, 0.0)
    assert "park_azimuth_deg = 200        # south" in station.read_text()


def test_the_file_before_is_kept(station: Path) -> None:
    save_table(station, "azimuth", calibration=POINTS)
    assert station.with_name("station.toml.bak").read_text() == STATION
    assert sorted(path.name for path in station.parent.iterdir()) == ["station.toml", "station.toml.bak"]


def test_numbers_are_written_as_a_person_would() -> None:
    assert changed("", "elevation", calibration=((0.05, 0.0), (0.95, 180.0)), min_deg=0.0, max_deg=89.5) == (
        "[elevation]\nmin_deg = 0\nmax_deg = 89.5\ncalibration = [[0.05, 0], [0.95, 180]]\n"
    )


def test_a_long_table_has_a_line_for_each_point() -> None:
    text = changed("", "azimuth", calibration=tuple((at / 10, at * 45.0) for at in range(1, 10)))
    assert "\n    [0.1, 45],\n    [0.2, 90],\n" in text


@pytest.mark.parametrize(
    "text",
    [
        '[[link]]\nprotocol = "rotctld"\npty = "x"',
        "azimuth.min_deg = 0\n",
        "azimuth = { min_deg = 0 }\n",
        "[sim.azimuth]\nspeed_dps = 5.0\n",
        '[azimuth]\n"calibration" = [\n  [0.2, 0], # low\n  [0.3, 50],\n]\n',
        "\r\n".join(STATION.splitlines()) + "\r\n",
    ],
    ids=["no table, no newline", "dotted", "inline", "sim only", "many lines", "crlf"],
)
def test_any_form_of_file(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.toml"
    path.write_bytes(text.encode())
    save_table(path, "azimuth", calibration=POINTS, min_deg=0.0, direction_checked=True)
    azimuth = load(path).azimuth
    assert azimuth.direction_checked
    assert azimuth.calibration is not None
    assert len(azimuth.calibration) == 3


@pytest.mark.parametrize("text", ["", "# only a comment\n"])
def test_an_emptied_file_does_not_become_the_file_of_a_simulated_station(tmp_path: Path, text: str) -> None:
    path = tmp_path / "a.toml"
    path.write_text(text)
    with pytest.raises(ConfigError, match="is empty"):
        save_table(path, "azimuth", calibration=POINTS)
    assert [each.name for each in tmp_path.iterdir()] == ["a.toml"]
    assert path.read_text() == text


@pytest.mark.parametrize(
    "points", [((0.1, 0.0),), ((0.1, 0.0), (0.1, 9.0)), ((0.1, 5.0), (0.2, 0.0))], ids=["one", "flat", "falling"]
)
def test_what_would_not_be_accepted_is_not_written(station: Path, points: tuple[tuple[float, float], ...]) -> None:
    with pytest.raises(ConfigError, match="calibration"):
        save_table(station, "azimuth", calibration=points)
    assert station.read_text() == STATION
    assert [path.name for path in station.parent.iterdir()] == ["station.toml"]


def test_limits_that_make_no_sense_are_not_written(station: Path) -> None:
    with pytest.raises(ConfigError, match="must be below"):
        save_table(station, "azimuth", calibration=POINTS, min_deg=300.0, max_deg=200.0)
    assert station.read_text() == STATION


def test_a_file_broken_meanwhile_is_left_alone(station: Path) -> None:
    station.write_text("[azimuth\n")
    with pytest.raises(ConfigError, match="not TOML"):
        save_table(station, "azimuth", calibration=POINTS)
    assert station.read_text() == "[azimuth\n"


def test_a_file_gone_meanwhile(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        save_table(tmp_path / "none.toml", "azimuth", calibration=POINTS)
