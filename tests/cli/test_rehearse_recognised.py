"""`rotator rehearse`: the satellite in a program's stream is recognised, where elements and the moment are known."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.cli.utc import iso
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.satellite import Satellite
from rotator.orbits.targets import find
from tests.cli.rehearsed import Rotator, figures, through_the_south
from tests.orbits.skyfield_oracle import TLE


@pytest.fixture
def flown(tmp_path: Path) -> Path:
    return through_the_south(tmp_path)


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
