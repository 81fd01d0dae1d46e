"""Values written into the user's file: its comments stay, a copy is kept, and nothing bad is ever written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rotator.config.load import ConfigError, load
from rotator.config.save import changed, save_tables

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


def test_all_keys_are_in_the_file_the_rest_stays_and_the_file_before_is_kept(station: Path) -> None:
    save_tables(
        station, {"azimuth": {"calibration": POINTS, "min_deg": 0.0, "max_deg": 450.0, "direction_checked": True}}
    )
    azimuth = load(station).azimuth
    assert azimuth.calibration == [(0.05123, -1.5), (0.4, 200.0), (0.949, 451.25)]
    assert (azimuth.min_deg, azimuth.max_deg, azimuth.direction_checked) == (0.0, 450.0, True)
    after = station.read_text().splitlines()
    untouched = [line for line in STATION.splitlines() if not line.startswith("calibration")]
    assert [line for line in after if line in untouched] == untouched
    assert "# by hand" in station.read_text()
    assert station.with_name("station.toml.bak").read_text() == STATION
    assert sorted(path.name for path in station.parent.iterdir()) == ["station.toml", "station.toml.bak"]


@pytest.mark.parametrize("least_deg", [200.0, 200])
def test_a_range_that_leaves_the_park_position_out_takes_it_along(station: Path, least_deg: float) -> None:
    """Else the file would be refused, and the calibration lost."""
    save_tables(station, {"azimuth": {"calibration": POINTS, "min_deg": least_deg, "max_deg": 451.0}})
    assert load(station).park_deg == (200.0, 0.0)
    assert "park_azimuth_deg = 200        # south" in station.read_text()


def test_numbers_are_written_as_a_person_would() -> None:
    keys: dict[str, Any] = {"min_deg": 0.0, "max_deg": 89.5, "calibration": ((0.05, 0.0), (0.95, 180.0))}
    assert changed("", {"elevation": keys}) == (
        "[elevation]\nmin_deg = 0\nmax_deg = 89.5\ncalibration = [[0.05, 0], [0.95, 180]]\n"
    )


def test_a_long_table_has_a_line_for_each_point() -> None:
    text = changed("", {"azimuth": {"calibration": tuple((at / 10, at * 45.0) for at in range(1, 10))}})
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
    save_tables(path, {"azimuth": {"calibration": POINTS, "min_deg": 0.0, "direction_checked": True}})
    azimuth = load(path).azimuth
    assert azimuth.direction_checked
    assert azimuth.calibration is not None
    assert len(azimuth.calibration) == 3


@pytest.mark.parametrize(
    ("text", "keys", "said"),
    [
        (STATION, {"calibration": ((0.1, 0.0),)}, "calibration"),
        (STATION, {"calibration": ((0.1, 0.0), (0.1, 9.0))}, "calibration"),
        (STATION, {"calibration": ((0.1, 5.0), (0.2, 0.0))}, "calibration"),
        (STATION, {"min_deg": 300.0, "max_deg": 200.0}, "must be below"),
        ("[azimuth\n", {"calibration": POINTS}, "not TOML"),
        # An emptied file does not become the file of a simulated station.
        ("", {"calibration": POINTS}, "is empty"),
        ("# only a comment\n", {"calibration": POINTS}, "is empty"),
    ],
)
def test_what_would_not_be_accepted_is_not_written(station: Path, text: str, keys: dict[str, Any], said: str) -> None:
    station.write_text(text)
    with pytest.raises(ConfigError, match=said):
        save_tables(station, {"azimuth": keys})
    assert station.read_text() == text
    assert [path.name for path in station.parent.iterdir()] == ["station.toml"]
