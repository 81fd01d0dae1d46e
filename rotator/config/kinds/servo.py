"""`rotor.type = "servo"`: two hobby servos on a PCA9685.

Knows its table [servo], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import ClassVar

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.chips import I2CChip
from rotator.config.kinds.kind import Kind, OffLine, Usual, out_of_reach, reach_deg
from rotator.config.sensors import Angle
from rotator.config.table import Gpio, I2CAddress, I2CBus, PerAxis, Point, Table


class ServoAxisTable(Table):
    channel: int = Field(0, ge=0, le=15)
    """The board's output."""
    pulses_us: list[Point] = Field(default=[(0.0, 500.0), (180.0, 2500.0)], min_length=2)
    """Points [degrees, pulse width in microseconds]; no pulse goes beyond their ends."""
    start_deg: float = Field(0.0, ge=-360, le=720)
    """The angle of the first pulse on a new box, at full speed; later that is the angle that was kept."""
    slew_dps: float = Field(60.0, gt=0, le=720)
    """The speed of the ordered angle; not above the servo's own."""


class ServoElevation(ServoAxisTable):
    channel: int = Field(1, ge=0, le=15)
    """The board's output."""


class Servo(PerAxis, Table):
    bus: I2CBus = 1
    address: I2CAddress = 0x40
    """Bus and address of the PCA9685."""
    osc_hz: float = Field(25e6, ge=20e6, le=30e6)
    """The measured frequency of its oscillator, 26 to 27 MHz on many boards."""
    enable: Gpio | None = None
    """The board's OE input, with a pull-up: no pulse before the program starts them."""
    idle_off_s: float = Field(0.0, ge=0, le=86_400)
    """After this time without a move a servo gets no pulses and is limp. 0: it always holds."""
    azimuth: ServoAxisTable = ServoAxisTable.model_construct()
    """The azimuth servo."""
    elevation: ServoElevation = ServoElevation.model_construct()
    """The elevation servo."""


@dataclass(frozen=True, slots=True)
class ServoKind(Kind):
    servo: Servo

    own = Angle(AngleSource.MODELLED, sensor="model", by="modelled")
    usual: ClassVar[Usual] = {
        "azimuth": {"max_deg": 180.0, "speed_dps": 60.0},
        "elevation": {"speed_dps": 60.0},
        "sim.azimuth": {"speed_dps": 60.0},
        "sim.elevation": {"speed_dps": 60.0},
    }
    holds = "the board goes on with its last pulses, and the servos hold"

    def chips(self) -> list[I2CChip]:
        return [I2CChip(self.servo.bus, self.servo.address, "servo.address", "PCA9685")]

    def off_lines(self) -> tuple[OffLine, ...]:
        if self.servo.enable is None:
            return ()
        # OE is active low. It stays on after the program has died, so that the servos hold the antenna.
        return (OffLine("enable", "servo.enable", self.servo.enable, off_high=True, switches=False, stops=False),)

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterable[str]:
        return out_of_reach(axes, "servo", "pulses_us", self.servo)

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        return reach_deg(self.servo.of(axis).pulses_us)

    def first_move(self, axis: Axis) -> str:
        return (
            f"With its first pulse, that of the first press, the servo runs to the angle that it had last (on a "
            f"new box {self.servo.of(axis).start_deg:g}°), as fast as it can: keep clear. When it stands, press again."
        )

    def reversal(self, axis: Axis) -> str:
        return f"swap the pulse widths in servo.{axis.value}.pulses_us"
