"""`rotator rehearse`: a pass in, figures and a trace out, the same every time."""

from __future__ import annotations

import csv
import json
import re
import subprocess
from itertools import pairwise
from pathlib import Path

import pytest

from rotator.config.load import shipped
from tests.cli.conftest import COMMAND
from tests.cli.rehearsed import Figures, Rotator, figures, through_the_south

KEYS = ["rms_deg", "p95_deg", "max_deg", "relay_starts", "motor_s", "recognised", "faults"]
COLUMNS = ["t", "target_az", "target_el", "antenna_az", "antenna_el", "az_drive", "el_drive"]


@pytest.fixture
def flown(tmp_path: Path) -> Path:
    return through_the_south(tmp_path)


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> tuple[Figures, bytes]:
    """That pass with no option, as a user starts it: its figures and its trace."""
    folder = tmp_path_factory.mktemp("plain")
    words = ["rehearse", through_the_south(folder).name, "--json", "--trace", "trace.csv"]
    done = subprocess.run([*COMMAND, *words], cwd=folder, capture_output=True, text=True, timeout=300, check=False)
    return figures(done), (folder / "trace.csv").read_bytes()


# --- what comes out


def test_the_summary_as_json(plain: tuple[Figures, bytes]) -> None:
    summary, _ = plain
    assert list(summary) == KEYS
    assert 0 < summary["rms_deg"] <= summary["p95_deg"] <= summary["max_deg"]
    assert isinstance(summary["relay_starts"], int)
    assert summary["motor_s"] > 10


def test_the_summary_in_a_sentence(rotator: Rotator, flown: Path) -> None:
    done = rotator("rehearse", flown)
    assert done.returncode == 0
    assert done.stdout.startswith("south: the box was off by ")
    assert " relay starts, motors on for " in done.stdout
    assert done.stdout.endswith(" s of 60 s\n")


@pytest.mark.parametrize("profile", ["isel", "servos", "orbit360"])
def test_without_relays_the_sentence_has_no_word_of_starts_and_motors(
    rotator_here: Rotator, flown: Path, tmp_path: Path, profile: str
) -> None:
    station = tmp_path / "station.toml"
    station.write_text(shipped(profile), encoding="utf-8")
    done = rotator_here("rehearse", flown, "--config", station)
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("° at worst\n")
    assert "None" not in done.stdout
    assert done.stderr == ""


def test_without_a_pass_it_lists_those_that_are_there(rotator_here: Rotator) -> None:
    done = rotator_here("rehearse")
    assert done.returncode == 0
    rows = done.stdout.splitlines()
    assert "north-1-iss      275° to  81°, up to 50°, 10.8 min" in rows
    assert rows[-1].startswith("Your own is a file. The first line is t,az,el; ")


@pytest.mark.parametrize("name", ["south", "[b]"])
def test_a_terminal_sees_how_far_it_is_and_the_result_stays(start_in_terminal: Rotator, flown: Path, name: str) -> None:
    """Square brackets in the name of a pass are letters, and not a colour of the terminal."""
    flying = start_in_terminal("rehearse", flown.rename(flown.with_stem(name)))
    flying.until(rf"{re.escape(name)} +\d+ of 60 s")
    flying.until(rf"{re.escape(name)}: the box was off by .* s of 60 s")
    assert flying.ends() == 0


def test_the_pass_is_not_written_over(rotator_here: Rotator, flown: Path) -> None:
    before = flown.read_bytes()
    done = rotator_here("rehearse", flown, "--trace", flown)
    assert done.returncode == 2
    assert "--trace would write over the pass" in done.stderr
    assert flown.read_bytes() == before


def test_two_runs_are_one(rotator_here: Rotator, flown: Path, tmp_path: Path, plain: tuple[Figures, bytes]) -> None:
    trace = tmp_path / "trace.csv"
    assert (figures(rotator_here("rehearse", flown, "--json", "--trace", trace)), trace.read_bytes()) == plain


def test_the_trace(rotator_here: Rotator, tmp_path: Path) -> None:
    """Of a pass through north: the target starts again at 0 there, the antenna counts on."""
    north, trace, picture = (tmp_path / name for name in ("north.csv", "trace.csv", "flight.svg"))
    rows = [f"{t},{(300 + t) % 360},{40 - abs(t - 60) / 2}" for t in range(0, 121, 10)]
    north.write_text("t,az,el\n" + "\n".join(rows) + "\n")
    summary = figures(rotator_here("rehearse", north, "--json", "--trace", trace, "--svg", picture))
    assert f"{summary['rms_deg']:.1f}° rms off" in picture.read_text(encoding="utf-8")
    with trace.open(newline="") as file:
        header, *lines = csv.reader(file)
    assert header == COLUMNS
    samples = [dict(zip(COLUMNS, map(float, row), strict=True)) for row in lines]
    assert all(0 < b["t"] - a["t"] <= 0.1001 for a, b in pairwise(samples)), "10 Hz or faster"
    first, last = samples[0], samples[-1]
    assert (first["t"], last["t"]) == (0, pytest.approx(120, abs=1.1))
    assert (first["antenna_az"], first["antenna_el"]) == (first["target_az"], 0), "at the first azimuth, level"
    assert all(0 <= row["target_az"] < 360 for row in samples)
    assert max(row["antenna_az"] for row in samples) > 360
    drives = [(row["az_drive"], row["el_drive"]) for row in samples]
    assert {drive for pair in drives for drive in pair} == {-1, 0, 1}
    starts = sum(now not in (before, 0) for a, b in pairwise(drives) for before, now in zip(a, b, strict=True))
    assert starts == summary["relay_starts"]
    assert sum(abs(az) + abs(el) for az, el in drives) / 20 == pytest.approx(summary["motor_s"], abs=0.01)


