"""What a drive that goes to an angle by itself was tried for in vain, as the next run of the program has to know it."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource
from rotator.control.axis.stray_watch import STRAY_S
from rotator.control.sky.goal import AimGoal
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Tries
from tests.control.axis.test_positioned import Motor


@pytest.fixture
def motor() -> Motor:
    return Motor()


def tries(motor: Motor) -> Tries:
    return motor.axis.status(motor.now_s).tries


def sent(motor: Motor, seconds: float) -> None:
    motor.axis.aim(AimGoal(300.0, 4.0))
    motor.step(seconds)


def test_moves_that_end_too_soon_to_show_that_it_stands_are_tries_too(motor: Motor) -> None:
    """A stop in between acknowledges no fault, so it ends no evidence either."""
    motor.stuck = True
    for _ in range(2):
        motor.axis.aim(AimGoal(300.0, 4.0))
        motor.step(0.6)
        motor.axis.halt()
        motor.step(1.0)
        motor.axis.acknowledge(motor.now_s, by_person=False)
    motor.axis.aim(AimGoal(300.0, 4.0))
    motor.step(STRAY_S + 0.2)
    assert motor.axis.fault is not None
    assert not motor.axis.acknowledge(motor.now_s, by_person=False), "three tries: only a person may"
    assert motor.axis.acknowledge(motor.now_s, by_person=True)


def test_at_rest_and_where_it_follows_nothing_is_in_vain(motor: Motor) -> None:
    motor.step(1.0)
    assert tries(motor) == NO_TRIES
    sent(motor, 1.0)
    assert tries(motor) == NO_TRIES


def test_a_move_that_has_not_brought_it_nearer_yet_is_remembered_until_it_does(motor: Motor) -> None:
    motor.stuck = True
    sent(motor, 1.0)
    assert tries(motor) == Tries(driven=True)
    motor.axis.halt()
    motor.step(0.5)
    assert tries(motor) == Tries(driven=True)
    motor.stuck = False
    sent(motor, 1.0)
    assert tries(motor) == NO_TRIES


def test_a_fault_has_counted_the_move_that_it_ended(motor: Motor) -> None:
    motor.stuck = True
    sent(motor, STRAY_S + 0.5)
    assert motor.axis.fault is not None
    assert tries(motor) == Tries(1, FaultKind.NOT_FOLLOWING, driven=False)


@pytest.mark.parametrize("source", [AngleSource.COUNTED, AngleSource.MODELLED])
def test_where_no_sensor_measures_the_axis_nothing_shows_that_a_move_was_in_vain(source: AngleSource) -> None:
    motor = Motor(source=source)
    motor.stuck = True
    sent(motor, 1.0)
    assert not tries(motor).driven
