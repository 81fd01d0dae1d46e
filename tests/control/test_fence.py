"""The last line before a sector: jogs, homing, uncalibrated axes, and an antenna that stands inside."""

from __future__ import annotations

from typing import Any

import hypothesis.strategies as st
import pytest
from hypothesis import given, settings

from hw.ports import Axis, Direction
from rotator.control.axis.reach import UNSEEN_LAG_S
from rotator.control.sky.mount import Range, Sector
from rotator.exchange.faults import FaultKind, Missing
from rotator.exchange.orders import Aim, Home, Jog, Stop
from tests.control.conftest import Desk
from tests.search import examples

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
    beside.run(7.0)
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


@pytest.mark.long
@given(
    lag_s=st.floats(0.02, UNSEEN_LAG_S),
    from_deg=st.floats(45.0, 97.0),
    order=st.sampled_from([Jog(AZ, PLUS), Jog(AZ, PLUS, 1.0), Jog(AZ, PLUS, 0.4), Aim(99.0, 10.0), Aim(115.0, 10.0)]),
)
@settings(max_examples=examples(160), deadline=None)
def test_no_coast_enters_it_however_short_the_file_calls_it(lag_s: float, from_deg: float, order: Any) -> None:
    """The first run, the next ones while its coast is being learnt, and those after them."""
    desk = Desk(at=(from_deg, 10.0), sectors=(CHIMNEY,))
    desk.LAG_S = lag_s  # the file says 0.17
    desk.step()
    for _ in range(4):
        desk.step(order)
        for _ in range(160):
            desk.step()
            assert desk.angle_deg[AZ] < 100.0 or desk.angle_deg[EL] > 35.0


def test_once_its_coast_was_seen_it_goes_as_near_as_that_allows(new_desk: Any) -> None:
    desk = new_desk(at=(60.0, 10.0), sectors=(CHIMNEY,))
    desk.step()
    desk.step(Jog(AZ, PLUS))
    desk.run(12.0)
    first_deg = desk.angle_deg[AZ]
    desk.step(Jog(AZ, PLUS))
    desk.run(12.0)
    assert first_deg < 93.0
    assert 94.0 < desk.angle_deg[AZ] < 98.0


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
