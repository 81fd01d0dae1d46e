"""Two hobby servos on a simulated board, in simulated time: what the drive orders, and where the servos go."""

from __future__ import annotations

import threading
import time
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from firmware_sim.clock import SimClock
from firmware_sim.parts.servo import SimServoSpec
from firmware_sim.rotors.servo import ServoAxisSpec, SimServoRotor
from hw.buses.gpio import GpioOutputs
from hw.buses.i2c import SmbusI2C
from hw.chips.pca9685 import Pca9685
from hw.drives.servo import ENABLE, ServoDrive
from hw.drives.servo_axis import ServoSpec
from hw.ports import Axis, HardwareError
from tests.search import examples
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
OE_PIN = 5
PULSES_US = ((0.0, 500.0), (180.0, 2500.0))
CYCLE_S = 0.05
SETTLED_S = 180 / 40 + 0.1
"""The longest way, at the pace the drive is set to."""
TICK_DEG = 4.88 / 2000 * 180


class Bench:
    """The servos stand at 90° when the power comes, and the drive is configured to start at 60° and 10°."""

    def __init__(
        self,
        idle_off_s: float | None = None,
        *,
        on_the_wire: bool = False,
        at_deg: tuple[float, float] = (90.0, 90.0),
        wired: bool = True,
    ) -> None:
        self.clock = SimClock(100.0)
        still = SimServoSpec(jitter_deg=0.0)
        self.rotor = SimServoRotor(
            ServoAxisSpec(0, at_deg[0], still),
            ServoAxisSpec(1, at_deg[1], still),
            self.clock,
            self.clock.sleep if on_the_wire else None,
            enable_pin=OE_PIN if wired else None,
        )
        self._enable = (
            GpioOutputs(self.rotor.gpio, "/dev/gpiochip0", {ENABLE: OE_PIN}, consumer="rotator-servos", active_low=True)
            if wired
            else None
        )
        self._idle_off_s = idle_off_s
        self.drive = self._new_drive()
        self.heard: list[str] = []
        self.clock.add_alarm(self._due_s, self._guard)

    def _new_drive(self) -> ServoDrive:
        return ServoDrive(
            Pca9685(SmbusI2C(self.rotor.bus, "bus 1"), 0x40, self.clock.sleep),
            ServoSpec(0, PULSES_US, start_deg=60.0, slew_dps=40.0),
            ServoSpec(1, PULSES_US, start_deg=10.0, slew_dps=40.0),
            self.clock,
            enable=self._enable,
            idle_off_s=self._idle_off_s,
        )

    def program_ends(self) -> None:
        """Killed; and a new one begins."""
        self.drive = self._new_drive()

    def _due_s(self) -> float | None:
        return self.drive.due_s()

    def _guard(self, now_s: float) -> None:
        try:
            self.drive.enforce(now_s)
        except HardwareError as fault:
            self.heard.append(str(fault))

    def follow(self, axis: Axis, angle_deg: float, seconds: float, rate_dps: float = 0.0) -> None:
        for at in range(round(seconds / CYCLE_S)):
            self.drive.aim(axis, angle_deg + rate_dps * at * CYCLE_S, rate_dps, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def settle(self) -> None:
        self.follow(AZ, 60.0, SETTLED_S)
        self.follow(EL, 10.0, SETTLED_S)

    def antenna(self, axis: Axis) -> float:
        return self.rotor.antenna()[list(Axis).index(axis)]


# --- the first pulse


def test_no_pulse_before_the_first_aim() -> None:
    bench = Bench()
    bench.clock.sleep(10.0)
    bench.drive.hold(AZ)
    bench.drive.off()
    bench.clock.sleep(1.0)
    assert bench.rotor.board.pulse_us(0) is None
    assert bench.rotor.gpio.level(OE_PIN), "OE is high: off"
    assert bench.antenna(AZ) == 90.0
    assert not bench.drive.position_known(AZ)


def test_the_first_pulse_is_at_the_start_angle_and_waits_for_the_servo() -> None:
    bench = Bench()
    bench.follow(AZ, 120.0, 2.8)
    assert bench.antenna(AZ) == pytest.approx(60.0, abs=TICK_DEG)
    assert not bench.drive.position_known(AZ)
    bench.follow(AZ, 120.0, 3.0)
    assert bench.drive.position_known(AZ)
    assert bench.antenna(AZ) == pytest.approx(120.0, abs=TICK_DEG)
    assert bench.rotor.board.pulse_us(1) is None, "the other axis was not asked to move"


@settings(max_examples=examples(40), deadline=None)
@given(
    at_deg=st.tuples(st.floats(0, 180), st.floats(0, 180)),
    seconds=st.floats(0.05, 2.9),
    stop=st.sampled_from(["hold", "off", "expiry"]),
)
def test_a_stop_during_the_jump_stops_the_servo_at_any_angle(
    at_deg: tuple[float, float], seconds: float, stop: str
) -> None:
    bench = Bench(at_deg=at_deg)
    for _ in range(round(seconds / CYCLE_S)):
        bench.drive.aim(AZ, 120.0, 0.0, bench.clock() + 0.25)
        bench.drive.aim(EL, 60.0, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(CYCLE_S)
    match stop:
        case "hold":
            bench.drive.hold(AZ)
            bench.drive.hold(EL)
        case "off":
            bench.drive.off()
        case _:
            bench.clock.sleep(0.25)
    bench.clock.sleep(0.0)
    stood_deg = bench.rotor.antenna()
    bench.clock.sleep(5.0)
    assert bench.rotor.antenna() == pytest.approx(stood_deg, abs=1e-6)


def test_a_stop_in_the_jump_is_carried_out_although_the_guard_has_ended() -> None:
    bench = Bench()
    bench.follow(AZ, 120.0, 0.2)
    bench.drive.off()
    bench.drive.finish()
    assert bench.rotor.board.pulse_us(0) is None


# --- motion


def test_the_ordered_pulse_never_leaps() -> None:
    bench = Bench()
    bench.settle()
    widths_us = []
    for _ in range(100):
        bench.drive.aim(AZ, 180.0, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(0.02)
        widths_us.append(bench.rotor.board.pulse_us(0) or 0.0)
    assert max(abs(after - before) for before, after in pairwise(widths_us)) <= 40 * 0.04 / 180 * 2000 + 4.89
    assert bench.antenna(AZ) == pytest.approx(60 + 40 * 2.0, abs=2.0)


def test_a_stop_never_waits_for_a_bus_that_hangs() -> None:
    bench = Bench()
    bench.settle()
    bench.drive.aim(AZ, 180.0, 0.0, bench.clock() + 0.5)
    bench.rotor.inject("bus-hung")
    guard = threading.Thread(target=bench.drive.enforce, args=(bench.clock() + 0.02,), daemon=True)
    guard.start()
    deadline_s = time.monotonic() + 10.0
    while bench.drive.due_s() is not None:  # until the guard is at the bus
        assert time.monotonic() < deadline_s
    stopping = threading.Thread(target=bench.drive.off, daemon=True)
    stopping.start()
    stopping.join(timeout=5.0)
    assert not stopping.is_alive()
    bench.rotor.clear("bus-hung")
    guard.join(timeout=5.0)
    bench.clock.sleep(2.0)
    assert bench.antenna(AZ) == pytest.approx(60.0, abs=2.0)


# --- letting go


def test_release_is_limp_and_the_next_aim_is_a_first_one() -> None:
    bench = Bench()
    bench.settle()
    bench.rotor.inject("azimuth-wind-turns")
    bench.drive.release()
    bench.clock.sleep(2.0)
    assert bench.antenna(AZ) == pytest.approx(80.0, abs=TICK_DEG)
    assert (bench.rotor.board.pulse_us(0), bench.rotor.gpio.level(OE_PIN)) == (None, True)
    assert not bench.drive.position_known(AZ)
    bench.follow(AZ, 61.0, SETTLED_S)
    assert bench.drive.position_known(AZ)
    assert bench.antenna(AZ) == pytest.approx(61.0, abs=2 * TICK_DEG)


# --- the next run of the program


@every_row("wired", [True, False])
@every_row("moves_s", [1.0, 9.0])
@every_row("dipped", [False, True])
def test_a_new_program_goes_on_where_the_board_holds_the_servos(*, wired: bool, moves_s: float, dipped: bool) -> None:
    """The board's registers outlive the program: no jump to the file's start angles, 60° and 10°."""
    bench = Bench(at_deg=(60.0, 10.0), wired=wired)
    bench.settle()
    bench.follow(AZ, 150.0, moves_s)
    stood_deg = bench.rotor.shafts()
    late_deg = 40.0 * 0.02 + TICK_DEG  # how far a servo is behind its pulses
    if dipped:
        bench.rotor.faults["board-dips"].inject()
    bench.program_ends()
    bench.clock.sleep(5.0)
    assert bench.rotor.shafts() == pytest.approx(stood_deg, abs=late_deg), "no motion before an order"
    assert bench.drive.position_known(AZ) is not (wired or dipped)
    if dipped:
        assert bench.drive.angle_deg(AZ) == 60.0, "a board without supply knows nothing"
        return
    assert bench.drive.angle_deg(AZ) == pytest.approx(stood_deg[0], abs=late_deg)
    way = []
    for _ in range(100):
        bench.follow(AZ, 170.0, CYCLE_S)
        way.append(bench.antenna(AZ))
    assert min(way) >= stood_deg[0] - late_deg, "the first pulse is that angle"
    bench.follow(AZ, 170.0, SETTLED_S)
    assert bench.antenna(AZ) == pytest.approx(170.0, abs=TICK_DEG)
