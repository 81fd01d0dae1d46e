"""The questions that the program asks of a kind of rotor, with the answers of a kind without such parts.

Knows the questions. Knows no kind: each has a file of its own beside this one. A kind is made from its own tables of
the configuration, and knows no other table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from hw.ports import Axis
from rotator.config.angle import Angle
from rotator.config.axes import AxisTable
from rotator.config.i2c import I2CChip
from rotator.config.spi import SpiUse

Usual = Mapping[str, Mapping[str, Any]]
"""Defaults by table (`azimuth`, `sim.azimuth`) and key."""


@dataclass(frozen=True, slots=True)
class OffLine:
    """An output that must be at its off level while the program does not drive it."""

    name: str
    """What the program calls the line."""
    key: str
    """The key of the file that names its GPIO."""
    pin: int
    off_high: bool = False
    """Off is the high level."""
    switches: bool = True
    """On, it closes a contact by itself. A heartbeat does not, and an OE input has a resistor of its own."""
    stops: bool = True
    """Off, it stops the motors: the sentinel and `rotator off` switch it. A servo board's OE would drop the antenna."""


@dataclass(frozen=True, slots=True)
class EndStop:
    """What homing has to know of an axis that counts: the cam, and where its low end stop is."""

    spacing_deg: float
    coast_s: float
    home_deg: float


class Kind:
    """A kind of rotor with its tables. The answers here are those of a kind without such a part."""

    switched: ClassVar[bool] = False
    """Its motors are only on or off, by relays."""
    confirmable: ClassVar[bool] = False
    """After power-on its drive has to hear from a person where the antenna points."""
    own: ClassVar[Angle]
    """How an angle is known where the file names no other sensor."""
    usual: ClassVar[Usual] = {}
    """What it has in place of a relay rotor's defaults, where the file does not say. On real hardware the limits are
    not taken from here: a person has to give them."""
    holds: ClassVar[str] = ""
    """What its motors do when the program has ended, where no line stops them."""

    def pins(self) -> list[tuple[int, str]]:
        """Every GPIO that it uses but those of SPI, with the key that names it."""
        return []

    def chips(self) -> list[I2CChip]:
        """The I2C chips of its drive."""
        return []

    def spi_uses(self) -> list[SpiUse]:
        """The SPI chips of its drive."""
        return []

    def serial_port(self) -> str | None:
        """The serial port over which its motors are reached."""
        return None

    def off_lines(self) -> tuple[OffLine, ...]:
        """The outputs that have to be off while the Pi starts and when the program dies."""
        return ()

    def faults(self, axes: Mapping[Axis, AxisTable]) -> list[str]:
        """What in its tables does not go with the axes, in sentences for a person."""
        return []

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        """The lowest and the highest angle of its own table, on the rotor's scale; None: its table sets no end."""
        return None, None

    def slack_deg(self, axis: Axis) -> float:
        """How far from the ordered angle the motor may come to rest by its nature."""
        return 0.0

    def accel_dps2(self, axis: Axis) -> float | None:
        """The acceleration that the drive keeps to; None: the drive takes none."""
        return None

    def end_stop(self, axis: Axis) -> EndStop | None:
        """For an axis that counts: how to find its end stop."""
        return None

    def first_move(self, axis: Axis) -> str:
        """A warning before the first move of a calibration; empty: it needs none."""
        return ""

    def reversal(self, axis: Axis) -> str:
        """What to change where the antenna turns the wrong way; empty: the two relays."""
        return ""
