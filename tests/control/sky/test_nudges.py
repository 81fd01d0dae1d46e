"""Nudges: what a person at the panel adds to everything that is asked for, until the mode changes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.sky.nudges import Nudges
from rotator.exchange.flight_order import AxisPlan, Fly, Step
from rotator.exchange.orders import Aim, Jog, Mode, Nudge, Park, Release, SetMode, Stop
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
OFF = Direction.OFF
PANEL, LINK = Source("panel"), Source("gs232b", 1)
RESTING = {AZ: OFF, EL: OFF}


def targets(desk: Any) -> tuple[float | None, float | None]:
    return desk.status.azimuth.target_deg, desk.status.elevation.target_deg


def test_it_is_added_to_what_is_asked_for_later(desk: Any) -> None:
    assert desk.step(Nudge(AZ, 10.0), Nudge(EL, -5.0), by=PANEL) == RESTING, "by itself it moves nothing"
    desk.step(Aim(235.0, 60.0), by=LINK)
    assert targets(desk) == (245.0, 55.0)


def test_what_is_asked_for_already_moves_by_as_much_at_once(desk: Any) -> None:
    desk.step(Aim(100.0, 60.0), by=LINK)
    desk.step(Nudge(AZ, 15.0), by=PANEL)
    assert targets(desk) == (115.0, 60.0)
    desk.step(Nudge(AZ, 20.0), by=PANEL)
    assert targets(desk) == (120.0, 60.0), "set, not added up"
    desk.step(Nudge(AZ, 0.0), by=PANEL)
    assert targets(desk) == (100.0, 60.0)


@pytest.mark.parametrize(("highest_deg", "goes_deg"), [(90.0, 90.0), (180.0, 95.0)])
def test_at_the_zenith_it_turns_no_antenna_to_the_other_side(highest_deg: float, goes_deg: float) -> None:
    """Raised by 5° beyond the axis's end, 67° and 90° would be 247° and 85°: half a turn of azimuth for 5°."""
    nudges = Nudges(highest_deg)
    nudges.set(EL, 5.0)
    assert nudges.applied(Aim(67.0, 90.0)) == Aim(67.0, goes_deg)
    assert nudges.applied(Aim(67.0, 80.0)) == Aim(67.0, 85.0)


@pytest.mark.parametrize(("asked_deg", "by_deg", "goes_deg"), [(355.0, 10.0, 5.0), (2.0, -5.0, 357.0)])
def test_round_the_circle(new_desk: Any, asked_deg: float, by_deg: float, goes_deg: float) -> None:
    desk = new_desk(azimuth=(0.0, 360.0))
    desk.step()
    desk.step(Nudge(AZ, by_deg), Aim(asked_deg, 20.0), by=LINK)
    assert desk.status.azimuth.target_deg == goes_deg


def test_on_the_overlap_it_stays_on_its_turn(desk: Any) -> None:
    desk.step(Nudge(AZ, 10.0), by=PANEL)
    desk.step(Aim(400.0, 20.0), by=LINK)
    assert desk.status.azimuth.target_deg == 410.0


def test_not_beyond_the_limits(desk: Any) -> None:
    desk.step(Nudge(EL, -30.0), by=PANEL)
    desk.step(Aim(235.0, 20.0), by=LINK)
    assert desk.status.elevation.target_deg == 0.0


KNOWN = Fly(
    "ISS",
    tuple((900.0 + second, 100.0, 30.0) for second in range(400)),
    AxisPlan(900.0, (100.0,) * 800, (Step(900.0, 100.0),)),
    AxisPlan(900.0, (30.0,) * 800, (Step(900.0, 30.0),)),
)
OVER = replace(
    KNOWN, azimuth=replace(KNOWN.azimuth, angles_deg=(280.0,) * 800, steps=(Step(900.0, 280.0),)),
    elevation=replace(KNOWN.elevation, angles_deg=(150.0,) * 800, steps=(Step(900.0, 150.0),)),
)  # fmt: skip


@pytest.mark.parametrize(("flown", "goes"), [(KNOWN, (105.0, 32.0)), (OVER, (285.0, 148.0))], ids=["level", "over"])
def test_a_pass_that_is_flown_as_planned_is_shifted_too(desk: Any, flown: Fly, goes: tuple[float, float]) -> None:
    desk.step(flown, by=LINK)
    straight = targets(desk)
    desk.step(Nudge(AZ, 5.0), Nudge(EL, 2.0), by=PANEL)
    assert targets(desk) == goes
    desk.step(Nudge(AZ, 0.0), Nudge(EL, 0.0), by=PANEL)
    assert targets(desk) == straight


def test_a_pass_that_begins_with_a_nudge_is_shifted_from_its_beginning(desk: Any) -> None:
    desk.step(Nudge(EL, -40.0), by=PANEL)
    desk.step(KNOWN, by=LINK)
    assert targets(desk) == (100.0, 0.0)


