"""The speed output above its pin or chip: at its lowest whenever nobody wants more, and what it does when it fails."""

from __future__ import annotations

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.buses.pwm import SimPwm
from firmware_sim.chips.mcp4725 import Mcp4725 as SimChip
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.buses.pwm import KernelPwm
from hw.chips.mcp4725 import Mcp4725
from hw.drives.speed import REFRESH_S, SpeedOutput

SLOWEST = 0.4
STEP = 1 / 4096


class Bench:
    """An MCP4725 that makes 0.2 of its supply at the lowest speed, which is 0.4 of the full one."""

    def __init__(self, lowest: float = 0.2, full: float = 0.8) -> None:
        self.clock = SimClock()
        self.wire = SimI2CBus()
        self.chip = SimChip()
        self.wire.attach(0x60, self.chip)
        driver = Mcp4725(SmbusI2C(self.wire, "bus 1"), 0x60, lowest)
        self.speed = SpeedOutput(driver, lowest, full, SLOWEST, self.clock)

    def made(self, pace: float, for_s: float = 0.5) -> float:
        self.speed.want(pace, self.clock() + for_s)
        self.speed.write()
        return self.chip.share


@pytest.mark.parametrize(("pace", "share"), [(0.4, 0.2), (0.7, 0.5), (1.0, 0.8), (0.0, 0.2), (2.0, 0.8)])
def test_a_speed_lies_between_the_two_voltages(pace: float, share: float) -> None:
    assert Bench().made(pace) == pytest.approx(share, abs=STEP)


def test_an_input_that_turns_faster_with_less() -> None:
    bench = Bench(lowest=1.0, full=0.0)
    assert bench.chip.share == pytest.approx(1.0, abs=STEP)
    assert bench.made(1.0) == 0.0
    bench.speed.close()
    assert bench.chip.share == pytest.approx(1.0, abs=STEP)


def test_an_order_that_nobody_renews_expires() -> None:
    bench = Bench()
    bench.made(1.0, for_s=0.5)
    bench.clock.sleep(0.51)
    bench.speed.write()
    assert bench.chip.share == pytest.approx(0.2, abs=STEP)


def test_a_chip_that_dipped_has_its_voltage_again_within_a_second() -> None:
    bench = Bench()
    bench.made(1.0, for_s=5.0)
    bench.chip.power_on()
    bench.clock.sleep(REFRESH_S)
    bench.speed.write()
    assert bench.chip.share == pytest.approx(0.8, abs=STEP)


def test_a_failure_is_told_until_the_output_works_again() -> None:
    bench = Bench()
    bench.wire.gone.add(0x60)
    bench.made(1.0, for_s=5.0)
    assert "does not answer" in (bench.speed.failure or "")
    bench.wire.gone.clear()
    bench.speed.write()
    assert bench.speed.failure is None
    assert bench.chip.share == pytest.approx(0.8, abs=STEP)


def test_on_the_kernels_pwm_the_lowest_duty_outlives_the_program() -> None:
    clock, files = SimClock(), SimPwm()
    speed = SpeedOutput(KernelPwm(files, 18, 2000.0, clock.sleep), 0.1, 1.0, SLOWEST, clock)
    speed.want(1.0, clock() + 0.5)
    speed.write()
    assert files.channels[0].share == 1.0
    speed.close()
    assert files.channels[0].share == pytest.approx(0.1)


@pytest.mark.parametrize("kind", ["pwm", "mcp4725"])
def test_opened_again_it_is_lowered_from_where_a_dead_program_has_left_it(kind: str) -> None:
    """A start does that, and `rotator off`."""
    bench, files = Bench(), SimPwm()

    def opened() -> SpeedOutput:
        pwm = KernelPwm(files, 18, 2000.0, bench.clock.sleep) if kind == "pwm" else None
        driver = pwm or Mcp4725(SmbusI2C(bench.wire, "bus 1"), 0x60, 0.2)
        return SpeedOutput(driver, 0.2, 0.8, SLOWEST, bench.clock)

    def share() -> float:
        return files.channels[0].share if kind == "pwm" else bench.chip.share

    dead = opened()
    dead.want(1.0, bench.clock() + 0.5)
    dead.write()
    assert share() == pytest.approx(0.8, abs=STEP)
    opened()
    assert share() == pytest.approx(0.2, abs=STEP)
