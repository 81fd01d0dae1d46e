"""One moteus controller by hand: which order is due when, and what its answers mean. Moments are arguments."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from hw.moteus.axis import MoteusAxis
from hw.moteus.orders import Answer, Home, Mode, MoteusSpec, Move, Order, Query, SetOutput, Stop
from hw.ports import HardwareError

HOLD = Move(math.nan, 0.0)
STANDS = Answer(Mode.STOPPED, 0.25, 0.0, 24.0, 31.0, 0, Home.OUTPUT)
"""At 90°, without torque, and it knows its place."""


class Bench:
    """One controller that gives the answers that a test puts into `now`."""

    def __init__(self, spec: MoteusSpec | None = None, *, look_only: bool = False) -> None:
        self.axis = MoteusAxis(spec or MoteusSpec(1), look_only=look_only)
        self.now_s = 50.0
        self.now = STANDS
        self.hears()

    def hears(self) -> Order:
        """The next order that is due, answered at once."""
        self.now_s = max(self.now_s, self.axis.due_s())
        order = self.axis.order(self.now_s)
        assert order is not None
        self.axis.heard(order, self.now, self.now_s)
        return order

    def says(self, **registers: Any) -> None:
        self.now = replace(self.now, **registers)

    def aims(self, angle_deg: float = 100.0, rate_dps: float = 0.0) -> None:
        self.axis.aim(angle_deg, rate_dps, self.now_s + 0.5, self.now_s)

    def moves(self) -> None:
        """It is aimed, and has torque."""
        self.aims()
        self.hears()
        self.says(mode=Mode.POSITION)
        self.hears()

    def silent(self, seconds: float) -> None:
        """It answers nothing for so long."""
        until_s = self.now_s + seconds
        while self.axis.due_s() < until_s:
            self.now_s = max(self.now_s, self.axis.due_s())
            if self.axis.order(self.now_s) is not None:
                self.axis.missed()
        self.now_s = until_s


def same(order: Order, expected: Order) -> bool:
    """NaN is the same as NaN."""
    return repr(order) == repr(expected)


# --- how often


def test_a_controller_at_rest_is_asked_every_80_ms() -> None:
    bench = Bench()
    assert bench.axis.due_s() == pytest.approx(50.08)
    assert bench.axis.order(50.079) is None
    assert bench.axis.order(50.08) == Query()


@pytest.mark.parametrize(("speed_dps", "every_s"), [(0.009, 0.08), (0.011, 0.02), (-0.011, 0.02)])
def test_until_it_stands_a_controller_that_holds_is_spoken_to_as_often(speed_dps: float, every_s: float) -> None:
    bench = Bench()
    bench.moves()
    bench.says(velocity_rev_s=speed_dps / 360)
    bench.axis.hold()
    assert same(bench.hears(), HOLD)
    assert same(bench.hears(), HOLD)
    assert bench.axis.due_s() - bench.now_s == pytest.approx(every_s)


# --- torque


def test_the_bus_may_be_closed_when_a_hold_was_answered_and_it_stands() -> None:
    bench = Bench()
    bench.moves()
    bench.says(velocity_rev_s=0.01)
    bench.axis.hold()
    assert not bench.axis.at_rest
    bench.hears()
    assert not bench.axis.at_rest, "it turns"
    bench.says(velocity_rev_s=0.0)
    bench.hears()
    assert bench.axis.at_rest
    bench.aims()
    assert bench.axis.at_rest, "until the aim is sent"
    bench.hears()
    assert not bench.axis.at_rest


def test_what_an_earlier_run_left_timed_out_is_stopped_before_it_moves() -> None:
    bench = Bench()
    bench.says(mode=Mode.TIMEOUT)
    assert bench.hears() == Query()
    assert bench.axis.fault is None
    bench.aims()
    assert bench.hears() == Stop()
    bench.says(mode=Mode.STOPPED)
    assert bench.hears() == Stop()
    assert isinstance(bench.hears(), Move)


# --- silence


def test_after_a_silence_it_is_asked_before_it_moves_on() -> None:
    bench = Bench()
    bench.moves()
    bench.silent(0.1)
    assert bench.axis.hearing.misses == pytest.approx(5, abs=1)
    assert bench.hears() == Query()
    assert bench.axis.hearing.came_back
    assert bench.axis.hearing.gap_s == pytest.approx(0.12, abs=0.03)
    assert isinstance(bench.hears(), Move)
    assert not bench.axis.hearing.came_back


def test_a_controller_that_answers_for_the_first_time_has_not_come_back() -> None:
    axis = MoteusAxis(MoteusSpec(1))
    assert axis.order(50.0) == Query()
    axis.missed()
    assert axis.order(50.08) == Query()
    axis.heard(Query(), STANDS, 50.08)
    assert not axis.hearing.came_back


# --- a person's word


@pytest.mark.parametrize("speed_dps", [0.49, -0.49, 0.51, -0.51])
def test_an_axis_that_turns_by_half_a_degree_a_second_cannot_be_read_by_eye(speed_dps: float) -> None:
    bench = Bench()
    bench.says(velocity_rev_s=speed_dps / 360)
    bench.hears()
    if abs(speed_dps) > 0.5:
        with pytest.raises(HardwareError, match="it turns; look where it points when it stands"):
            bench.axis.confirm(80.0, True, bench.now_s)
    else:
        bench.axis.confirm(80.0, True, bench.now_s)


def test_an_axis_that_is_only_looked_at_gets_no_order_and_no_position() -> None:
    direct = MoteusSpec(1, geared=False, min_deg=90.0, max_deg=400.0)
    rotor = replace(STANDS, home=Home.ROTOR, position_rev=0.1)
    for look_only, second in ((False, SetOutput(direct.revolutions(396.0), exactly=False)), (True, Query())):
        bench = Bench.__new__(Bench)
        bench.axis, bench.now_s, bench.now = MoteusAxis(direct, look_only=look_only), 50.0, rotor
        assert [bench.hears(), bench.hears()] == [Query(), second]
        assert bench.axis.angle_deg(bench.now_s) == pytest.approx(396.0)
