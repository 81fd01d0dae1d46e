"""`rotator calibrate sky --receiver` in simulated time: the box finds by itself where a target is heard best."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from firmware_sim.parts.receiver import ReceiverSpec, SimReceiver
from rotator.calibrating.receiver import Strength
from rotator.config.model import Config
from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.pointing_model import PERFECT
from rotator.orbits.sight import Sight
from tests.calibrating.rig import PERIOD_S, Hears, SkyCalibration

BEAM_DEG = 15.0
PLACE = (130.0, 35.0)
ASKEW = {"ia_deg": 3.0, "ie_deg": -2.0, "an_deg": 1.0}


def station(kind: str = "moteus", **more: Any) -> Config:
    tables: dict[str, Any] = {
        "rotor": {"type": kind},
        "station": {"beam_deg": BEAM_DEG},
        "sim": {"mount": ASKEW, "bus_takes_time": False},
    }
    return Config.model_validate(tables | more)


def behind(spec: ReceiverSpec | None = None) -> Hears:
    """A receiver behind the simulated boom."""

    def hears(clock: Callable[[], float], off_deg: Callable[[], float]) -> Callable[[], Strength]:
        receiver = SimReceiver(spec or ReceiverSpec(BEAM_DEG), clock, off_deg)
        return lambda: Strength(clock(), receiver.strength_db())

    return hears


def telling(strength_db: float, until_s: float = math.inf, problem: str = "") -> Hears:
    """The same strength wherever the boom points; after that moment its problem, or nothing new."""

    def hears(clock: Callable[[], float], _off_deg: Callable[[], float]) -> Callable[[], Strength]:
        def latest() -> Strength:
            if clock() < until_s:
                return Strength(clock(), strength_db)
            return Strength(clock(), problem=problem) if problem else Strength(until_s, strength_db)

        return latest

    return hears


class Across:
    """A target that crosses the sky at 0.1° a second."""

    name = "the beacon"

    def sight(self, utc_s: float) -> Sight:
        return Sight((130.0 + 0.1 * (utc_s - 1_780_000_000.0)) % 360.0, 35.0, 800.0)

    def late_s(self, _utc_s: float) -> float:
        return 0.0


def off_deg(sky: SkyCalibration, point: SkyPoint) -> float:
    """How far from the target the boom truly points with the axes at the point's angles."""
    there = sky.boom(point.axis_azimuth_deg, point.axis_elevation_deg)
    return math.hypot(*SkyPoint(*there, point.azimuth_deg, point.elevation_deg).miss(PERFECT))


def scanned(config: Config, hears: Hears, place: tuple[float, float] = PLACE, **more: Any) -> SkyCalibration:
    sky = SkyCalibration(config, place, hears=hears, start_deg=place, **more)
    sky.say("y", "y")
    return sky


@pytest.mark.long
def test_with_relays_and_play_in_its_gears_it_finds_a_target_that_moves_meanwhile() -> None:
    sky = scanned(station("relay-pot"), behind(ReceiverSpec(BEAM_DEG, fading_db=0.7)), target=Across())
    (point,) = sky.guide.points
    assert point.azimuth_deg > PLACE[0] + 8
    assert off_deg(sky, point) < BEAM_DEG / 15
    sky.say("f")
    assert "the points on the sky" in sky.text
    sky.say("y")
    assert sky.guide.result is not None
    assert sky.guide.result.model.ia_deg == pytest.approx(ASKEW["ia_deg"], abs=1.8)


@pytest.mark.long
def test_a_peak_at_the_edge_of_the_cross_is_looked_at_once_more() -> None:
    config = station(sim={"mount": {"ia_deg": 10.0}, "bus_takes_time": False}, station={"beam_deg": 8.0})
    sky = scanned(config, behind(ReceiverSpec(8.0)))
    assert "The peak lies at the edge" in sky.text
    (point,) = sky.guide.points
    assert off_deg(sky, point) < 0.8


