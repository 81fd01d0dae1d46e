"""`rotator rehearse`: a pass in, figures and a trace out, the same every time."""

from __future__ import annotations

import csv
import json
import re
import subprocess
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from rotator.cli.utc import iso
from rotator.config.load import shipped
from rotator.control.sky.angles import great_circle_deg
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.targets import find
from tests.cli.conftest import COMMAND
from tests.orbits.skyfield_oracle import TLE

KEYS = ["rms_deg", "p95_deg", "max_deg", "relay_starts", "motor_s", "recognised", "faults"]
COLUMNS = ["t", "target_az", "target_el", "antenna_az", "antenna_el", "az_drive", "el_drive"]
Rotator = Callable[..., Any]


Figures = dict[str, Any]
Rows = list[tuple[float, float, float]]


def through_the_south(folder: Path) -> Path:
    """A pass of a minute."""
    path = folder / "south.csv"
    rows = [f"{t},{100 + t},{10 + t / 4}" for t in range(0, 61, 10)]
    path.write_text("t,az,el\n" + "\n".join(rows) + "\n")
    return path


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


def figures(done: Any) -> Figures:
    assert done.returncode == 0, done.stderr
    return dict(json.loads(done.stdout))


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


def test_a_terminal_sees_how_far_it_is_and_the_result_stays(start_in_terminal: Rotator, flown: Path) -> None:
    flying = start_in_terminal("rehearse", flown)
    flying.until(r"south +\d+ of 60 s")
    flying.until(r"south: the box was off by .* s of 60 s")
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


def test_via_rotctld(rotator_here: Rotator, flown: Path) -> None:
    summary = figures(rotator_here("rehearse", flown, "--via", "rotctld", "--json"))
    assert list(summary) == KEYS
    assert summary["rms_deg"] < 6


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


# --- a table that names its turns


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


# --- what is refused


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (None, "cannot be read: "),
        ("", "is empty. The first line is t,az,el; "),
        ("t,az,el\n0,0,0\n", "a pass needs two rows or more"),
        ("t,az,el\n0,0,0\n1,north,0\n", "t, az and el must be numbers"),
        ("t,az,el\n0,0,0\n0,1,0\n", ":3: t must rise from row to row"),
    ],
    ids=["missing", "empty", "one row", "a word", "no time"],
)
def test_a_bad_pass(rotator_here: Rotator, tmp_path: Path, text: str | None, said: str) -> None:
    path = tmp_path / "bad.csv"
    if text is not None:
        path.write_text(text)
    done = rotator_here("rehearse", path, "--json")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(f"rotator: {path}")
    assert said in done.stderr


@pytest.mark.parametrize(
    ("words", "said", "code"),
    [
        (("--via", "telepathy"), "'telepathy' is not one of", 2),
        (("--fault", "gremlins"), "no fault called gremlins", 2),
        (("--arduino", "--fault", "adc-gone"), "--fault is for the box", 2),
        (("--config", "nowhere.toml"), "nowhere.toml: 1 mistake", 2),
        (("--fault", "azimuth-pot-open@"), "after @ stands the moment in seconds, such as azimuth-pot-open@20", 2),
        (("--fault", "azimuth-pot-open@-3"), "azimuth-pot-open@-3: after @ stands the moment in seconds", 2),
        (("--fault", "azimuth-pot-open@nan"), "azimuth-pot-open@nan: after @ stands the moment in seconds", 2),
        (("--fault", "azimuth-pot-open@60"), "azimuth-pot-open@60: south ends after 60 s", 2),
        (("--trace", "nowhere/trace.csv"), "nowhere/trace.csv: cannot be written: No such file or directory", 1),
    ],
)
def test_what_cannot_be_done(
    rotator_here: Rotator, flown: Path, *, words: tuple[str, ...], said: str, code: int
) -> None:
    done = rotator_here("rehearse", flown, *words)
    assert done.returncode == code
    assert said in done.stderr


def test_a_shipped_pass_is_found_by_its_name(rotator_here: Rotator) -> None:
    """Here by what is said of a fault after its end: nothing has to be flown for that."""
    done = rotator_here("rehearse", "north-1-iss", "--fault", "azimuth-pot-open@900")
    assert "azimuth-pot-open@900: north-1-iss ends after 651 s" in done.stderr


def test_the_faults_there_are(rotator_here: Rotator, flown: Path) -> None:
    done = rotator_here("rehearse", flown, "--fault", "list")
    assert done.returncode == 0
    assert "azimuth-pot-open" in done.stdout.splitlines()


# --- a program's stream, recognised


SKY = """[station]
latitude_deg = 48.85
longitude_deg = 2.35
[sky]
elements = ["{elements}"]
"""


@pytest.fixture
def sky(tmp_path: Path) -> tuple[Path, Path, str]:
    """A configuration that knows satellites, the first minute of a pass of the ISS, and when it begins."""
    station, path = tmp_path / "station.toml", tmp_path / "minute.csv"
    station.write_text(SKY.format(elements=TLE), encoding="utf-8")
    iss = find("iss", Site(48.85, 2.35), Catalogue((str(TLE),)))
    assert isinstance(iss, Satellite)
    aos_s = next(passes(iss, iss.elements.epoch_utc_s, iss.elements.epoch_utc_s + 86_400.0)).aos_s
    assert aos_s is not None
    sights = [(t, iss.sight(aos_s + t)) for t in range(61)]
    rows = [f"{t},{sight.azimuth_deg},{sight.elevation_deg}" for t, sight in sights]
    path.write_text("t,az,el\n" + "\n".join(rows) + "\n", encoding="utf-8")
    return station, path, iso(aos_s)


def test_the_satellite_in_a_programs_stream_is_named(rotator_here: Rotator, sky: tuple[Path, Path, str]) -> None:
    station, path, begin = sky
    told = figures(rotator_here("rehearse", path, "--config", station, "--at", begin, "--json"))
    assert told["recognised"]["name"] == "ISS"
    after_s = told["recognised"]["after_s"]
    assert 7.0 <= after_s <= 10.0
    sentence = rotator_here("rehearse", path, "--config", station, "--at", begin).stdout
    assert sentence.endswith(f"; it recognised ISS after {after_s:.0f} s\n")


def test_a_day_later_it_is_no_satellite(rotator_here: Rotator, sky: tuple[Path, Path, str]) -> None:
    station, path, begin = sky
    later = begin.replace("2025-02-28", "2025-03-02").replace("2025-03-01", "2025-03-02")
    assert later != begin
    assert figures(rotator_here("rehearse", path, "--config", station, "--at", later, "--json"))["recognised"] is None


def test_a_station_that_only_fetches_elements_has_a_sky(rotator_here: Rotator, sky: tuple[Path, Path, str]) -> None:
    station, path, begin = sky
    text = station.read_text(encoding="utf-8")
    assert "\nelements = " in text
    fetch = 'fetch = "http://127.0.0.1:1/elements"'
    station.write_text("\n".join(fetch if each.startswith("elements") else each for each in text.splitlines()))
    done = figures(rotator_here("rehearse", path, "--config", station, "--at", begin, "--json"))
    assert done["recognised"] is None, "none has been fetched"


def test_a_moment_without_a_sky_is_refused(rotator_here: Rotator, flown: Path) -> None:
    done = rotator_here("rehearse", flown, "--at", "2025-02-28T18:00:00Z")
    assert done.returncode == 2
    assert "[station]" in done.stderr
    assert "[sky] elements" in done.stderr
