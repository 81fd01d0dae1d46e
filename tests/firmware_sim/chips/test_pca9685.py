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


@pytest.mark.parametrize(
    ("pointer", "value"),
    [(0x00, 0x11), (0x01, 0x04), (0x05, 0xE0), (0x06, 0x00), (0x09, 0x10), (0x45, 0x10), (0xFA, 0x00), (0xFE, 0x1E)],
    ids=["MODE1", "MODE2", "ALLCALLADR", "LED0_ON_L", "LED0_OFF_H", "LED15_OFF_H", "ALL_LED reads zero", "PRE_SCALE"],
)
def test_reset_values(pointer: int, value: int) -> None:
    assert Bench().register(pointer) == value


def test_at_reset_every_output_is_off() -> None:
    chip = Bench().awake()
    assert [chip.high_share(output) for output in range(16)] == [0.0] * 16


def test_the_prescaler_can_be_written_in_sleep_only() -> None:
    bench = Bench()
    bench.awake().write(b"\xfe\x03")
    assert bench.register(0xFE) == SERVO_50_HZ


@pytest.mark.parametrize(("prescale", "frequency_hz"), [(0x1E, 196.9), (0x79, 50.03), (3, 1525.9), (0, 1525.9)])
def test_the_frequency(prescale: int, frequency_hz: float) -> None:  # 7.3.5; the hardware takes 3 for less
    bench = Bench()
    bench.chip.write(bytes([0xFE, prescale]))
    assert 1 / bench.chip.period_s() == pytest.approx(frequency_hz, abs=0.1)


def test_without_auto_increment_all_bytes_go_to_one_register() -> None:
    bench = Bench()
    bench.chip.write(b"\x06\x01\x02\x03")
    assert (bench.register(0x06), bench.register(0x07)) == (0x03, 0x00)


def test_auto_increment_goes_from_the_last_output_to_the_first_register() -> None:
    chip = Bench().awake()
    chip.write(b"\x45")
    assert chip.read(3) == b"\x10\x20\x04"


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


def test_all_led_writes_every_output() -> None:
    chip = Bench().awake()
    chip.write(b"\xfa\x00\x00\x00\x08")
    assert {chip.high_share(output) for output in range(16)} == {0.5}


def test_a_slow_oscillator_makes_long_pulses() -> None:
    chip = Bench(osc_hz=24e6).awake()
    chip.write(b"\x06\x00\x00\x33\x01")
    assert chip.pulse_us(0) == pytest.approx(307 * 122 / 24.0)


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


def test_outputs_written_before_the_oscillator_is_stable_are_counted() -> None:
    bench = Bench()
    bench.awake()
    bench.now_s -= 100e-6
    bench.chip.write(b"\x06\x00")
    assert bench.chip.early_writes == 1


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


def test_jitter_is_what_was_asked_for() -> None:
    servo = SimServo(SimServoSpec(jitter_deg=0.5), 90.0, lambda: 0.0, lambda: 1500.0)
    angles_deg = [servo.angle_deg() - 90.0 for _ in range(500)]
    assert (sum(error**2 for error in angles_deg) / 500) ** 0.5 == pytest.approx(0.5, rel=0.15)
