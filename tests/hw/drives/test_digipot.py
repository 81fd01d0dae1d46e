"""Two control boxes with digital potentiometers, in simulated time: edges on the lines, and where the antenna goes."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from contextlib import suppress

import pytest

from firmware_sim.clock import SimClock
from firmware_sim.rotors.digipot import DigipotAxisSpec, SimDigipotRotor
from hw.buses.gpio import GpioOutputs
from hw.buses.spi import SCK, SI, KernelSpi, LineSpi, SpiBus
from hw.chips.mcp41010 import Mcp41010
from hw.drives.box_supply import ENABLE
from hw.drives.control_box import BoxSpec
from hw.drives.digipot import DigipotDrive
from hw.ports import Axis, HardwareError
from hw.safety.guard import Guard
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
ENABLE_PIN = 22
CYCLE_S = 0.05
FULL_CIRCLE = ((0.0, 0.0), (360.0, 256.0))
BAND_DEG = 2.0 + 0.7 + 0.5
"""The box's dead band, half a step, and the play of the gear."""


class Bench:
    """The rotor stands at 40° and 30° when the power comes, and the drive is configured so."""

    def __init__(
        self,
        *,
        relay: bool = True,
        kernel: bool = False,
        start_deg: float = 40.0,
        box_band_deg: float = 2.0,
        range_deg: tuple[float, float] | None = None,
        enable_outcomes: Iterable[str] = (),
    ) -> None:
        self.clock = SimClock(100.0)
        self.rotor = SimDigipotRotor(
            DigipotAxisSpec(select_pin=8, start_deg=40.0, dead_band_deg=box_band_deg),
            DigipotAxisSpec(select_pin=7, start_deg=30.0),
            self.clock,
            enable_pin=ENABLE_PIN if relay else None,
        )
        bus = self.kernel() if kernel else self.lines()
        self.drive = DigipotDrive(
            (Mcp41010(bus, "azimuth"), BoxSpec(FULL_CIRCLE, start_deg, range_deg=range_deg)),
            (Mcp41010(bus, "elevation"), BoxSpec(steps=((0.0, 0.0), (90.0, 64.0)), start_deg=30.0)),
            self.clock,
            enable=FailingEnable(self.outputs({ENABLE: ENABLE_PIN}), enable_outcomes) if relay else None,
        )
        guard = Guard(self.drive, self.clock)
        self.clock.add_alarm(self.drive.due_s, guard.enforce if enable_outcomes else self.drive.enforce)

    def outputs(self, pins: dict[str, int], *, active_low: bool = False) -> GpioOutputs:
        return GpioOutputs(self.rotor.gpio, "/dev/gpiochip0", pins, consumer="rotator-digipot", active_low=active_low)

    def lines(self) -> SpiBus:
        selects = self.outputs({"azimuth": 8, "elevation": 7}, active_low=True)
        return LineSpi(selects, self.outputs({SCK: 11, SI: 10}))

    def kernel(self) -> SpiBus:
        return KernelSpi(self.rotor.spidev, 0, {"azimuth": 0, "elevation": 1})

    def follow(self, axis: Axis, angle_deg: float, seconds: float) -> None:
        for _ in range(round(seconds / CYCLE_S)):
            self.drive.aim(axis, angle_deg, 0.0, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def antenna(self, axis: Axis) -> float:
        return self.rotor.antenna()[list(Axis).index(axis)]


# --- power-on


def test_without_a_relay_the_box_turns_to_the_middle_before_any_order() -> None:
    bench = Bench(relay=False)
    bench.clock.sleep(40.0)
    assert bench.antenna(AZ) == pytest.approx(180.0, abs=BAND_DEG)


# --- motion


def test_an_angle_outside_the_calibration_is_refused_and_moves_nothing() -> None:
    bench = Bench()
    with pytest.raises(HardwareError, match=r"elevation box: 91.0° is outside its calibration table"):
        bench.drive.aim(EL, 91.0, 0.0, bench.clock() + 0.25)
    assert not bench.rotor.gpio.level(ENABLE_PIN)


def test_chips_that_forgot_their_steps_get_them_before_the_supply_comes_back() -> None:
    bench = Bench()
    bench.follow(AZ, 40.0, 1.0)
    bench.drive.release()
    bench.rotor.inject("azimuth-chip-dips")
    bench.drive.aim(EL, 30.0, 0.0, bench.clock() + 0.25)
    assert bench.rotor.azimuth.chip.step in (28, 29)


# --- what a model does not know


class FailingEnable:
    """The supply's line. Of each call, one after the other: it works, fails, or switches and fails all the same."""

    def __init__(self, lines: GpioOutputs, outcomes: Iterable[str]) -> None:
        self._lines = lines
        self._outcomes = iter(outcomes)

    def set(self, levels: dict[str, bool]) -> None:
        outcome = next(self._outcomes, "works")
        if outcome != "fails":
            self._lines.set(levels)
        if outcome != "works":
            raise HardwareError("GPIO: cannot switch enable: No such device")

    def close(self) -> None:
        self._lines.close()


@pytest.mark.long
@every_row("outcomes", list(itertools.product(("works", "fails", "switches"), repeat=3)))
def test_with_any_failure_of_the_supply_s_line_a_lease_ends_the_move_and_the_next_aim_works(
    outcomes: tuple[str, ...],
) -> None:
    bench = Bench(enable_outcomes=outcomes)
    for _ in range(len(outcomes) + 1):
        with suppress(HardwareError):
            bench.drive.aim(AZ, 90.0, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(20.0)
        assert bench.rotor.antenna()[0] < 60.0, "its lease was over long ago"
    for _ in range(400):
        bench.drive.aim(AZ, 90.0, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(CYCLE_S)
    assert bench.rotor.antenna()[0] == pytest.approx(90.0, abs=BAND_DEG)
