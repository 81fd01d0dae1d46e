"""`rotor.type = "digipot"`: control boxes that follow a knob, with an MCP41010 in place of each knob.

Knows its table [digipot], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.chips import SpiUse
from rotator.config.kinds.kind import Kind, OffLine, Usual, out_of_reach, reach_deg
from rotator.config.sensors import Angle
from rotator.config.table import Gpio, PerAxis, Point, Table


class DigipotAxisTable(Table):
    select: Gpio = 8
    """The chip's CS, as in [adc]."""
    steps: list[Point] = Field(default=[(0.0, 0.0), (360.0, 256.0)], min_length=2)
    """Points [degrees, the chip's step there, 0 to 256]."""
    start_deg: float = Field(0.0, ge=-360, le=720)
    """The assumed angle on a new box, if no pot measures it; later it is the angle that was kept."""
    dead_band_deg: float = Field(2.0, ge=0, le=20)
    """The error at which the control box turns its motor."""


class DigipotElevation(DigipotAxisTable):
    select: Gpio = 7
    """The chip's CS, as in [adc]."""
    steps: list[Point] = Field(default=[(0.0, 0.0), (90.0, 64.0)], min_length=2)
    """Points [degrees, the chip's step there, 0 to 256]."""


class Digipot(PerAxis, Table):
    spi: Literal["lines", "kernel"] = "lines"
    """As in [adc]."""
    sck: Gpio = 11
    si: Gpio = 10
    """Clock and data."""
    enable: Gpio | None = None
    """The relay of the control boxes' supply. Without it they turn to mid-range at power-on."""
    azimuth: DigipotAxisTable = DigipotAxisTable.model_construct()
    """The azimuth box."""
    elevation: DigipotElevation = DigipotElevation.model_construct()
    """The elevation box."""


@dataclass(frozen=True, slots=True)
class DigipotKind(Kind):
    digipot: Digipot

    own = Angle(AngleSource.MODELLED, sensor="model", by="modelled")
    usual: ClassVar[Usual] = {
        "azimuth": {"max_deg": 360.0},
        "elevation": {"max_deg": 90.0, "speed_dps": 6.0},
        "sim.elevation": {"speed_dps": 6.0},
    }
    holds = "the control boxes go on to where their chips point; a relay in their supply would end that"

    own_motor: ClassVar[bool] = True

    @property
    def switches_supply(self) -> bool:
        return self.digipot.enable is not None

    def spi_uses(self) -> list[SpiUse]:
        table = self.digipot
        selects = {f"{axis.value}.select": table.of(axis).select for axis in Axis}
        wires = {"sck": table.sck, "si": table.si}
        return [SpiUse("digipot", "digital pots", selects, wires, kernel=table.spi == "kernel")]

    def off_lines(self) -> tuple[OffLine, ...]:
        enable = self.digipot.enable
        return () if enable is None else (OffLine("box_enable", "digipot.enable", enable),)

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterable[str]:
        return out_of_reach(axes, "digipot", "steps", self.digipot)

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        return reach_deg(self.digipot.of(axis).steps)

    def slack_deg(self, axis: Axis) -> float:
        """The control box's dead band plus one step of the chip."""
        table = self.digipot.of(axis)
        (low_deg, low_step), (high_deg, high_step) = min(table.steps), max(table.steps)
        return table.dead_band_deg + abs((high_deg - low_deg) / (high_step - low_step))

    def first_move(self, axis: Axis) -> str:
        start_deg = self.digipot.of(axis).start_deg
        return (
            f"The box assumes that it stands where it was last (on a new box at {start_deg:g}°). If it does not, its "
            "first move goes there."
        )

    def reversal(self, axis: Axis) -> str:
        return f"exchange PA0 and PB0 of the {axis.value}'s chip, or let digipot.{axis.value}.steps fall"
