"""The simulated TMC5160 as its data sheet (rev. 1.17) describes it: datagrams, flags, ramps, switch, StallGuard."""

from __future__ import annotations

import pytest

from firmware_sim.chips.tmc5160 import Tmc5160
from firmware_sim.clock import SimClock
from firmware_sim.parts.stepper import SimStepper, StepperMotorSpec

CLOCK_HZ = 12e6
VMAX_1_TURN_S = round(51_200 * 2**24 / CLOCK_HZ)
AMAX_1_TURN_S2 = round(51_200 * 2**41 / CLOCK_HZ**2)


class Bench:
    """A chip that was just switched on, with a motor of 200 steps that turns 360° in one turn."""

    def __init__(self, model: str = "tmc5160", *, low_deg: float = -1e6, switch_deg: float | None = None) -> None:
        self.clock = SimClock()
        self.motor = SimStepper(StepperMotorSpec(0.0, gear=1.0, low_deg=low_deg, high_deg=1e6))
        self.chip = Tmc5160(
            self.clock,
            self.motor,
            model=model,
            switch_high=lambda: switch_deg is not None and self.motor.angle_deg <= switch_deg,
        )

    def edges(self, data: bytes) -> bytes:
        """One datagram in mode 3, edge by edge."""
        answer = 0
        self.chip.pins(cs=False, sck=True, si=False)
        for octet in data:
            for bit in range(7, -1, -1):
                si = bool(octet >> bit & 1)
                self.chip.pins(cs=False, sck=False, si=si)
                answer = answer << 1 | bool(self.chip.so)
                self.chip.pins(cs=False, sck=True, si=si)
        self.chip.pins(cs=True, sck=True, si=False)
        return answer.to_bytes(len(data), "big")

    def write(self, register: int, value: int) -> None:
        self.chip.frame([register | 0x80, *(value & 0xFFFFFFFF).to_bytes(4, "big")])

    def read(self, register: int) -> int:
        self.chip.frame([register, 0, 0, 0, 0])
        return int.from_bytes(bytes(self.chip.frame([register, 0, 0, 0, 0])[1:]), "big")

    @property
    def at_deg(self) -> float:
        self.chip.advance()
        return self.motor.angle_deg

    def run(self, *, vmax: int = VMAX_1_TURN_S, target: int | None = None) -> None:
        """Ramps of a turn a second, at a turn a second in each second, with current in the coils."""
        settings = {0x6C: 0x000100C3, 0x10: 0x00081F08, 0x26: AMAX_1_TURN_S2, 0x28: AMAX_1_TURN_S2, 0x2A: 10}
        for register, value in settings.items():
            self.write(register, value)
        if target is not None:
            self.write(0x2D, target)
        self.write(0x27, vmax)


def test_an_answer_comes_with_the_next_datagram_behind_the_status() -> None:
    bench = Bench()
    assert bench.edges(bytes([0x04, 0, 0, 0, 0]))[0] == 0b0011_1001, "reset, standstill, at its speed and target"
    assert bench.edges(bytes([0x21, 0, 0, 0, 0]))[1] == 0x30, "the version of IOIN"
    bench.edges(bytes([0xA1, 0xFF, 0xFF, 0xFF, 0xF0]))
    bench.edges(bytes([0x21, 0, 0, 0, 0]))
    assert bench.edges(bytes([0x21, 0, 0, 0, 0]))[1:] == b"\xff\xff\xff\xf0"
    assert bench.edges(bytes([0x10, 0, 0, 0])) != b"", "39 bits and fewer change nothing"
    assert bytes(bench.chip.frame([0x21, 0, 0, 0, 0]))[1:] == b"\xff\xff\xff\xf0", "whole frames are the same"


@pytest.mark.parametrize(("model", "left"), [("tmc5160", 1), ("tmc5130", 0)])
def test_the_flag_of_a_reset_is_cleared_by_a_one_or_by_reading(model: str, left: int) -> None:
    bench = Bench(model)
    assert bench.read(0x01) == 1
    assert bench.read(0x01) == left
    bench.write(0x01, 1)
    assert bench.read(0x01) == 0
    bench.chip.power(on=False)
    bench.chip.power(on=True)
    assert bench.chip.frame([0, 0, 0, 0, 0])[0] & 1


