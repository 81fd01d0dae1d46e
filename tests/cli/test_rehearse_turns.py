"""`rotator rehearse`: a table that names the turn of the overlap for each row."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest

from rotator.control.sky.angles import great_circle_deg
from tests.cli.rehearsed import Rotator, Rows, figures

ACROSS_NORTH: Rows = [(t, 340.0 + t / 2, 20.0) for t in range(0, 121, 10)]
OVER_THE_TOP: Rows = [(t, 40.0, 10.0 + t) for t in range(0, 161, 10)]
AND_BACK: Rows = [(t, 40.0, 170.0 - t) for t in range(0, 161, 10)]


def turns(folder: Path, rows: Rows) -> Path:
    path = folder / "turns.csv"
    path.write_text("t,az,el\n" + "".join(f"{t},{az},{el}\n" for t, az, el in rows))
    return path


@pytest.mark.parametrize(
    ("via", "rows"),
    [(via, rows) for via in ("gs232", "rotctld", "track") for rows in (ACROSS_NORTH, OVER_THE_TOP, AND_BACK)],
)
def test_a_table_that_names_its_turn_is_flown_on_it(
    rotator_here: Rotator, tmp_path: Path, via: str, rows: Rows
) -> None:
    trace = tmp_path / "trace.csv"
    figures(rotator_here("rehearse", turns(tmp_path, rows), "--via", via, "--json", "--trace", trace))
    flown = [[float(each) for each in row] for row in list(csv.reader(trace.read_text().splitlines()))[1:]]
    assert max(row[1] for row in flown) <= 360.0, "the target is on the sky"
    assert max(row[2] for row in flown) <= 90.0
    assert max(great_circle_deg(*row[1:5]) for row in flown if row[0] > 60.0) < 8.0, "once the antenna has come there"
    assert flown[-1][3:5] == pytest.approx(rows[-1][1:], abs=8.0), "the antenna is on the turn that is named"


@pytest.mark.parametrize("beyond", [90.0, 100.0, 260.0])
def test_a_turn_that_the_rotor_does_not_have_is_refused_before_the_flight(
    rotator_here: Rotator, tmp_path: Path, beyond: float
) -> None:
    rows = [(t, azimuth_deg + beyond, elevation_deg) for t, azimuth_deg, elevation_deg in ACROSS_NORTH]
    done = rotator_here("rehearse", turns(tmp_path, rows), "--json")
    assert (done.returncode, done.stdout) == (1, "")
    assert re.search(r"turns, line \d+: azimuth 4[5-9]\d\.\d°|azimuth [56]\d\d", done.stderr)
    assert "outside the rotor's azimuth range of 0° to 450°, on the turn that the table names" in done.stderr
