"""A simulated controller, as the moteus reference describes it: limits, NaN, watchdog, latches, bounds, home."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.moteus.motor import ENABLE_S, Home, Mode, MoteusSettings, SimMoteusMotor
from firmware_sim.moteus.registers import COMMAND_DEFAULTS, Register

NAMES = {
    "position": Register.COMMAND_POSITION,
    "velocity": Register.COMMAND_VELOCITY,
    "timeout": Register.COMMAND_TIMEOUT,
    "velocity_limit": Register.COMMAND_VELOCITY_LIMIT,
    "accel_limit": Register.COMMAND_ACCEL_LIMIT,
    "stop_position": Register.COMMAND_STOP_POSITION,
}


class Bench:
    def __init__(self, shaft_rev: float = 0.0, **settings: float) -> None:
        self.clock = SimClock()
        self.motor = SimMoteusMotor(self.clock, MoteusSettings(**settings), shaft_rev)  # type: ignore[arg-type]

    def go(self, **command: float) -> None:
        self.motor.advance()
        self.motor.command = COMMAND_DEFAULTS | {NAMES[name]: value for name, value in command.items()}
        self.motor.obey(Mode.POSITION)

    def stop(self) -> None:
        self.motor.advance()
        self.motor.obey(Mode.STOPPED)

    def after(self, seconds: float) -> SimMoteusMotor:
        self.clock.sleep(seconds)
        self.motor.advance()
        return self.motor


# --- motion


def test_a_step_is_a_trapezoid_within_its_limits() -> None:
    bench = Bench()
    bench.go(position=1.0, velocity_limit=0.5, accel_limit=0.25, timeout=math.nan)
    bench.after(ENABLE_S)
    speeds = [bench.after(0.01).set_point.velocity_rev_s for _ in range(500)]
    assert max(speeds) == pytest.approx(0.5, abs=0.001)
    assert max(abs(b - a) for a, b in pairwise(speeds)) < 0.25 * 0.01 * 1.1
    assert bench.motor.shaft_rev == pytest.approx(1.0, abs=1e-9)
    # 2 s to reach 0.5 rev/s over 0.5 rev, 2 s to brake over the rest
    assert next(at for at, speed in enumerate(speeds) if at > 10 and speed == 0) * 0.01 == pytest.approx(4.0, abs=0.1)


def test_a_moving_target_is_caught_and_followed_exactly() -> None:
    bench = Bench()
    bench.go(position=0.1, velocity=0.02, velocity_limit=0.1, accel_limit=0.05, timeout=math.nan)
    for second in range(10, 20):
        bench.clock.sleep_until(second)
        bench.motor.advance()
        assert bench.motor.shaft_rev == pytest.approx(0.1 + 0.02 * second, abs=1e-6)


def test_a_position_left_out_is_zero_not_stay() -> None:
    bench = Bench(shaft_rev=0.5)
    bench.go(velocity=0.0, timeout=math.nan)
    assert bench.after(1.0).shaft_rev == pytest.approx(0.0, abs=1e-6)


def test_nan_position_is_speed_alone_and_zero_speed_decelerates_and_holds() -> None:
    bench = Bench()
    bench.go(position=math.nan, velocity=0.1, accel_limit=0.1, timeout=math.nan)
    assert bench.after(3.0).set_point.velocity_rev_s == pytest.approx(0.1)
    before_rev = bench.motor.shaft_rev
    bench.go(position=math.nan, velocity=0.0, accel_limit=0.1, timeout=math.nan)
    assert bench.after(2.0).set_point.velocity_rev_s == 0
    assert bench.motor.shaft_rev - before_rev == pytest.approx(0.05, abs=1e-3)  # v²/2a


def test_stop_position_with_limits_is_a_fault() -> None:
    bench = Bench()
    bench.go(position=1.0, stop_position=0.5, accel_limit=1.0)
    assert (bench.motor.mode, bench.motor.fault_code) == (Mode.FAULT, 45)


# --- watchdog


@pytest.mark.parametrize(("timeout", "expires_s"), [(0.0, 0.1), (0.5, 0.5), (math.nan, math.inf)])
def test_the_watchdog_latches_until_a_stop(timeout: float, expires_s: float) -> None:
    bench = Bench()
    bench.go(position=math.nan, timeout=timeout)
    assert bench.after(min(expires_s, 100.0) - 0.001).mode is Mode.POSITION
    if math.isinf(expires_s):
        return
    assert bench.after(0.002).mode is Mode.TIMEOUT
    bench.go(position=1.0, timeout=math.nan)
    assert bench.after(0.1).mode is Mode.TIMEOUT
    bench.stop()
    bench.go(position=1.0, timeout=math.nan)
    assert bench.after(0.1).mode is Mode.POSITION


# --- bounds


def test_a_factory_board_faults_on_nearly_any_move() -> None:
    bench = Bench(shaft_rev=0.25, position_min_rev=-0.01, position_max_rev=0.01)
    bench.go(position=0.3)
    assert (bench.motor.mode, bench.motor.fault_code) == (Mode.FAULT, 39)
    bench.go(position=0.0)
    assert bench.motor.mode is Mode.FAULT
    bench.stop()
    assert (bench.motor.mode, bench.motor.fault_code) == (Mode.STOPPED, 0)


def test_a_target_beyond_the_bounds_is_held_back_and_said_so() -> None:
    bench = Bench(position_min_rev=-0.1, position_max_rev=0.2)
    bench.go(position=0.5, timeout=math.nan)
    assert bench.after(2.0).shaft_rev == pytest.approx(0.2)
    assert (bench.motor.mode, bench.motor.fault_code) == (Mode.POSITION, 103)
    bench.go(position=0.1, timeout=math.nan)
    assert bench.after(2.0).shaft_rev == pytest.approx(0.1)
    assert bench.motor.fault_code == 0


# --- home


def test_power_off_forgets_which_turn_of_the_rotor_it_was() -> None:
    bench = Bench(shaft_rev=0.3, rotor_turns=50)
    bench.motor.power_cycle()
    assert bench.motor.home is Home.ROTOR
    assert abs(bench.motor.position_rev) <= 0.01
    bench.motor.set_output(0.305, exactly=False)  # within half a turn of the rotor
    assert bench.motor.position_rev == pytest.approx(0.3)
    assert bench.motor.home is Home.OUTPUT


def test_a_fault_lets_go_and_latches() -> None:
    bench = Bench()
    bench.go(position=1.0, timeout=math.nan)
    bench.after(0.5)
    bench.motor.fail(33)
    at_rev = bench.motor.shaft_rev
    bench.go(position=1.0, timeout=math.nan)
    assert (bench.after(1.0).mode, bench.motor.fault_code, bench.motor.shaft_rev) == (Mode.FAULT, 33, at_rev)


def test_jammed_the_set_point_moves_and_the_shaft_does_not() -> None:
    bench = Bench()
    bench.motor.jammed = True
    bench.go(position=1.0, timeout=math.nan)
    assert (bench.after(1.0).shaft_rev, bench.motor.mode) == (0.0, Mode.POSITION)
