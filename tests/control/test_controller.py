"""Orders through the controller: what each makes the motors do, with readings fed by hand.

The law that starts and stops a motor is tried only through what the controller promises.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, LoadTimed, Order, RunTimed, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
RESTING = {AZ: OFF, EL: OFF}


# --- aim


@pytest.mark.parametrize(
    ("azimuth_deg", "elevation_deg", "drives"),
    [
        (235, 25, {AZ: PLUS, EL: PLUS}),
        (30, 25, {AZ: MINUS, EL: PLUS}),
        (30, 0, {AZ: MINUS, EL: MINUS}),
        (100, 10, RESTING),
        (103, 13, RESTING),  # within the tolerance
    ],
)
def test_an_order_acts_in_the_step_that_takes_it(
    desk: Any, azimuth_deg: float, elevation_deg: float, drives: dict[Axis, Direction]
) -> None:
    assert desk.step(Aim(azimuth_deg, elevation_deg)) == drives


@pytest.mark.parametrize(("azimuth_deg", "elevation_deg"), [(235, 25), (30, 0), (370, 90), (0, 180)])
def test_the_antenna_arrives_and_rests(desk: Any, azimuth_deg: float, elevation_deg: float) -> None:
    desk.step(Aim(azimuth_deg, elevation_deg))
    desk.run(120.0)
    assert desk.at_rest()
    sky = abs(math.cos(math.radians(elevation_deg)))
    assert abs(desk.angle_deg[AZ] - azimuth_deg) * sky <= 4.0
    assert abs(desk.angle_deg[EL] - elevation_deg) <= 4.0
    assert desk.run(60.0) == set(), "on target a motor is left alone"


def test_azimuth_alone_leaves_elevation_to_what_it_was_doing(desk: Any) -> None:
    desk.step(Aim(235, 60))
    assert desk.step(Aim(30, None))[EL] is PLUS
    assert (desk.status.wanted_azimuth_deg, desk.status.wanted_elevation_deg) == (30, 60)


def test_elevation_alone_leaves_azimuth_to_what_it_was_doing(desk: Any) -> None:
    desk.step(Aim(235, 10))
    assert desk.step(Aim(None, 60)) == {AZ: PLUS, EL: PLUS}


def test_the_tolerance_is_on_the_sky(desk: Any) -> None:
    desk.place(EL, 60.0)
    assert desk.step(Aim(107, 60)) == RESTING, "7° of azimuth are 3.5° on the sky"
    assert desk.step(Aim(109, 60)) == {AZ: PLUS, EL: OFF}


def test_repeating_an_order_changes_nothing(desk: Any) -> None:
    desk.place(AZ, 200.0)
    desk.step(Aim(10, 10))
    assert desk.status.azimuth.target_deg == 370.0
    desk.angle_deg[AZ] = 100.0  # a gale: by now the other turn would be nearer
    for _ in range(20):
        desk.step(Aim(10, 10))
        assert (desk.status.azimuth.target_deg, desk.driven[AZ]) == (370.0, PLUS)


def test_an_order_every_second_starts_no_motor_again(desk: Any) -> None:
    desk.step(Aim(130, 10))
    starts = 1
    for _ in range(60):
        before = desk.driven[AZ]
        desk.step(Aim(130, 10))
        desk.run(0.95)
        starts += before is OFF and desk.driven[AZ] is not OFF
    assert starts == 1


@pytest.mark.parametrize("last", [Stop((AZ,)), Jog(AZ, MINUS, 0.5), Aim(100, None)], ids=["A", "L", "M"])
def test_when_a_stream_ends_on_one_axis_the_other_stays_where_it_was_last_sent(desk: Any, last: Order) -> None:
    for second in range(25):
        desk.run(0.95)
        desk.step(Aim(100 + second, 10 + 2 * second))
    desk.step(last)
    desk.run(60.0)
    assert desk.angle_deg[EL] == pytest.approx(58.0, abs=5.0)


# --- stop


def test_orders_of_one_step_are_taken_in_turn(desk: Any) -> None:
    assert desk.step(Aim(235, 60), Stop()) == RESTING
    assert desk.step(Stop(), Aim(235, 60)) == {AZ: PLUS, EL: PLUS}


# --- jog


@pytest.mark.parametrize(("axis", "way"), [(AZ, PLUS), (AZ, MINUS), (EL, PLUS), (EL, MINUS)], ids=str)
def test_a_jog_runs_to_the_soft_limit_and_no_further(desk: Any, axis: Axis, way: Direction) -> None:
    assert desk.step(Jog(axis, way))[axis] is way
    assert desk.run(120.0) == {(axis, way)}
    limit_deg = desk.range[axis].max_deg if way is PLUS else desk.range[axis].min_deg
    assert desk.angle_deg[axis] == pytest.approx(limit_deg, abs=0.3)
    assert desk.step(Jog(axis, way)) == RESTING


@pytest.mark.parametrize("before", [Jog(AZ, MINUS), Aim(30, 10)], ids=["jog", "aim"])
def test_a_jog_the_other_way_turns_round(desk: Any, before: Order) -> None:
    desk.step(before)
    desk.run(2.0)
    assert desk.driven[AZ] is MINUS
    desk.step(Jog(AZ, PLUS))
    desk.run(2.0)
    assert desk.driven[AZ] is PLUS


# --- park, timed lists, the rest


def test_a_timed_list_is_followed_and_a_stop_ends_it(desk: Any) -> None:
    desk.step(LoadTimed(2.0, ((110, None), (120, 40), (130, 50))))
    assert (desk.status.timed_point, desk.status.timed_points, desk.status.azimuth.target_deg) == (1, 3, 110)
    desk.run(10.0)  # it waits for T
    desk.step(RunTimed())
    assert (desk.status.timed_point, desk.status.wanted_azimuth_deg, desk.status.wanted_elevation_deg) == (2, 120, 40)
    desk.step(Stop())
    assert desk.run(10.0) == set()
    assert (desk.status.timed_point, desk.status.timed_points) == (2, 3)
