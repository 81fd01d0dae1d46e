"""The last line before a sector: jogs, homing, uncalibrated axes, and an antenna that stands inside."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.axis.motion import Motor
from rotator.control.axis.reach import bounds
from rotator.control.sky.mount import Range, Sector
from rotator.exchange.faults import FaultKind, Missing
from rotator.exchange.orders import Aim, Home, Jog, Park, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PLUS, MINUS = Direction.PLUS, Direction.MINUS
CHIMNEY = Sector("the chimney", Range(100, 130), Range(0, 35), 2.0)


def notices(desk: Any) -> list[str]:
    return [notice.text for axis in Axis for notice in desk.status.axis(axis).notices]


@pytest.fixture
def beside(new_desk: Any) -> Any:
    """South of the chimney, below its top."""
    desk = new_desk(at=(60.0, 10.0), sectors=(CHIMNEY,))
    desk.step()
    return desk


def test_a_jog_ends_before_it_with_room_for_the_coast(beside: Any) -> None:
    beside.step(Jog(AZ, PLUS))
    beside.run(30.0)
    assert 90 < beside.angle_deg[AZ] < 98
    assert beside.at_rest()
    assert not beside.status.azimuth.fault


def test_a_jog_that_was_held_back_does_not_go_on_by_itself(beside: Any) -> None:
    beside.step(Jog(AZ, PLUS))
    beside.run(9.0)
    assert notices(beside) == ["stopped before the chimney"]
    beside.run(4.0)
    assert notices(beside) == []
    beside.step(Jog(EL, PLUS))
    assert (AZ, PLUS) not in beside.run(20.0)


def test_two_jogs_at_once_do_not_cut_its_corner(new_desk: Any) -> None:
    desk = new_desk(at=(80.0, 60.0), sectors=(CHIMNEY,))
    desk.step()
    desk.step(Jog(AZ, PLUS), Jog(EL, MINUS))
    for _ in range(800):
        desk.step()
        assert not (desk.angle_deg[AZ] > 100 and desk.angle_deg[EL] < 35)
    assert desk.angle_deg[AZ] < 100 or desk.angle_deg[EL] > 35, "one of the two has ended"


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


@pytest.mark.parametrize("described", [0.2, 0.3, 0.4, 0.6, 0.8, 1.0, 1.5, 2.5])
def test_however_wrong_the_speed_in_the_file_is_it_waits_where_the_fence_lets_it_start_again(
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
    return max(bounds(written, Motor(motor.speed_dps, motor.coast_deg)).stopping_room_deg for motor in learnt)


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
    assert 112 < desk.angle_deg[AZ] < 120
    assert any("behind the tower" in text for text in notices(desk))


def test_park_goes_round_too(beside: Any) -> None:
    beside.step(Aim(200.0, 10.0))
    beside.run(60.0)
    beside.step(Park())
    for _ in range(1600):
        beside.step()
        assert not (100 < beside.angle_deg[AZ] < 130 and beside.angle_deg[EL] < 35)
    assert beside.angle_deg[AZ] == pytest.approx(0, abs=4)


def inside(desk: Any) -> Any:
    desk.place(AZ, 106.0)
    desk.step(Stop())
    desk.run(5.0)
    desk.step(Stop())
    return desk


def test_an_antenna_inside_only_leaves_by_the_nearest_edge(beside: Any) -> None:
    desk = inside(beside)
    desk.step(Jog(AZ, PLUS))
    assert desk.run(5.0) == set()
    desk.step(Jog(EL, PLUS))
    assert desk.run(5.0) == set()
    desk.step(Jog(AZ, MINUS, 2.0))
    assert desk.run(5.0) == {(AZ, MINUS)}


def test_an_order_first_leads_it_out_and_says_so(beside: Any) -> None:
    desk = inside(beside)
    desk.step(Aim(300.0, 10.0))
    assert any("in the chimney" in text for text in notices(desk))
    while desk.angle_deg[AZ] > 99.0:
        assert desk.run(0.05) <= {(AZ, MINUS)}
    desk.run(90.0)
    assert desk.angle_deg[AZ] == pytest.approx(300, abs=4)


def test_with_the_azimuth_not_calibrated_it_waits_until_elevation_is_above(new_desk: Any) -> None:
    desk = new_desk(at=(60.0, 10.0), sectors=(CHIMNEY,), missing={AZ: (Missing.CALIBRATION,)})
    desk.step()
    desk.step(Jog(AZ, PLUS, 1.0))
    assert desk.run(2.0) == set()
    assert any("the angle of azimuth is not known" in text for text in notices(desk))
    desk.step(Aim(None, 45.0))
    desk.run(20.0)
    desk.step(Jog(AZ, PLUS, 1.0))
    assert desk.run(2.0) == {(AZ, PLUS)}
    desk.step(Jog(EL, MINUS))
    desk.run(20.0)
    assert desk.angle_deg[EL] > 35, "the azimuth may be at the chimney"


def test_an_axis_with_a_dead_sensor_may_be_anywhere(beside: Any) -> None:
    beside.step(Aim(60.0, 60.0))
    beside.run(30.0)
    beside.instead[AZ] = None
    beside.run(1.0)
    beside.step(Jog(EL, MINUS))
    beside.run(30.0)
    assert 35 < beside.angle_deg[EL] < 45


def test_homing_that_would_pass_it_is_refused_as_a_fault(new_desk: Any) -> None:
    desk = new_desk(at=(200.0, 20.0), sectors=(CHIMNEY,), counted=True)
    desk.step()
    desk.step(Home(AZ), by=desk.CONSOLE)
    desk.run(30.0)
    assert desk.angle_deg[AZ] > 130
    assert desk.status.azimuth.fault.kind is FaultKind.NOT_HOMED
    assert "the chimney" in desk.status.azimuth.fault.measured


def test_without_sectors_nothing_is_asked_of_an_axis(desk: Any) -> None:
    desk.step(Aim(200.0, 45.0))
    assert desk.run(1.0) == {(AZ, PLUS), (EL, PLUS)}
    assert notices(desk) == []
