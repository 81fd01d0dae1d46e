"""`rotor.type = "moteus"`: two moteus controllers on CAN-FD.

Knows its table [moteus], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.kinds.kind import Kind, Usual
from rotator.config.sensors import Angle
from rotator.config.table import PerAxis, Table


class MoteusAxisTable(Table):
    id: int = Field(1, ge=1, le=126)
    """The controller's CAN id."""
    rev_per_turn: float = 1.0
    """Revolutions of the controller for 360° of the antenna; negative: the other way."""
    zero_rev: float = 0.0
    """The controller's position at 0° of the rotor's scale, in revolutions."""
    velocity_limit_dps: float = Field(30.0, gt=0, le=360)
    accel_limit_dps2: float = Field(20.0, gt=0, le=1000)
    """The limits sent with every order."""
    max_torque_nm: float | None = Field(None, gt=0)
    """The torque limit; left out, the controller's own."""
    geared: bool = True
    """The only encoder sits before a gear: after power-on the axis does not move until you confirm its angle."""

    def faults(self) -> list[str]:
        return [] if self.rev_per_turn else ["rev_per_turn must not be 0"]


class MoteusElevation(MoteusAxisTable):
    id: int = Field(2, ge=1, le=126)
    """The controller's CAN id."""


class Moteus(PerAxis, Table):
    port: str = Field("/dev/fdcanusb", min_length=1)
    """The adapter's serial port."""
    can: str | None = Field(None, min_length=1)
    """In place of `port`: a CAN-FD interface of the kernel, such as can0."""
    azimuth: MoteusAxisTable = MoteusAxisTable.model_construct()
    """The azimuth controller."""
    elevation: MoteusElevation = MoteusElevation.model_construct()
    """The elevation controller."""


@dataclass(frozen=True, slots=True)
class MoteusKind(Kind):
    moteus: Moteus

    confirmable = True
    endless = True
    own = Angle(AngleSource.MEASURED, sensor="encoder", by="told by its controller")
    usual: ClassVar[Usual] = {
        axis: {"speed_dps": 30.0} for axis in ("azimuth", "elevation", "sim.azimuth", "sim.elevation")
    }
    holds = "the controllers stop and hold by their own watchdog, half a second after the program's last word"

    def serial_port(self) -> str | None:
        return None if self.moteus.can else self.moteus.port

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterator[str]:
        if len(axes) == len(Axis) and self.moteus.azimuth.id == self.moteus.elevation.id:
            yield f"azimuth and elevation both have id {self.moteus.azimuth.id}: give one another with tview"

    def accel_dps2(self, axis: Axis) -> float | None:
        return self.moteus.of(axis).accel_limit_dps2

    def reversal(self, axis: Axis) -> str:
        return f"change the sign of moteus.{axis.value}.rev_per_turn"
