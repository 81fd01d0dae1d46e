"""`rotor.type = "stepper"`: two steppers, each on a TMC5160 or TMC5130 that makes its ramps.

Knows its table [stepper], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.chips import KERNEL_WIRES, SpiUse
from rotator.config.kinds.kind import Kind, OffLine, Usual
from rotator.config.sensors import Angle
from rotator.config.table import Gpio, PerAxis, Table

MODE, SPEED_HZ = 3, 1_000_000
LEAST_HOLDING = 10.0
"""A gear of fewer turns is no worm gear that holds."""


class StepperAxisTable(Table):
    select: Gpio = 8
    """The chip's CSN: GPIO 8 or 7, the selects of the Pi's own SPI."""
    gear: float = 54.0
    """Turns of the motor for one turn of the antenna; negative: the other way."""
    steps_per_turn: int = Field(200, ge=20, le=1000)
    """Full steps for a turn of the motor: 200 for 1.8°, 400 for 0.9°."""
    accel_dps2: float = Field(6.0, gt=0, le=1000)
    """How fast the antenna gathers speed, and brakes. The speed is the axis's `speed_dps`."""
    run_a: float = Field(1.0, gt=0, le=20)
    """The current of a coil while the motor turns, in amperes rms: not above the motor's own."""
    rest_share: float = Field(0.4, ge=0, le=1)
    """The share of that current at rest."""
    sense_ohm: float = Field(0.075, gt=0, le=1)
    """The sense resistors of the chip's board."""
    home: Literal["none", "switch", "stall"] = "none"
    """What stops the motor at its lower end when it is homed: a switch at the chip's input REFL, open at the end; or
    StallGuard at a bare stop. Without either you say where it points: `rotator confirm`."""
    home_deg: float = Field(0.0, ge=-360, le=720)
    """The angle at that end."""
    home_dps: float = Field(4.0, gt=0, le=360)
    """The speed on the way there. StallGuard feels nothing of a slow motor."""
    stall: int = Field(0, ge=-64, le=63)
    """How hard the stop must be for StallGuard (SGT): lower stops sooner, higher later."""
    encoder: int = Field(0, ge=-1_000_000, le=1_000_000)
    """Counts of an encoder at the chip for a turn of the motor, four for each line; negative: it counts the other way;
    0: none is fitted."""

    def faults(self) -> Iterator[str]:
        if not self.gear:
            yield "gear must not be 0"


class StepperElevation(StepperAxisTable):
    select: Gpio = 7
    """The chip's CSN: GPIO 8 or 7, the selects of the Pi's own SPI."""


class Stepper(PerAxis, Table):
    chip: Literal["tmc5160", "tmc5130"] = "tmc5160"
    """The chip of both axes."""
    clock_hz: float = Field(12e6, ge=4e6, le=20e6)
    """Its clock: about 12 MHz inside a TMC5160, 13 MHz inside a TMC5130. Speeds depend on it, angles do not."""
    enable: Gpio | None = None
    """The line DRV_ENN of both chips, with a pull-up to their 3.3 V; left out, it is wired to ground."""
    self_locking: bool = True
    """Without current the gears hold the antenna, as worm gears do: its place is known again after a power cut, and the
    motors lose their current when the program dies. false: they keep it."""
    azimuth: StepperAxisTable = StepperAxisTable.model_construct()
    """The azimuth motor and its chip."""
    elevation: StepperElevation = StepperElevation.model_construct()
    """The elevation motor and its chip."""

    def faults(self) -> Iterator[str]:
        if self.azimuth.select == self.elevation.select:
            yield f"azimuth and elevation both have select {self.azimuth.select}: wire one chip to 8, the other to 7"
        for axis in Axis:
            if self.of(axis).select not in (7, 8):
                yield f"{axis.value}.select = {self.of(axis).select} is no select of the Pi's own SPI: take 8 or 7"
            if self.self_locking and abs(self.of(axis).gear) < LEAST_HOLDING:
                yield (
                    f"{axis.value}.gear = {self.of(axis).gear:g} does not hold the antenna without current: "
                    "write self_locking = false"
                )


@dataclass(frozen=True, slots=True)
class StepperKind(Kind):
    stepper: Stepper

    confirmable = True
    own = Angle(AngleSource.COUNTED, sensor="step counter", by="counted in steps")
    usual: ClassVar[Usual] = {
        "azimuth": {"max_deg": 360.0, "speed_dps": 10.0, "tolerance_deg": 0.5},
        "elevation": {"speed_dps": 10.0, "tolerance_deg": 0.5},
        "sim.azimuth": {"speed_dps": 10.0},
        "sim.elevation": {"speed_dps": 10.0},
    }
    holds = "the chips stop their motors within a second, and the motors hold"

    def spi_uses(self) -> list[SpiUse]:
        selects = {f"{axis.value}.select": self.stepper.of(axis).select for axis in Axis}
        return [SpiUse("stepper", "stepper chips", selects, KERNEL_WIRES, kernel=True, mode=MODE, speed_hz=SPEED_HZ)]

    def off_lines(self) -> tuple[OffLine, ...]:
        if self.stepper.enable is None:
            return ()
        # Without a gear that holds, the antenna would fall when the motors lose their current.
        stops = self.stepper.self_locking
        return (OffLine("enable", "stepper.enable", self.stepper.enable, off_high=True, stops=stops),)

    def cams(self, axes: Iterable[Axis]) -> dict[Axis, dict[str, object]]:
        keys = {"gear", "steps_per_turn", "home", "home_deg", "encoder"}
        return {axis: self.stepper.of(axis).model_dump(mode="json", include=keys) for axis in axes}

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterator[str]:
        for axis, limits in axes.items():
            table = self.stepper.of(axis)
            if limits.sensor.kind != "own":
                yield f"{axis.value}.sensor: a stepper's angle is counted by its chip: leave the table out"
            if table.home != "none" and table.home_deg > limits.min_deg:
                yield (
                    f"stepper.{axis.value}.home_deg = {table.home_deg:g} is above {axis.value}.min_deg = "
                    f"{limits.min_deg:g}: the end stop is below the range"
                )

    def accel_dps2(self, axis: Axis) -> float | None:
        return self.stepper.of(axis).accel_dps2

    def homes(self, axis: Axis) -> bool:
        return self.stepper.of(axis).home != "none"

    def reversal(self, axis: Axis) -> str:
        return f"change the sign of stepper.{axis.value}.gear"
