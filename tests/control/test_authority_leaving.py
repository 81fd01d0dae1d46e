"""What ends when a connection ends: its jog and its stream. What has an end of its own goes on."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Leave, LoadTimed, Order, Park, Stop
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
LINK, OTHER = Source("rotctld", 1), Source("gs232b", 1)
RESTING = {AZ: OFF, EL: OFF}


def test_a_jog_ends_with_its_connection(desk: Any) -> None:
    desk.step(Jog(AZ, PLUS), Jog(EL, PLUS), by=LINK)
    desk.run(1.0)
    assert desk.driven == {AZ: PLUS, EL: PLUS}
    assert desk.step(Leave(), by=LINK) == RESTING
    assert desk.run(30.0) == set()


def test_a_jog_for_a_time_ends_at_its_time(desk: Any) -> None:
    """`rotator tell jog cw 3` has left before the motor turns."""
    desk.step(Jog(AZ, PLUS, 3.0), by=LINK)
    desk.step(Leave(), by=LINK)
    assert desk.run(2.5) == {(AZ, PLUS)}
    desk.run(1.0)
    assert desk.at_rest()


def test_the_end_of_another_connection_ends_nothing_of_this_one(desk: Any) -> None:
    desk.step(Jog(AZ, PLUS), by=LINK)
    assert desk.step(Leave(), by=OTHER)[AZ] is PLUS
    assert desk.step(Leave(), by=Source("rotctld", 2))[AZ] is PLUS


def test_a_jog_that_another_has_taken_over_goes_on(desk: Any) -> None:
    desk.step(Jog(AZ, PLUS), by=LINK)
    desk.run(0.5)
    desk.step(Jog(AZ, PLUS), by=OTHER)
    assert desk.step(Leave(), by=LINK)[AZ] is PLUS
    assert desk.step(Leave(), by=OTHER)[AZ] is OFF


@pytest.mark.parametrize("order", [Aim(300.0, 60.0), Park(), LoadTimed(5.0, ((300.0, 60.0), (310.0, 60.0)))],
                         ids=lambda order: type(order).__name__)  # fmt: skip
def test_what_came_after_the_jog_goes_on(desk: Any, order: Order) -> None:
    desk.step(Jog(AZ, PLUS), by=LINK)
    desk.run(0.5)
    desk.step(order, by=LINK)
    wanted = desk.status.azimuth.target_deg
    desk.step(Leave(), by=LINK)
    assert desk.status.azimuth.target_deg == wanted is not None
    assert desk.run(1.0)


def test_a_timed_list_runs_on_as_in_a_gs232(desk: Any) -> None:
    """The unit itself keeps the list; the computer may be switched off meanwhile."""
    points = tuple((110.0 + 10.0 * count, 20.0) for count in range(4))
    desk.step(LoadTimed(4.0, points), by=LINK)
    desk.step(Leave(), by=LINK)
    assert desk.status.timed_points == 4


def test_a_stream_ends_with_its_connection(desk: Any) -> None:
    """Without it the box would follow for three seconds more."""
    for count in range(30):
        desk.step(Aim(100.0 + 0.5 * count, 40.0 + 0.5 * count), by=LINK, seconds=0.05)
        desk.run(0.95)
    desk.run(0.5)
    before = desk.status.azimuth.target_deg
    assert before > 114.5, "it follows the path beyond the last order"
    desk.step(Leave(), by=LINK)
    assert desk.status.azimuth.target_deg == 114.5
    desk.run(2.0)
    assert desk.status.azimuth.target_deg == 114.5


def test_a_script_that_connects_for_each_order_is_followed_as_ever(desk: Any) -> None:
    for count in range(30):
        script = Source("rotctld", count)
        desk.step(Aim(100.0 + 0.5 * count, 40.0 + 0.5 * count), by=script, seconds=0.05)
        desk.step(Leave(), by=script)
        desk.run(0.9)
    desk.run(0.5)
    assert desk.status.azimuth.target_deg > 114.5


orders = st.sampled_from([Aim(30.0, 30.0), Aim(330.0, 30.0), Jog(AZ, PLUS), Jog(EL, MINUS), Jog(AZ, MINUS, 2.0),
                          Park(), Stop(), Stop((AZ,)), Leave()])  # fmt: skip


@given(st.lists(st.tuples(st.sampled_from([LINK, OTHER]), orders, st.floats(0.0, 2.0)), max_size=20))
def test_nothing_turns_without_end_when_all_have_left(new_desk: Any, script: list[tuple[Source, Order, float]]) -> None:
    desk = new_desk()
    for source, order, seconds in script:
        desk.step(order, by=source)
        desk.run(seconds)
    desk.step(Leave(), by=LINK)
    desk.step(Leave(), by=OTHER)
    for _ in range(math.ceil(450.0 / 6.0 / 5.0) + 4):
        if not desk.run(5.0):
            break
        for axis in Axis:
            if desk.driven[axis]:
                assert desk.status.axis(axis).target_deg is not None or any(
                    isinstance(order, Jog) and order.seconds for _, order, _ in script
                ), "it turns towards a target, or for a time"
    assert desk.at_rest()
