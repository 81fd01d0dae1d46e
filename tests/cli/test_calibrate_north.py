"""`rotator calibrate north` without a terminal: what is broken. `tests/calibrating/test_north.py` finds north."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.conftest import calibrated

STATION = """# A fast one, mounted askew.
[azimuth]
offset_deg = 17               # guessed
speed_dps = 180
max_deg = 150

[sim.azimuth]
speed_dps = 180
lag_s = 0.02

[elevation]
max_deg = 90

[sim.elevation]
speed_dps = 90

[mount]
declination_deg = 4.1         # where I live
"""
COMPASS = '\n[compass]\nkind = "bno055"\n'


def north(path: Path, *lines: str, fault: str = "") -> tuple[str, int]:
    return calibrated("north", "--config", str(path), *(["--fault", fault] if fault else []), lines=lines)


@pytest.fixture
def station(tmp_path: Path) -> Path:
    path = tmp_path / "station.toml"
    path.write_text(STATION + COMPASS)
    return path


@pytest.mark.parametrize(
    ("fault", "said"), [("compass-gone", "Refused: no compass: "), ("azimuth-pot-open", "Refused: azimuth: pot open")]
)
def test_what_is_broken_is_a_sentence(station: Path, fault: str, said: str) -> None:
    text, code = north(station, "y", "y", "y", fault=fault)
    assert code == 1
    assert said in text
    assert station.read_text() == STATION + COMPASS


def test_a_station_without_a_compass(tmp_path: Path) -> None:
    path = tmp_path / "station.toml"
    path.write_text(STATION)
    text, code = north(path)
    assert code == 1
    assert "rotator: the file has no compass" in text