def test_a_ramp_gathers_speed_and_comes_to_rest_on_its_target() -> None:
    bench = Bench()
    bench.run(target=3 * 51_200)
    bench.clock.sleep(1.0)
    assert bench.read(0x21) == pytest.approx(25_600, abs=60), "half a turn in the first second"
    bench.clock.sleep(1.0)
    assert bench.read(0x22) == pytest.approx(VMAX_1_TURN_S, abs=1)
    bench.clock.sleep(2.2)
    assert bench.read(0x21) == 3 * 51_200
    assert bench.at_deg == pytest.approx(3 * 360.0)
    assert bench.read(0x6F) >> 31, "standstill"


def test_vmax_of_zero_brakes() -> None:
    bench = Bench()
    bench.run(target=100 * 51_200)
    bench.clock.sleep(2.0)
    bench.write(0x27, 0)
    bench.clock.sleep(0.5)
    assert bench.read(0x22) == pytest.approx(VMAX_1_TURN_S / 2, rel=0.01)
    bench.clock.sleep(0.6)
    assert bench.read(0x22) == 0
    assert bench.read(0x21) == pytest.approx(2 * 51_200, rel=0.01)


def test_stallguard_stops_at_the_stop_until_its_event_is_cleared() -> None:
    bench = Bench(low_deg=-360.0)
    bench.run(target=-5 * 51_200)
    bench.write(0x14, 0xFFFFF)
    bench.clock.sleep(0.5)
    bench.write(0x34, 1 << 10)
    bench.clock.sleep(2.0)
    assert bench.at_deg == -360.0
    assert bench.read(0x22) == 0
    assert bench.read(0x35) & 1 << 6
    bench.write(0x2D, 0)
    bench.clock.sleep(0.5)
    assert bench.read(0x22) == 0, "not before it is cleared"
    bench.write(0x34, 0)
    bench.write(0x35, 1 << 6)
    bench.clock.sleep(0.5)
    assert bench.at_deg > -360.0


def test_without_stallguard_a_motor_at_its_stop_loses_steps_by_whole_turns_of_its_field() -> None:
    bench = Bench(low_deg=-90.0)
    bench.run(target=-51_200)
    bench.clock.sleep(3.0)
    bench.write(0x2D, 0)
    bench.clock.sleep(3.0)
    lost_deg = bench.at_deg
    assert lost_deg > 200.0
    assert lost_deg / 7.2 == pytest.approx(round(lost_deg / 7.2))


def test_the_left_switch_stops_the_way_down_and_not_the_way_up() -> None:
    bench = Bench(switch_deg=-180.0)
    bench.write(0x34, 1)
    bench.run(target=-2 * 51_200)
    bench.clock.sleep(3.0)
    assert bench.at_deg == pytest.approx(-180.0, abs=4.0)
    assert bench.chip.frame([0, 0, 0, 0, 0])[0] >> 6 & 1
    bench.write(0x2D, 0)
    bench.clock.sleep(3.0)
    assert bench.at_deg == pytest.approx(0.0)


def test_at_rest_the_current_falls_and_enn_takes_it_away() -> None:
    bench = Bench()
    bench.run(target=51_200)
    bench.clock.sleep(1.0)
    assert bench.read(0x6F) >> 16 & 0x1F == 0x1F
    bench.clock.sleep(5.0)
    assert bench.read(0x6F) >> 16 & 0x1F == 8
    bench.chip.enn = True
    assert not bench.chip.feeds


def test_a_short_switches_the_driver_off_until_it_is_switched_off_and_on() -> None:
    bench = Bench()
    bench.run()
    bench.chip.shorted = True
    bench.clock.sleep(0.1)
    assert bench.read(0x6F) >> 27 & 1
    bench.chip.shorted = False
    assert not bench.chip.feeds
    bench.write(0x6C, 0)
    bench.write(0x6C, 0x000100C3)
    assert bench.chip.feeds
