"""The PCA9685 as its datasheet (NXP, rev. 4) describes it, and the servo behind it.

Talks to the chip in bytes, as the bus would; time is a number.
"""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import Nack
from firmware_sim.chips.pca9685 import Pca9685
from firmware_sim.parts.servo import SimServo, SimServoSpec

SERVO_50_HZ = 0x79


class Bench:
    def __init__(self, osc_hz: float = 25e6) -> None:
        self.now_s = 0.0
        self.chip = Pca9685(lambda: self.now_s, osc_hz=osc_hz)

    def register(self, pointer: int) -> int:
        self.chip.write(bytes([pointer]))
        return self.chip.read(1)[0]

    def awake(self) -> Pca9685:
        """50 Hz, auto-increment, 500 µs after sleep."""
        for sent in (b"\x00\x30", bytes([0xFE, SERVO_50_HZ]), b"\x00\x20"):
            self.chip.write(sent)
        self.now_s += 500e-6
        return self.chip


# --- 7.3 Register definitions


def test_at_reset_every_output_is_off() -> None:
    chip = Bench().awake()
    assert [chip.high_share(output) for output in range(16)] == [0.0] * 16


# --- 7.3.3 LED output and PWM control


@pytest.mark.parametrize(
    ("four", "share"),
    [
        ("00 00 33 01", 307 / 4096),
        ("00 08 00 04", 0.75),  # over the end of the period
        ("00 10 00 00", 1.0),  # full on
        ("00 10 00 10", 0.0),  # full off wins
    ],
)
def test_the_pulse_is_from_on_to_off(four: str, share: float) -> None:
    chip = Bench().awake()
    chip.write(b"\x0a" + bytes.fromhex(four))
    assert chip.high_share(1) == share


# --- 7.3.1.1 Restart mode


def test_what_ran_before_sleep_waits_for_restart() -> None:
    bench = Bench()
    chip = bench.awake()
    chip.write(b"\x06\x00\x00\x33\x01")
    chip.write(b"\x00\x30")
    assert (chip.pulse_us(0), bench.register(0x00)) == (None, 0xB0)
    chip.write(b"\x00\x20")
    assert chip.pulse_us(0) is None
    bench.now_s += 500e-6
    chip.write(b"\x00\xa0")
    assert (chip.pulse_us(0) is not None, bench.register(0x00)) == (True, 0x20)


def test_without_vcc_it_does_not_answer_and_comes_back_reset() -> None:
    chip = Bench().awake()
    chip.write(b"\x06\x00\x00\x33\x01")
    chip.supply = False
    with pytest.raises(Nack):
        chip.write(b"\x00")
    chip.supply = True
    assert (chip.register(0x00), chip.pulse_us(0)) == (0x11, None)


# --- the servo: 60°/s, 500 to 2500 µs for 180°


class Wire:
    def __init__(self, start_deg: float) -> None:
        self.now_s = 0.0
        self.us: float | None = None
        self.servo = SimServo(SimServoSpec(jitter_deg=0.0), start_deg, lambda: self.now_s, lambda: self.us)

    def after(self, seconds: float, us: float | None) -> float:
        self.servo.advance()
        self.us = us
        self.now_s += seconds
        return self.servo.angle_deg()


def test_a_servo_turns_to_its_pulse_at_its_own_speed() -> None:
    wire = Wire(0.0)
    assert wire.after(1.0, None) == 0.0
    assert wire.after(1.0, 1500.0) == pytest.approx(60.0)
    assert wire.after(1.0, 1500.0) == pytest.approx(90.0)
    assert wire.after(1.0, None) == pytest.approx(90.0)


def test_a_servo_presses_against_the_stops_in_its_case() -> None:
    wire = Wire(180.0)
    assert wire.after(5.0, 2700.0) == 184.0
    assert wire.servo.strained_s == pytest.approx(5.0 - 4.0 / 60)
