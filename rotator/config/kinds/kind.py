"""The base class of the kinds of rotor: what the program asks of a kind, with the answer of a kind without such a part.

Knows no kind: each has a file beside this one. A kind holds its own tables of the configuration, and no other.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from hw.ports import Axis
from rotator.config.axes import AxisTable
from rotator.config.chips import I2CChip, SpiUse
from rotator.config.sensors import Angle
from rotator.config.table import PerAxis, Point

Usual = Mapping[str, Mapping[str, Any]]
"""Defaults by table (`azimuth`, `sim.azimuth`) and key."""


@dataclass(frozen=True, slots=True)
class OffLine:
    """An output line that must be off while no program drives it."""

    name: str
    """The program's name of the line."""
    key: str
    """The key of the file that names its GPIO."""
    pin: int
    off_high: bool = False
    """Off is the high level."""
    switches: bool = True
    """The line's on level closes a contact directly. A heartbeat does not, and an OE input has its own resistor."""
    stops: bool = True
    """The off level stops the motors, and the sentinel and `rotator off` set it. A servo board's OE would drop the
    antenna."""


@dataclass(frozen=True, slots=True)
class EndStop:
    """What homing needs of an axis that counts: its cam, if it has one, and the angle at which homing ends."""

    spacing_deg: float
    coast_s: float
    """The time after which it stands, and the last change of its contact has come through the debounce."""
    home_deg: float
    mostly_closed: bool
    """The contact is closed for more of the spacing than it is open."""
    rest_deg: tuple[float, float]
    """Between these angles the axis is brought to rest: an edge of its contact lies between it and either stop."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of rotor. Its fields are its tables, with the names that `Config` has for them. Subclasses override the
    answers for parts that they have."""

    switched: ClassVar[bool] = False
    """Relays switch the motors on and off."""
    confirmable: ClassVar[bool] = False
    """After power-on the drive may need the operator to confirm the antenna's angle."""
    own: ClassVar[Angle]
    """How the angle is known, unless the file names another sensor."""
    usual: ClassVar[Usual] = {}
    """Defaults that differ from those of a relay rotor with pots. On real hardware the limits are not taken from here:
    the operator must give them."""
    holds: ClassVar[str] = ""
    """What the motors do after the end of the program, for a kind without a line that stops them."""

    endless: ClassVar[bool] = False
    """Its own drive and sensor can turn on and on, turn after turn."""
    own_motor: ClassVar[bool] = False
    """While an axis is to hold, neither wind nor a hand can turn it: only its own motor, which the box does not see."""

    @property
    def switches_supply(self) -> bool:
        """An output of the drive itself switches the motors' supply."""
        return False

    def pins(self) -> list[tuple[int, str]]:
        """Every GPIO in use except those of SPI, with its key in the file."""
        return [(line.pin, line.key) for line in self.off_lines()]

    def chips(self) -> list[I2CChip]:
        """The I2C chips of the drive."""
        return []

    def spi_uses(self) -> list[SpiUse]:
        """The SPI chips of the drive."""
        return []

    def serial_port(self) -> str | None:
        """The serial port of the motor controllers; None: there is none."""
        return None

    def off_lines(self) -> tuple[OffLine, ...]:
        """The outputs that must be off while the Pi starts and after the program has died."""
        return ()

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterable[str]:
        """Contradictions between its tables and the axes, one sentence each, for the user."""
        return []

    def cams(self, axes: Iterable[Axis]) -> dict[Axis, dict[str, object]]:
        """What a kept count of each of these axes depends on; only of a kind that counts."""
        return {axis: {} for axis in axes}

    def reach_deg(self, axis: Axis) -> tuple[float | None, float | None]:
        """The lowest and the highest angle of its table, on the rotor's own scale; None: the table sets no end."""
        return None, None

    def slack_deg(self, axis: Axis) -> float:
        """How far from the ordered angle a healthy drive may come to rest."""
        return 0.0

    def accel_dps2(self, axis: Axis) -> float | None:
        """The acceleration limit sent to the drive; None: the drive has no such limit."""
        return None

    def reversal_rest_s(self, axis: Axis) -> float:
        """How long the drive lets a motor rest that is to turn the other way."""
        return 0.0

    def end_stop(self, axis: Axis, max_deg: float) -> EndStop | None:
        """The end stop for homing; None: the axis does not count pulses. `max_deg`: the upper end of its range."""
        return None

    def speeds_dps(self, axis: Axis, table: AxisTable) -> tuple[float, float] | None:
        """The full speed clockwise or up, and that of the other way, where the angle is reckoned by them; None: it is
        not. `table`: the axis's own."""
        return None

    def homes(self, axis: Axis) -> bool:
        """Whether the drive finds its end stop by itself."""
        return False

    def first_move(self, axis: Axis) -> str:
        """A warning before the first move of a calibration; empty: no warning."""
        return ""

    def reversal(self, axis: Axis) -> str:
        """The repair for an antenna that turns the wrong way; empty: exchange the two relays."""
        return ""


def reach_deg(points: list[Point]) -> tuple[float, float]:
    """The lowest and the highest angle of the points [degrees, value] of a drive without feedback."""
    angles_deg = [angle_deg for angle_deg, _ in points]
    return min(angles_deg), max(angles_deg)


def out_of_reach(axes: Mapping[Axis, AxisTable], drive: str, name: str, table: PerAxis) -> Iterator[str]:
    """An axis with limits beyond its points `drive.AXIS.name`, or with a start angle outside its limits."""
    for axis, limits in axes.items():
        own: Any = getattr(table, axis.value)
        if not limits.min_deg <= own.start_deg <= limits.max_deg:
            yield (
                f"{drive}.{axis.value}.start_deg = {own.start_deg:g} is outside {axis.value}'s range, "
                f"{limits.min_deg:g} to {limits.max_deg:g}"
            )
        low_deg, high_deg = reach_deg(getattr(own, name))
        if not low_deg <= limits.min_deg < limits.max_deg <= high_deg:
            yield (
                f"{axis.value}: min_deg {limits.min_deg:g} to max_deg {limits.max_deg:g} goes beyond "
                f"{drive}.{axis.value}.{name}, which reaches from {low_deg:g} to {high_deg:g}"
            )
