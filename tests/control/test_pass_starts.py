"""How often the motors are started in a pass: from the first order after a pause to the next pause."""

from __future__ import annotations

import pytest

from hw.ports import Axis, Direction
from rotator.control.cycles import PASS_PAUSE_S, PassStarts

OFF, CW, CCW = Direction.OFF, Direction.PLUS, Direction.MINUS


@pytest.fixture
def starts() -> PassStarts:
    return PassStarts()


def run(starts: PassStarts, from_s: float, *azimuth: Direction) -> None:
    """One direction of the azimuth's relays for each second."""
    for second, direction in enumerate(azimuth):
        starts.note_driven(from_s + second, {Axis.AZIMUTH: direction, Axis.ELEVATION: OFF})


def test_a_start_is_a_relay_that_closes_and_a_reversal_is_one_too(starts: PassStarts) -> None:
    starts.ordered(0.0)
    run(starts, 0.0, CW, CW, OFF, CW, CCW, OFF)
    assert starts.of(Axis.AZIMUTH) == 3
    assert starts.of(Axis.ELEVATION) == 0


def test_the_count_stays_readable_until_the_next_pass(starts: PassStarts) -> None:
    starts.ordered(0.0)
    run(starts, 0.0, CW, OFF)
    run(starts, 5000.0, OFF)
    assert starts.of(Axis.AZIMUTH) == 1
    starts.ordered(5001.0)
    assert starts.of(Axis.AZIMUTH) == 0


def test_orders_that_keep_coming_are_one_pass_also_of_a_slow_target(starts: PassStarts) -> None:
    for at_s in range(0, 3600, int(PASS_PAUSE_S) - 1):
        starts.ordered(float(at_s))
        run(starts, float(at_s), CW, OFF)
    assert starts.of(Axis.AZIMUTH) == 31


def test_a_long_way_to_a_target_is_no_pause(starts: PassStarts) -> None:
    starts.ordered(0.0)
    run(starts, 0.0, *[CW] * 200, OFF)
    starts.ordered(202.0)
    assert starts.of(Axis.AZIMUTH) == 1


def test_a_motor_that_runs_after_a_pause_begins_a_pass(starts: PassStarts) -> None:
    starts.ordered(0.0)
    run(starts, 0.0, CW, OFF)
    run(starts, 500.0, CW, OFF)
    assert starts.of(Axis.AZIMUTH) == 1
