"""A stream that waits at the horizon is followed on the turn that its pass needs, and as it is in all else."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.flight_order import TakeTurn
from rotator.exchange.orders import Aim, Jog, Nudge, Order, Park, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
LOW_S = 200.0


def stream(desk: Any, seconds: int, azimuth_deg: float, rate_dps: float = 0.0, elevation_deg: float = 0.0) -> None:
    """Whole degrees, once a second."""
    for second in range(seconds):
        desk.step(Aim(float(round(azimuth_deg + rate_dps * second) % 360), elevation_deg))
        desk.run(0.95)


def turn(desk: Any, azimuth_deg: float, *, flipped: bool = False, lasts_s: float = LOW_S) -> TakeTurn:
    return TakeTurn(azimuth_deg, flipped, desk.now_s + lasts_s)


@pytest.fixture
def waits(desk: Any) -> Any:
    """Its stream waits at 20° and the antenna is there, on the lower of two turns."""
    stream(desk, 20, 20.0)
    assert desk.angle_deg[AZ] == pytest.approx(20.0, abs=4.5)
    return desk


@pytest.mark.long
def test_the_antenna_goes_to_the_other_turn_and_follows_the_stream_there(waits: Any) -> None:
    waits.step(turn(waits, 380.0))
    stream(waits, 70, 20.0)
    assert waits.angle_deg[AZ] == pytest.approx(380.0, abs=4.5)
    stream(waits, 80, 20.0, -0.5)
    assert waits.angle_deg[AZ] == pytest.approx(340.0, abs=4.5)
    assert waits.status.wanted_azimuth_deg == 340.0
    assert waits.status.recognised == ""


def test_on_its_way_each_new_degree_leaves_it_on_that_turn(waits: Any) -> None:
    """Also while the antenna is nearer to the first turn, and the stream too slow to be a path."""
    waits.step(turn(waits, 380.0))
    for azimuth_deg in (20.0, 21.0, 20.0, 21.0):
        waits.step(Aim(azimuth_deg, 0.0))
        waits.run(6.0)
    waits.run(40.0)
    assert waits.angle_deg[AZ] == pytest.approx(381.0, abs=4.5)


def test_before_a_rise_just_beyond_the_end_it_waits_at_the_end(desk: Any) -> None:
    stream(desk, 20, 20.0)
    desk.step(Aim(350.0, 0.0))
    desk.step(turn(desk, 0.0))
    stream(desk, 40, 350.0, 0.1)
    assert desk.angle_deg[AZ] == pytest.approx(0.0, abs=4.5)


def test_over_the_top_where_the_pass_needs_it(desk: Any) -> None:
    stream(desk, 20, 20.0)
    desk.step(turn(desk, 200.0, flipped=True))
    stream(desk, 80, 20.0)
    assert desk.angle_deg[AZ] == pytest.approx(200.0, abs=4.5)
    assert desk.angle_deg[EL] == pytest.approx(180.0, abs=4.5)


@pytest.mark.long
@pytest.mark.parametrize("order", [Stop(), Park(), Jog(AZ, Direction.PLUS, 1.0), Nudge(AZ, 5.0), Aim(20.0, 30.0)])
def test_it_is_ignored_where_another_order_has_come_meanwhile(waits: Any, order: Order) -> None:
    waits.step(order)
    waits.step(turn(waits, 380.0))
    waits.run(30.0)
    assert waits.angle_deg[AZ] < 40.0


@pytest.mark.parametrize("by", ["OTHER", "CONSOLE"])
def test_it_is_ignored_from_another_sender(waits: Any, by: str) -> None:
    waits.step(turn(waits, 380.0), by=getattr(waits, by))
    waits.run(30.0)
    assert waits.angle_deg[AZ] < 40.0


def test_it_is_ignored_where_the_stream_is_elsewhere_or_has_ended(waits: Any) -> None:
    waits.step(turn(waits, 180.0))
    waits.run(30.0)
    waits.step(turn(waits, 380.0))
    waits.run(30.0)
    assert waits.angle_deg[AZ] < 40.0


@pytest.mark.long
def test_an_order_for_another_target_goes_the_near_way(waits: Any) -> None:
    waits.step(turn(waits, 380.0, lasts_s=1000.0))
    stream(waits, 70, 20.0)
    waits.step(Aim(80.0, 0.0))
    waits.run(20.0)
    assert waits.angle_deg[AZ] == pytest.approx(440.0, abs=4.5)
    waits.step(Aim(180.0, 0.0))
    waits.run(60.0)
    waits.step(Aim(60.0, 0.0))
    waits.run(40.0)
    assert waits.angle_deg[AZ] == pytest.approx(60.0, abs=4.5)


def test_after_its_time_a_target_beyond_the_end_is_reached_on_the_other_turn(desk: Any) -> None:
    stream(desk, 20, 20.0)
    desk.step(Aim(350.0, 0.0))
    desk.step(turn(desk, 0.0, lasts_s=20.0))
    stream(desk, 15, 350.0)
    assert desk.angle_deg[AZ] == pytest.approx(0.0, abs=4.5)
    stream(desk, 90, 350.0)
    assert desk.angle_deg[AZ] == pytest.approx(350.0, abs=4.5)