@pytest.mark.parametrize(
    "order",
    [
        pytest.param(Stop(), id="stopped"),
        pytest.param(
            Aim(200.0, 30.0, engaged=False),
            id="not-engaged",
        ),
    ],
)
def test_it_starts_nothing_that_has_been_stopped(desk: Any, order: Stop | Aim) -> None:
    desk.step(Aim(235.0, 60.0), by=LINK)
    desk.run(1.0)
    desk.step(order, by=LINK)
    assert desk.step(Nudge(AZ, 30.0), by=PANEL) == RESTING
    assert desk.run(5.0) == set()


def test_nor_what_a_person_has_latched(desk: Any) -> None:
    desk.step(Aim(235.0, 60.0), by=LINK)
    desk.step(Stop(latch=True), by=PANEL)
    desk.step(Nudge(AZ, 30.0), by=PANEL)
    assert desk.run(3.0) == set()
    desk.step(Release(), by=PANEL)
    assert desk.run(3.0) == set()


def test_nor_does_it_take_over_from_a_jog(desk: Any) -> None:
    desk.step(Aim(235.0, 60.0), by=LINK)
    desk.step(Jog(AZ, Direction.MINUS), by=LINK)
    desk.step(Nudge(AZ, 30.0), by=PANEL)
    assert desk.status.azimuth.target_deg is None
    assert desk.driven[AZ] is not Direction.PLUS


def test_the_park_position_is_a_place_and_is_not_nudged(desk: Any) -> None:
    desk.step(Nudge(AZ, 30.0), by=PANEL)
    desk.step(Park(), by=LINK)
    assert targets(desk) == (0.0, 0.0)


def test_turning_the_mode_switch_forgets_them(desk: Any) -> None:
    desk.step(Nudge(AZ, 30.0), Nudge(EL, 30.0), by=PANEL)
    desk.step(SetMode(Mode.MANUAL), SetMode(Mode.AUTO), by=PANEL)
    desk.step(Aim(235.0, 60.0), by=LINK)
    assert targets(desk) == (235.0, 60.0)


def test_one_axis_alone(desk: Any) -> None:
    desk.step(Nudge(EL, 7.0), by=PANEL)
    desk.step(Aim(None, 60.0), by=LINK)
    assert targets(desk) == (None, 67.0)


# --- the nudge of a pass, which a person sets on the page while it is tracked


PAGE, TRACKS = Source("page", 1), Source("track")


def nudge_of_pass(desk: Any) -> tuple[float, float]:
    return desk.status.nudge_azimuth_deg, desk.status.nudge_elevation_deg


def test_the_nudge_of_a_pass_rides_on_the_flight_and_on_the_panels_nudge(desk: Any) -> None:
    desk.step(Nudge(EL, 10.0), by=PANEL)
    desk.step(KNOWN, by=TRACKS)
    desk.step(Nudge(AZ, 2.0, of_pass=True), Nudge(EL, -1.0, of_pass=True), by=PAGE)
    assert targets(desk) == (102.0, 39.0)
    assert nudge_of_pass(desk) == (2.0, -1.0)
    assert desk.status.flown.name == "ISS", "it is tracked on"
    desk.step(Nudge(AZ, 0.0, of_pass=True), Nudge(EL, 0.0, of_pass=True), by=PAGE)
    assert targets(desk) == (100.0, 40.0)


@pytest.mark.parametrize(
    ("order", "by", "ends"),
    [
        (replace(KNOWN, name="SO-50"), TRACKS, True),
        (KNOWN, TRACKS, False),
        (Stop(latch=True), PAGE, True),
        (Jog(AZ, Direction.PLUS, 0.1), PAGE, True),
        (Aim(101.0, 20.0), PAGE, True),
        (Park(), PAGE, True),
        (SetMode(Mode.MANUAL), PAGE, True),
    ],
)
def test_it_ends_with_the_pass_and_with_what_ends_it(desk: Any, order: Any, by: Source, ends: bool) -> None:
    desk.step(KNOWN, by=TRACKS)
    desk.step(Nudge(AZ, 2.0, of_pass=True), by=PAGE)
    desk.step(order, by=by)
    desk.step()
    assert nudge_of_pass(desk) == ((0.0, 0.0) if ends else (2.0, 0.0))


def test_it_ends_when_the_target_has_set(desk: Any) -> None:
    desk.step(KNOWN, by=TRACKS)
    desk.step(Nudge(AZ, 2.0, of_pass=True), by=PAGE)
    desk.run(330.0)
    assert nudge_of_pass(desk) == (0.0, 0.0)


@pytest.mark.parametrize(("next_deg", "stays"), [(104.0, True), (170.0, False)])
def test_it_stays_on_a_programs_stream_until_that_leaps_to_another_target(
    desk: Any, next_deg: float, stays: bool
) -> None:
    desk.step(Aim(100.0, 20.0), by=LINK)
    desk.step(Nudge(AZ, 2.0, of_pass=True), by=PAGE)
    desk.step(Stop(), by=LINK)
    desk.step(Aim(next_deg, 20.0), by=LINK)
    assert targets(desk)[0] == pytest.approx(next_deg + (2.0 if stays else 0.0))
