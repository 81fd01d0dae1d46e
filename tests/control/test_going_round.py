"""The way round forbidden sectors, for axes that aim: over and beside them, waiting where there is no way, and why."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.reach import bounds
from rotator.control.sky.mount import Range, Sector
from rotator.exchange.motor import Motor
from rotator.exchange.orders import Aim, Release, Stop
from tests.search import some

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS, MINUS = Direction.PLUS, Direction.MINUS
CHIMNEY = Sector("the chimney", Range(100, 130), Range(0, 35), 2.0)
WAITS = "a sector is in the way, and the other axis was stopped: waits"


def notices(desk: Any) -> list[str]:
    return [notice.text for axis in Axis for notice in desk.status.axis(axis).notices]


def met(desk: Any) -> bool:
    return bool(100 < desk.angle_deg[AZ] < 130 and desk.angle_deg[EL] < 35)


@pytest.fixture
def beside(new_desk: Any) -> Any:
    """South of the chimney, below its top."""
    desk = new_desk(at=(60.0, 10.0), sectors=(CHIMNEY,))
    desk.step()
    return desk


def test_a_stream_into_it_waits_beside_it_and_goes_round_to_a_target_beyond(beside: Any) -> None:
    starts, was = 0, Direction.OFF
    for second in range(60):
        beside.step(Aim(90.0 + second, 20.0))
        for _ in range(19):
            beside.step()
            starts += was is Direction.OFF and beside.driven[AZ] is not Direction.OFF
            was = beside.driven[AZ]
            assert not (100 < beside.angle_deg[AZ] < 130 and beside.angle_deg[EL] < 35)
    beside.run(30.0)
    assert beside.angle_deg[AZ] == pytest.approx(149, abs=5)
    assert beside.angle_deg[EL] == pytest.approx(20, abs=5)
    assert starts < 25


@pytest.mark.search
@pytest.mark.parametrize("described", some([0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5, 2.5]))
def test_with_any_wrong_speed_in_the_file_it_waits_where_the_fence_lets_it_start_again(
    new_desk: Any, described: float
) -> None:
    """The fence keeps the room that the motors need as they have been learnt; the way round keeps it too."""
    desk = new_desk(at=(40.0, 10.0), sectors=(CHIMNEY,), described=described)
    desk.step()
    for target_deg in ((20.0, 40.0), (60.0, 10.0)) * 4:
        desk.step(Aim(*target_deg))
        desk.run(20.0)
    for target_deg in ((101.0, 5.0), (115.0, 34.0)):
        desk.step(Aim(*target_deg))
        desk.run(0.1)
        places = [axis.target_deg for axis in (desk.status.azimuth, desk.status.elevation)]
        azimuth_room_deg, elevation_room_deg = (room_deg(desk, axis, described) for axis in Axis)
        assert places[0] < 98.0 - azimuth_room_deg or places[1] > 37.0 + elevation_room_deg
        desk.run(60.0)
        assert not any("stopped before" in notice for notice in notices(desk))


def room_deg(desk: Any, axis: Axis, described: float) -> float:
    """How far a motor as fast as its runs have shown may go before a command can end that."""
    written = Motor(desk.SPEED_DPS[axis] * described, desk.SPEED_DPS[axis] * described * desk.LAG_S)
    learnt = desk.status.axis(axis).learnt
    return max(bounds(written, Motor(motor.speed_dps, motor.coast_deg), 0.0).stopping_room_deg for motor in learnt)


def test_an_order_for_azimuth_alone_goes_over_it_and_comes_down_again(beside: Any) -> None:
    beside.step(Aim(200.0, None))
    beside.run(60.0)
    assert beside.angle_deg[AZ] == pytest.approx(200, abs=4)
    assert beside.angle_deg[EL] == pytest.approx(10, abs=4)


def test_a_place_that_the_other_turn_reaches_is_met_there(new_desk: Any) -> None:
    tower = Sector("the tower", Range(100, 110), Range(0, 180), 2.0)
    desk = new_desk(at=(300.0, 10.0), sectors=(tower,))
    desk.step()
    desk.step(Aim(60.0, 10.0))
    desk.run(40.0)
    assert desk.angle_deg[AZ] == pytest.approx(420, abs=4)


def test_without_a_way_it_stays_on_this_side_and_says_so(new_desk: Any) -> None:
    tower = Sector("the tower", Range(100, 110), Range(0, 180), 2.0)
    desk = new_desk(at=(300.0, 10.0), sectors=(tower,))
    desk.step()
    desk.step(Aim(95.0, 50.0))
    desk.run(60.0)
    assert 112 < desk.angle_deg[AZ] < 123, "its coast was not seen before"
    assert any("behind the tower" in text for text in notices(desk))


def test_an_order_first_leads_it_out_and_says_so(beside: Any) -> None:
    desk = beside
    desk.place(AZ, 106.0)
    for _ in range(2):
        desk.step(Stop())
        desk.run(5.0)
    desk.step(Aim(300.0, 10.0))
    assert any("in the chimney" in text for text in notices(desk))
    while desk.angle_deg[AZ] > 99.0:
        assert desk.run(0.05) <= {(AZ, MINUS)}
    desk.run(90.0)
    assert desk.angle_deg[AZ] == pytest.approx(300, abs=4)


def test_a_target_behind_it_is_reached_over_it_without_a_word(beside: Any) -> None:
    beside.step(Aim(200.0, 12.0))
    for _ in range(1200):
        beside.step()
        assert not met(beside)
        assert notices(beside) == []
    assert (beside.angle_deg[AZ], beside.angle_deg[EL]) == pytest.approx((200, 12), abs=5)


def test_a_target_inside_is_waited_for_at_the_nearest_free_place_and_that_is_said(beside: Any) -> None:
    beside.step(Aim(105.0, 10.0))
    beside.run(30.0)
    place_deg = beside.status.azimuth.target_deg
    assert 88 < place_deg < 98
    assert notices(beside) == [f"the target is in or behind the chimney: waits at {place_deg:.0f}°"]
    assert beside.status.elevation.target_deg == 10.0
    beside.step(Aim(200.0, 60.0))
    beside.run(40.0)
    assert notices(beside) == []
    assert (beside.status.azimuth.target_deg, beside.status.elevation.target_deg) == (200.0, 60.0)


def test_the_wish_of_the_other_axis_is_kept_while_one_of_them_waits(beside: Any) -> None:
    """Elevation is asked again, and so leads azimuth over the chimney to where it was ordered to before."""
    beside.step(Aim(115.0, 10.0))
    beside.run(20.0)
    beside.step(Aim(None, 60.0))
    beside.run(40.0)
    assert (beside.angle_deg[AZ], beside.angle_deg[EL]) == pytest.approx((115, 60), abs=5)


@pytest.mark.parametrize("goes_on", [False, True])
def test_an_axis_that_was_stopped_is_not_moved_out_of_the_way(beside: Any, goes_on: bool) -> None:
    beside.step(Aim(200.0, 10.0))
    beside.run(8.0)
    beside.step(Stop((EL,)))
    beside.run(2.0)
    stands = dict(beside.angle_deg)
    assert beside.run(20.0) == set()
    assert WAITS in notices(beside)
    assert beside.angle_deg == pytest.approx(stands, abs=0.01)
    if goes_on:
        beside.step(Aim(None, 60.0))
        beside.run(60.0)
        assert WAITS not in notices(beside)
        assert (beside.angle_deg[AZ], beside.angle_deg[EL]) == pytest.approx((200, 60), abs=5)


def test_an_axis_that_was_stopped_where_it_does_not_block_the_other_keeps_it_from_nothing(beside: Any) -> None:
    beside.step(Aim(80.0, 60.0))
    beside.run(2.0)
    beside.step(Stop((AZ,)))
    beside.run(30.0)
    assert beside.angle_deg[EL] == pytest.approx(60, abs=5)
    assert notices(beside) == []


def test_after_a_fault_and_resume_the_axis_stands_and_the_other_one_waits_for_it(beside: Any) -> None:
    beside.step(Aim(200.0, 10.0))
    beside.run(1.0)
    beside.instead[EL] = None
    beside.run(2.0)
    assert beside.status.elevation.fault is not None
    del beside.instead[EL]
    beside.run(2.0)
    beside.step(Release(), by=beside.CONSOLE)
    stands_deg = beside.angle_deg[EL]
    beside.run(30.0)
    assert beside.angle_deg[EL] == pytest.approx(stands_deg, abs=0.01)
    assert beside.angle_deg[AZ] < 98


@pytest.mark.parametrize(("at_deg", "target_deg"), [(50.0, 30.0), (300.0, 390.0), (430.0, 390.0), (200.0, 30.0)])
def test_of_two_turns_the_nearest_free_one_is_taken(new_desk: Any, at_deg: float, target_deg: float) -> None:
    desk = new_desk(at=(at_deg, 50.0), sectors=(CHIMNEY,))
    desk.step()
    desk.step(Aim(30.0, 50.0))
    assert desk.status.azimuth.target_deg == target_deg
