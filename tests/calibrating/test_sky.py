"""`rotator calibrate sky` in simulated time: a mount that stands askew, and an operator who steers by a signal."""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest

from rotator.calibrating.results import as_toml, save
from rotator.config.load import load
from rotator.config.model import Config
from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.pointing_model import PointingModel
from tests.calibrating.rig import SkyCalibration

ASKEW = PointingModel(ia_deg=4, ie_deg=-3, an_deg=2.5, aw_deg=-2, ca_deg=1.5, npae_deg=-1)
PLACES = ((20, 20), (75, 55), (130, 30), (190, 65), (250, 15), (310, 45), (340, 70), (100, 12))


def station(**more: Any) -> Config:
    tables: dict[str, Any] = {
        "rotor": {"type": "moteus"},
        "elevation": {"min_deg": -10, "max_deg": 180},
        "sim": {"mount": asdict(ASKEW), "bus_takes_time": False},
    }
    return Config.model_validate(tables | more)


def begun(config: Config | None = None, place: tuple[float, float] = PLACES[0]) -> SkyCalibration:
    sky = SkyCalibration(config or station(), place, start_deg=(0.0, 0.0))
    sky.say("y")
    return sky


def taken(sky: SkyCalibration, *places: tuple[float, float]) -> SkyCalibration:
    for place in places:
        sky.look(*place)
        sky.say("y")
        sky.centre()
        sky.say("")
    return sky


def off_deg(model: PointingModel) -> float:
    """How far the boom of the askew mount points from where the model takes it to point, rms over the sky."""
    squares = [
        great_circle_deg(*ASKEW.pointed(azimuth_deg, elevation_deg), *model.pointed(azimuth_deg, elevation_deg)) ** 2
        for azimuth_deg in range(0, 360, 30)
        for elevation_deg in range(5, 80, 15)
    ]
    return math.sqrt(sum(squares) / len(squares))


@pytest.mark.long
def test_six_errors_are_found_from_eight_places_and_saved(tmp_path: Path) -> None:
    sky = taken(begun(), *PLACES)
    text = sky.say("f")
    assert "edge to edge" in text
    assert [line.split()[0] for line in text.splitlines() if line.endswith("°") and line[:8].strip().isdigit()] == [
        str(number) for number in range(1, 9)
    ]
    sky.say("y")
    found = sky.guide.result
    assert found is not None
    assert off_deg(found.model) <= 0.3
    path = tmp_path / "station.toml"
    path.write_text('[mount]\nflip = "off"   # mine\n')
    save(found, path)
    kept = load(path).mount
    assert PointingModel(**kept.model.model_dump(exclude={"points"})).ia_deg == pytest.approx(
        found.model.ia_deg, abs=1e-3
    )
    assert len(kept.model.points) == 8
    assert "# mine" in path.read_text()
    assert (tmp_path / "station.toml.bak").read_text() == '[mount]\nflip = "off"   # mine\n'
    assert as_toml(found).startswith("[mount.model]\nia_deg")


@pytest.mark.long
def test_points_of_an_earlier_time_count_too() -> None:
    sky = taken(begun(), *PLACES[:2])
    sky.say("f", "y")
    first = sky.guide.result
    assert first is not None
    model = asdict(first.model) | {"points": [list(point) for point in first.points]}
    again = begun(station(mount={"model": model}), PLACES[2])
    assert "The file has 2 points" in again.guide.prompt
    again.say("y")
    taken(again, *PLACES[2:]).say("f", "y")
    found = again.guide.result
    assert found is not None
    assert len(found.points) == 8
    assert off_deg(found.model) <= 0.3


def test_an_offset_of_the_file_is_not_in_the_points_it_keeps() -> None:
    sky = taken(begun(station(azimuth={"offset_deg": 10.0})), PLACES[1])
    sky.say("f", "y")
    found = sky.guide.result
    assert found is not None
    assert found.points[0][0] == pytest.approx(sky.world.antenna()[0], abs=0.2)


def test_a_point_can_be_taken_back_and_nothing_is_saved_without_any() -> None:
    sky = taken(begun(), PLACES[0])
    assert "Taken back: the point at 20.0°, 20.0°" in sky.say("b")
    assert "There is no point yet" in sky.say("f")
    assert sky.guide.result is None


def test_a_model_that_is_no_better_is_not_offered() -> None:
    """By the model in force the box points at the target: what is left is the rest of the steering."""
    sky = begun(station(mount={"model": asdict(ASKEW)}), PLACES[2])
    sky.say("y")
    right, above = sky.off_deg()
    assert abs(right) < 0.1
    assert abs(above) < 0.1
    for _ in range(2):
        sky.say("")
    assert "Save it?" not in sky.say("f")
    assert "Nothing is saved." in sky.text
    assert sky.guide.result is None


def test_a_target_below_the_horizon_ends_it() -> None:
    sky = SkyCalibration(station(), (100, -12), start_deg=(0.0, 0.0))
    assert "The beacon is 12° below the horizon" in sky.say("y")
    assert sky.guide.ended


def test_a_wrong_clock_ends_it() -> None:
    sky = SkyCalibration(station(), PLACES[0], start_deg=(0.0, 0.0))
    assert "Then set the clock first" in sky.say("n")


def test_a_boom_that_points_elsewhere_gives_no_point() -> None:
    sky = begun()
    assert "Refused: the beacon is 2" in sky.say("")
    assert "0 points" in sky.guide.prompt


def test_on_the_way_to_the_target_s_stops_it() -> None:
    sky = begun(place=(180, 30))
    sky.now("y")
    sky.wait(2.0)
    sky.now("s")
    sky.wait(3.0)
    assert "Stopped." in sky.text
    assert sky.world.antenna()[0] < 150


def test_a_faulted_axis_ends_it() -> None:
    sky = SkyCalibration(station(rotor={"type": "relay-pot"}), PLACES[0], bad_luck="azimuth-pot-open")
    sky.wait(3.0)
    assert "Refused: azimuth: pot open" in sky.text
    assert sky.guide.ended
