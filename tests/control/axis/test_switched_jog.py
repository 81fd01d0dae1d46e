"""The jog of a motor that is only on or off: one way, up to its limit, and never back."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.goals import JogGoal
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.switched_law import SwitchedLaw, Timing
from rotator.control.commands import Run
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Motor
from rotator.exchange.status import JOG_ENDS_DEG

MINUS, OFF, PLUS = Direction
LIMITS = Range(0.0, 450.0)
LEASE_S, NOW_S = 0.25, 20.0
MOTOR = Motor(6.0, 0.9)
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


def law(at_deg: float) -> SwitchedLaw:
    found = SwitchedLaw({PLUS: MOTOR, MINUS: MOTOR}, Timing(LEASE_S, 0.05))
    found.see(NOW_S, at_deg)
    return found


def jogged(at_deg: float, way: Direction, until_s: float | None = None) -> Run | None:
    return law(at_deg).jog(NOW_S, JogGoal(way, until_s), at_deg, LIMITS)


def inside(way: Direction, by_deg: float) -> float:
    """So far before the limit in that direction."""
    return 450.0 - by_deg if way > 0 else by_deg


@BOTH_WAYS
@pytest.mark.parametrize("before_deg", [225.0, 20.0, 3.0])
def test_it_runs_its_way_for_a_lease(way: Direction, before_deg: float) -> None:
    assert jogged(inside(way, before_deg), way) == Run(way, NOW_S + LEASE_S)


@BOTH_WAYS
def test_it_ends_with_its_time(way: Direction) -> None:
    run = jogged(200.0, way, NOW_S + 0.1)
    assert run is not None
    assert (run.direction, run.until_s) == (way, pytest.approx(NOW_S + 0.1))


@BOTH_WAYS
def test_at_its_limit_and_beyond_it_is_over(way: Direction) -> None:
    for by_deg in (JOG_ENDS_DEG, 0.0, -3.0):
        assert jogged(inside(way, by_deg), way) is None
    assert jogged(inside(way, -3.0), Direction(-way)) == Run(Direction(-way), NOW_S + LEASE_S)


@BOTH_WAYS
def test_where_its_coast_leads_to_the_limit_the_motor_rests(way: Direction) -> None:
    """At full speed and half a coast before its limit: an order to aim would turn it back."""
    at_deg = inside(way, 100.0)
    running = law(at_deg)
    running.note_relays(NOW_S, RelayState().changed(NOW_S, way))
    for step in range(1, 41):
        at_deg = inside(way, 100.0) + way * 6.0 * 0.05 * step
        running.see(NOW_S + 0.05 * step, at_deg)
    near = Range(-1000.0, at_deg + 0.6) if way > 0 else Range(at_deg - 0.6, 1000.0)
    run = running.jog(NOW_S + 2.0, JogGoal(way, None), at_deg, near)
    assert run is not None
    assert run.direction is OFF