@pytest.mark.long
@pytest.mark.parametrize(
    ("hears", "says"),
    [
        (behind(ReceiverSpec(BEAM_DEG, signal_db=-40.0)), "No peak: the strength varies by"),
        (telling(-54.0, until_s=9.0), "The receiver has given no strength for 5 s"),
        (telling(-54.0, until_s=9.0, problem="the receiver at shack:4532: refused"), "The receiver at shack:4532: ref"),
    ],
)
def test_what_tells_no_middle_gives_no_point(hears: Hears, says: str) -> None:
    sky = scanned(station(), hears)
    assert says in sky.text
    assert "No point is taken." in sky.text
    assert "0 points" in sky.guide.prompt
    assert not sky.moving()


@pytest.mark.long
def test_a_single_answer_that_fails_ends_no_scan() -> None:
    """A receiver on a slow CAT line refuses some questions, for less than the 5 s in which it would be gone."""

    def stammers(clock: Callable[[], float], off_deg: Callable[[], float]) -> Callable[[], Strength | None]:
        tells = behind()(clock, off_deg)
        return lambda: Strength(clock(), problem="RPRT -5") if clock() % 7.0 < 2.0 else tells()

    sky = scanned(station(), stammers)
    (point,) = sky.guide.points
    assert off_deg(sky, point) < BEAM_DEG / 10


@pytest.mark.long
@pytest.mark.parametrize("late_s", [0.5, 2.9])
def test_what_a_slow_receiver_heard_while_the_boom_still_turned_does_not_count(late_s: float) -> None:
    """It answers late, and its answer is of the moment of the question."""

    def slow(clock: Callable[[], float], off_deg: Callable[[], float]) -> Callable[[], Strength | None]:
        tells = behind()(clock, off_deg)
        asked: list[tuple[float, Strength | None]] = []
        told: list[Strength | None] = [None]

        def latest() -> Strength | None:
            if not asked:
                asked.append((clock(), tells()))
            begun_s, heard = asked[-1]
            if heard is not None and clock() >= begun_s + late_s:
                told[0] = Strength(clock(), heard.strength_db, asked_s=begun_s)
                asked.clear()
            return told[0]

        return latest

    sky = scanned(station(), slow)
    (point,) = sky.guide.points
    assert off_deg(sky, point) < BEAM_DEG / 30


def test_a_receiver_that_has_never_told_anything_ends_the_scan() -> None:
    sky = scanned(station(), lambda _clock, _off_deg: lambda: None)
    assert "The receiver has given no strength for 5 s. No point is taken." in sky.text


@pytest.mark.long
def test_s_stops_the_scan_in_any_step_of_a_place() -> None:
    """Of the turn, of the wait until the boom stands, of the listening, and in the last one of each."""
    narrow = station("relay-pot", station={"beam_deg": 4.0})
    for steps in range(1, 400):
        sky = SkyCalibration(narrow, PLACE, hears=behind(), start_deg=PLACE)
        sky.say("y")
        sky.now("y")
        sky.wait(steps * PERIOD_S)
        place = sky.guide.prompt
        sky.with_the_next("s")
        assert "Stopped. No point is taken." in sky.text, f"after {steps} steps"
        if "place 2 " in place:
            sky.wait(1.5)
            assert not sky.moving()
            return
    pytest.fail("place 2 never comes")


def test_a_range_too_narrow_for_a_cross_is_refused() -> None:
    sky = scanned(station(azimuth={"min_deg": 125.0, "max_deg": 135.0}), behind())
    assert "Range, horizon or sectors leave too little room around the beacon. No point is taken." in sky.text


def test_the_scan_goes_into_no_sector() -> None:
    """Beside one the cross has the places that are free."""
    sector = {"name": "mast", "azimuth_deg": [138.0, 160.0], "elevation_deg": [0.0, 90.0]}
    sky = SkyCalibration(station(mount={"forbidden": [sector]}), PLACE, hears=behind(), start_deg=PLACE)
    sky.say("y")
    sky.now("y")
    azimuths_deg = []
    while "place 12" not in sky.guide.prompt:
        sky.wait(0.5)
        azimuths_deg.append(sky.shaft_deg())
    assert min(azimuths_deg) < 115.0
    assert 132.0 < max(azimuths_deg) < 138.0
