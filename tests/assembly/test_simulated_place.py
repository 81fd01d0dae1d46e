"""A simulated antenna stays where it is while the program does not run, as a real one does on its mast."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.assembly.simulation import PLACE_FILE
from rotator.assembly.station import open_station
from rotator.config.load import parse

KINDS = ["relay-pot", "relay-pulse", "moteus", "servo", "digipot", "h-bridge"]


def stands(folder: Path, more: str = "", kind: str = "relay-pot") -> tuple[float, float]:
    """Where the next run finds it."""
    config = parse(f'[rotor]\ntype = "{kind}"\n[state]\npath = "{folder}/state.json"\n{more}', "a test's file")
    station = open_station(config)
    try:
        assert station.world is not None
        azimuth_deg, elevation_deg = station.world.shafts()
        return round(azimuth_deg, 1), round(elevation_deg, 1)
    finally:
        station.close()


@pytest.mark.parametrize("kind", KINDS)
def test_the_next_run_finds_it_where_it_was(tmp_path: Path, kind: str) -> None:
    at = (123.4, 21.0)
    start = "[sim.azimuth]\nstart_deg = 123.4\n[sim.elevation]\nstart_deg = 21\n"
    assert stands(tmp_path, kind=kind) != at
    assert stands(tmp_path, start, kind) == at
    for _ in range(3):
        assert stands(tmp_path, kind=kind) == pytest.approx(at, abs=1.0)  # a digital pot has steps
    assert stands(tmp_path, "[sim.azimuth]\nstart_deg = 10\n", kind)[0] == 10.0, "what the file says comes first"


DAMAGED = (
    "",
    "[",
    "{}",
    "[]",
    "[1]",
    "3",
    "[" * 100_000,
    "\xff\x00",
    '["1", 3]',
    "[NaN, 3]",
    "[1e999, 3]",
    "[1, 2, 3]",
)


@pytest.mark.parametrize("text", DAMAGED)
def test_a_damaged_place_is_no_place(tmp_path: Path, text: str) -> None:
    (tmp_path / PLACE_FILE).write_text(text, encoding="latin-1")
    assert stands(tmp_path) == (0.0, 0.0)


def test_a_place_beyond_a_smaller_range_is_its_end(tmp_path: Path) -> None:
    assert stands(tmp_path, "[sim.azimuth]\nstart_deg = 440\n") == (440.0, 0.0)
    assert stands(tmp_path, "[azimuth]\nmax_deg = 360\n") == (360.0, 0.0)