def test_a_configured_start_stands(rotator_here: Rotator, flown: Path, tmp_path: Path) -> None:
    config, trace = tmp_path / "station.toml", tmp_path / "trace.csv"
    config.write_text("[sim.azimuth]\nstart_deg = 100\n[sim.elevation]\nstart_deg = 20\n")
    figures(rotator_here("rehearse", flown, "--config", config, "--json", "--trace", trace))
    assert trace.read_text().splitlines()[1].split(",")[3:5] == ["100.0", "20.0"]


# --- how it is flown


def test_via_track_it_waits_at_the_rise_and_points_better(
    rotator_here: Rotator, flown: Path, tmp_path: Path, plain: tuple[Figures, bytes]
) -> None:
    trace = tmp_path / "trace.csv"
    told, _ = plain
    known = figures(rotator_here("rehearse", flown, "--json", "--via", "track", "--trace", trace))
    assert (known["relay_starts"], known["rms_deg"]) < (told["relay_starts"], told["rms_deg"])
    first, *_, last = trace.read_text().splitlines()[1:]
    assert float(first.split(",")[0]) == pytest.approx(-120.0)
    assert float(last.split(",")[0]) == pytest.approx(60, abs=1.1)


ELEMENTS = Path(__file__).parents[1] / "orbits" / "elements-2025.tle"


def test_a_target_is_tracked_in_its_next_pass_by_the_box_itself(rotator_here: Rotator, tmp_path: Path) -> None:
    """A low pass of two minutes and a half."""
    config, trace = tmp_path / "station.toml", tmp_path / "trace.csv"
    config.write_text(f'[station]\nlocator = "JO62qm"\n[sky]\nelements = ["{ELEMENTS}"]\n')
    words = ("rehearse", "--config", config, "--target", "iss", "--at", "2025-02-07T15:50:00Z", "--json")
    done = rotator_here(*words, "--trace", trace)
    assert re.match(r"ISS rises 07 Feb \d\d:\d\d:\d\d UTC, for \d+ min, up to \d+°. The flight .* takes", done.stderr)
    summary = figures(done)
    assert summary["p95_deg"] < 4.0
    rows = [dict(zip(COLUMNS, map(float, row.split(",")), strict=True)) for row in trace.read_text().splitlines()[1:]]
    assert rows[0]["t"] == pytest.approx(-120.0)
    rise = next(row for row in rows if row["t"] >= 0)
    assert rise["target_el"] == pytest.approx(0.0, abs=0.1), "its pass begins at the rise"
    waiting = [row for row in rows if -15.0 <= row["t"] <= 0.0]
    assert {(row["az_drive"], row["el_drive"]) for row in waiting} == {(0, 0)}


@pytest.mark.parametrize(
    ("file", "name", "said"),
    [
        ('[station]\nlocator = "JO62qm"\n', "iss", 'there is no target "iss". No satellites are known'),
        (
            "[rotor]\n",
            "moon",
            "the box does not know where it stands: write [station] and below it locator = ",
        ),
        ("[station]\nlatitude_deg = -85\nlongitude_deg = 0\n", "cas a", "Cas A does not rise within 7 days"),
    ],
)
def test_a_target_that_has_no_pass(rotator_here: Rotator, tmp_path: Path, *, file: str, name: str, said: str) -> None:
    config = tmp_path / "station.toml"
    config.write_text(file)
    done = rotator_here("rehearse", "--config", config, "--target", name, "--at", "2025-02-08T07:00:00Z")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(f"rotator: {said}")


def test_the_tolerance_is_the_file_s(
    rotator_here: Rotator, flown: Path, tmp_path: Path, plain: tuple[Figures, bytes]
) -> None:
    config = tmp_path / "station.toml"
    config.write_text("[azimuth]\ntolerance_deg = 1\n[elevation]\ntolerance_deg = 1\n")
    coarse, _ = plain
    fine = figures(rotator_here("rehearse", flown, "--config", config, "--json"))
    assert fine["relay_starts"] > coarse["relay_starts"]
    assert fine["rms_deg"] < coarse["rms_deg"]


def test_a_real_station_s_file_is_flown_on_a_simulated_rotor(
    rotator_here: Rotator, flown: Path, tmp_path: Path
) -> None:
    config = tmp_path / "station.toml"
    config.write_text('[rotor]\nhardware = "pi"\n[azimuth]\ncalibration = [[0.2, 0], [0.8, 450]]\n')
    assert figures(rotator_here("rehearse", flown, "--config", config, "--json"))["rms_deg"] < 6


def test_the_sketch_flies_the_same_pass(rotator_here: Rotator, flown: Path) -> None:
    done = rotator_here("rehearse", flown, "--arduino")
    assert done.returncode == 0
    assert done.stdout.startswith("south: the emulated Arduino was off by ")


def test_a_fault_strikes(rotator: Rotator, flown: Path, plain: tuple[Figures, bytes]) -> None:
    healthy, _ = plain
    done = rotator("rehearse", flown, "--json", "--fault", "azimuth-pot-open@10")
    assert done.returncode == 3
    struck = json.loads(done.stdout)
    assert struck["max_deg"] > healthy["max_deg"] + 30
    assert healthy["faults"] == []
    (fault,) = struck["faults"]
    assert fault.startswith("azimuth: pot open or shorted: ")
    assert done.stderr.endswith(f"rotator: at the end of the pass:\n         {fault}\n")
