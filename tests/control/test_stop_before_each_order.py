"""A logger sends `S` before each `P`: the stop stops at once, and the stream goes on as though it had not come."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import S_BEFORE_P_S, Aim, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
RESTING = {AZ: Direction.OFF, EL: Direction.OFF}


def target(second: float) -> Aim:
    return Aim(110.0 + 0.5 * second, 20.0 + 0.2 * second)


def flown(desk: Any, gap_s: float | None) -> tuple[int, float]:
    """The starts, and the mean error of azimuth, over two minutes. `gap_s`: from `S` to `P`; None: without `S`."""
    starts, errors_deg = 0, []
    for second in range(120):
        if gap_s == 0.0:
            desk.step(Stop(), target(second))
        else:
            if gap_s is not None:
                assert desk.step(Stop()) == RESTING, "at once"
                assert desk.run(gap_s - 0.05) == set(), "and nothing moves before the order"
            desk.step(target(second))
        for _ in range(19 if not gap_s else 20 - 1 - round(gap_s / 0.05)):
            before = dict(desk.driven)
            desk.step()
            starts += sum(way is not Direction.OFF and before[axis] is not way for axis, way in desk.driven.items())
        errors_deg.append(abs(desk.angle_deg[AZ] - (target(second + 1.0).azimuth_deg or 0.0)))
    return starts, sum(errors_deg[30:]) / 90


@pytest.mark.long
def test_in_one_read_they_are_one_order(new_desk: Any) -> None:
    plain_desk, desk = new_desk(), new_desk()
    for each in (plain_desk, desk):
        each.step()
    assert flown(desk, 0.0) == flown(plain_desk, None)


def test_a_stop_some_milliseconds_before_each_order_leaves_the_antenna_on_its_target(new_desk: Any) -> None:
    desk = new_desk()
    desk.step()
    _, off_deg = flown(desk, 0.05)
    assert off_deg < 2.0
    assert desk.status.controlled_by == str(desk.LINK)


@pytest.mark.parametrize("pause_s", [S_BEFORE_P_S + 0.1, 30.0])
def test_without_a_prompt_order_the_stop_has_ended_the_stream(desk: Any, pause_s: float) -> None:
    for second in range(20):
        desk.step(target(second))
        desk.run(0.95)
    assert desk.step(Stop()) == RESTING
    assert desk.run(pause_s) == set()
    assert (desk.status.wanted_azimuth_deg, desk.status.azimuth.target_deg) == (None, None)
    desk.step(Aim(130.0, 30.0))
    desk.run(30.0)
    assert desk.angle_deg[AZ] == pytest.approx(130.0, abs=4.5), "one order, for a place"


def test_the_stop_of_another_connection_ends_it_for_good(desk: Any) -> None:
    for second in range(20):
        desk.step(target(second))
        desk.run(0.95)
    desk.step(Stop(), by=desk.OTHER)
    assert desk.step(target(20)) == RESTING
    assert desk.run(5.0) == set()
