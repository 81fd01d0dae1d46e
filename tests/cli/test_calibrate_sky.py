"""`rotator calibrate sky` as a command: what it refuses, and a point taken and saved at the simulated Sun."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.load import load
from tests.cli.conftest import calibrated

NOON = "2026-06-21T11:00:00Z"
STATION = """# my mast
[rotor]
type = "moteus"

[station]
locator = "JN58td"

[sim.mount]
ie_deg = -3

[sim]
bus_takes_time = false
"""


def sky(path: Path, *options: str, lines: tuple[str, ...] = ()) -> tuple[str, int]:
    return calibrated("sky", "--config", str(path), *options, lines=lines)


@pytest.fixture
def station(tmp_path: Path) -> Path:
    path = tmp_path / "station.toml"
    path.write_text(STATION)
    return path


def test_a_point_at_the_sun_is_saved_and_the_file_before_is_kept(station: Path) -> None:
    text, code = sky(station, "--at", NOON, lines=("y", "y", "u 0.38", "", "f", "y"))
    assert code == 0, text
    assert "SIM: along the boom it is" in text
    assert "Never look along the boom at the Sun" in text
    model = load(station).mount.model
    assert -6 < model.ie_deg < -1
    assert len(model.points) == 1
    assert station.with_name("station.toml.bak").read_text() == STATION


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--target", "moonn"), "moonn"),
        (("--at", "noon"), "is no date and time"),
        (("--receiver", "shack:x"), '"shack:x" is no address of a receiver: write it as 127.0.0.1:4532'),
    ],
)
def test_what_it_refuses(station: Path, options: tuple[str, ...], said: str) -> None:
    text, code = sky(station, *options)
    assert code != 0
    assert said in text
