"""The simulated front panel by itself: what the operator does there, on its pins, inputs and needles."""

from __future__ import annotations

import pytest

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.clock import SimClock
from firmware_sim.panel import PanelSpec, SimPanel

MSB, LSB, CALIBRATE, STOP = 4, 5, 6, 7  # pulled up from boot on
SPEC = PanelSpec(
    mode_msb=MSB, mode_lsb=LSB, calibrate=CALIBRATE, stop=STOP, azimuth_knob=0, elevation_knob=1, jog=2,
    lamps={"auto": 3}, meters={"azimuth": 0}, meter_full_share=0.5,
)  # fmt: skip
ADC, BOARD = 0x49, 0x41


class Bench:
    def __init__(self, spec: PanelSpec = SPEC) -> None:
        self.clock = SimClock(100.0)
        self.gpio = SimGpio(self.clock)
        self.bus = SimI2CBus()
        self.panel = SimPanel(spec, self.gpio, lambda _number: self.bus, self.clock)

    def bits(self) -> tuple[bool, bool]:
        """Closed contacts of the mode switch."""
        return not self.gpio.level(MSB), not self.gpio.level(LSB)

    def volts(self, channel: int) -> float:
        return self.panel.adc.inputs[channel]()

    def output(self, channel: int, share: float) -> None:
        """As a driver does it: awake, auto-increment, OFF after this share of 4096 ticks."""
        self.bus.write_byte_data(BOARD, 0x00, 0x20)
        off = round(share * 4096)
        block = [0, 0x10, 0, 0] if off >= 4096 else [0, 0, off & 0xFF, off >> 8]
        self.bus.write_i2c_block_data(BOARD, 0x06 + 4 * channel, block)


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_the_stop_button_is_normally_closed(bench: Bench) -> None:
    assert not bench.gpio.level(STOP)
    bench.panel.press_stop()
    assert bench.gpio.level(STOP)
    bench.panel.pull_stop()
    assert not bench.gpio.level(STOP)
    bench.panel.inject("stop-wire-broken")
    assert bench.gpio.level(STOP)
    bench.panel.clear("stop-wire-broken")
    assert not bench.gpio.level(STOP)


@pytest.mark.parametrize(
    ("azimuth", "elevation", "volts"),
    [(0, 0, 1.65), (1, 0, 2.349), (-1, 0, 0.951), (0, 1, 2.136), (0, -1, 1.164), (1, 1, 2.533), (-1, 1, 1.406)],
)
def test_the_jog_switches_by_a_pocket_calculator(bench: Bench, azimuth: int, elevation: int, volts: float) -> None:
    """3.3 V × (1/10 [+ 1/6.8] [+ 1/12]) / (2/10 + 1/6.8 + 1/12) and so on, in kΩ."""
    bench.panel.throw("azimuth", azimuth)
    bench.panel.throw("elevation", elevation)
    assert bench.volts(2) == pytest.approx(volts, abs=0.001)


def test_a_supply_that_sags_takes_all_of_it_along(bench: Bench) -> None:
    bench.panel.turn_knob("azimuth", 1.0)
    bench.panel.inject("supply-sags")
    assert (bench.volts(0), bench.volts(2)) == pytest.approx((2.79, 1.485), abs=0.001)
    bench.panel.clear("supply-sags")
    assert bench.volts(0) == pytest.approx(3.1, abs=0.001)


def test_a_broken_wire_of_a_knob_takes_its_input_to_a_rail() -> None:
    bench = Bench(PanelSpec(azimuth_knob=0, elevation_knob=1))
    for turned in (0.0, 0.5, 1.0):
        bench.panel.turn_knob("azimuth", turned)
        assert 0.05 < bench.volts(0) / 3.3 < 0.95
        for wire, volts in (("wire", 0.0), ("supply", 0.0), ("ground", 3.3)):
            bench.panel.inject(f"azimuth-knob-{wire}-broken")
            assert bench.volts(0) == pytest.approx(volts, abs=0.04)
            bench.panel.clear(f"azimuth-knob-{wire}-broken")


def test_a_bouncing_mode_switch_is_in_two_positions_by_turns(bench: Bench) -> None:
    bench.panel.turn_mode(2)
    bench.panel.inject("mode-switch-bouncing")
    seen = set()
    for _ in range(20):
        bench.clock.sleep(0.05)
        seen.add(bench.bits())
    assert seen == {(True, False), (True, True)}
    bench.panel.clear("mode-switch-bouncing")
    assert bench.bits() == (True, False)


def test_a_broken_wire_of_the_mode_switch_makes_auto_manual(bench: Bench) -> None:
    bench.panel.turn_mode(2)
    bench.panel.inject("mode-wire-broken")
    assert bench.bits() == (False, False)
