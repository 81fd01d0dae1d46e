"""The ADS1115 as its datasheet (TI SBAS444) describes it, section by section.

Talks to the chip in bytes, as the bus would; time is a number in a list.
"""

from __future__ import annotations

import random

import pytest

from firmware_sim.chips.ads1115 import Ads1115
from tests.tables import every_row

WAKE_UP_S = 25e-6
SINGLE_A0_128 = 0xC583  # OS, AIN0 to GND, +-2.048 V, single-shot, 128 SPS, comparator off
NOMINAL_128_S = 1 / 128 + WAKE_UP_S


class Bench:
    """A chip on a bench supply, and the clock on the wall."""

    def __init__(self, *volts: float, oscillator_error: float = 0.0, noise_v_rms: float = 0.0) -> None:
        self.now_s = 0.0
        self.volts = list(volts) + [0.0] * (4 - len(volts))
        self.chip = Ads1115(
            lambda: self.now_s, oscillator_error=oscillator_error, noise_v_rms=noise_v_rms, noise=random.Random(1)
        )
        self.chip.inputs = [lambda pin=pin: self.volts[pin] for pin in range(4)]  # type: ignore[misc]

    def register(self, pointer: int) -> int:
        self.chip.write(bytes([pointer]))
        return int.from_bytes(self.chip.read(2), "big")

    def configure(self, config: int) -> None:
        self.chip.write(bytes([0x01, config >> 8, config & 0xFF]))

    def convert(self, config: int) -> int:
        self.configure(config)
        self.now_s += 0.2  # longer than any
        return self.signed()

    def signed(self) -> int:
        self.chip.write(b"\x00")
        return int.from_bytes(self.chip.read(2), "big", signed=True)

    @property
    def busy(self) -> bool:
        return not self.register(1) & 0x8000


# --- 9.6.3 Config Register: MUX

INPUT_V = (1.0, 0.75, 0.5, 0.25)


@every_row(
    ("mux", "volts"),
    [(0, 0.25), (1, 0.75), (2, 0.5), (3, 0.25), (4, 1.0), (5, 0.75), (6, 0.5), (7, 0.25)],
)
def test_multiplexer(mux: int, volts: float) -> None:
    assert Bench(*INPUT_V).convert(0x8583 | mux << 12) == volts / 2.048 * 32768


# --- 9.6.3 Config Register: PGA; 9.3.3 table "Full-Scale Range and Corresponding LSB Size"


@every_row(
    ("pga", "lsb_uv"),
    [(0, 187.5), (1, 125.0), (2, 62.5), (3, 31.25), (4, 15.625), (5, 7.8125), (6, 7.8125), (7, 7.8125)],
)
def test_gain(pga: int, lsb_uv: float) -> None:
    counts = Bench(0.2).convert(0xC183 | pga << 9)
    assert counts == pytest.approx(0.2 / (lsb_uv * 1e-6), abs=0.51)


@every_row(
    ("volts", "counts"), [(2.048, 0x7FFF), (3.3, 0x7FFF), (0.0625e-3, 1), (0.0, 0), (-0.0625e-3, -1), (-0.2, -3200)]
)
def test_output_code_of_a_single_ended_input(volts: float, counts: int) -> None:
    # 9.5.4 Data Format: two's complement; noise around 0 V goes below it
    assert Bench(volts).convert(SINGLE_A0_128) == counts


# --- 9.4.2.1 Single-Shot Mode


@every_row(("code", "rate_sps"), list(enumerate((8, 16, 32, 64, 128, 250, 475, 860))))
def test_a_conversion_takes_its_data_rate_and_the_wake_up(code: int, rate_sps: int) -> None:
    bench = Bench(1.024)
    bench.configure(0xC503 | code << 5)
    bench.now_s = 1 / rate_sps + WAKE_UP_S - 1e-6
    assert bench.busy
    bench.now_s += 2e-6
    assert not bench.busy
    assert bench.signed() == 0x4000


def test_reading_too_early_gives_the_previous_result() -> None:
    bench = Bench(1.024)
    bench.convert(SINGLE_A0_128)
    bench.volts[0] = 0.512
    bench.configure(SINGLE_A0_128)
    assert (bench.signed(), bench.chip.early_reads) == (0x4000, 1)
    bench.now_s += NOMINAL_128_S
    assert (bench.signed(), bench.chip.early_reads) == (0x2000, 1)


def test_the_input_is_sampled_when_the_conversion_ends() -> None:
    bench = Bench(1.0)
    bench.configure(SINGLE_A0_128)
    bench.now_s, bench.volts[0] = bench.chip.due_s() or 0.0, 1.024
    bench.chip.settle()
    bench.now_s, bench.volts[0] = 1.0, 0.0
    assert bench.signed() == 0x4000


# --- noise and faults


def test_a_frozen_chip_keeps_converting_to_the_same_value() -> None:
    bench = Bench(1.024)
    bench.convert(SINGLE_A0_128)
    bench.chip.frozen, bench.volts[0] = True, 0.512
    assert bench.convert(SINGLE_A0_128) == 0x4000
    assert not bench.busy
    bench.chip.frozen = False
    assert bench.convert(SINGLE_A0_128) == 0x2000
