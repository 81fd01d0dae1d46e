"""What the box knows of itself at one moment: immutable, made by the controller, read by everybody.

Knows only values. Views, protocols and the page read it and never ask the hardware.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import Axis, Direction
from rotator.orders import Mode


@dataclass(frozen=True, slots=True)
class Fault:
    """Something that stopped an axis: what was measured against which limit, and the page that explains it."""

    name: str
    axis: Axis | None
    measured: str
    limit: str = ""
    """What it went beyond; empty: it is not that kind of fault."""
    page: str = "docs/troubleshooting.md"
    cut: bool = False
    """Opening the relay does not stop it: the motors' supply has to go."""
    act_now: str = ""
    """What a person must do this moment, in a few loud words; empty: nothing."""
    passing: bool = False
    """It goes with its cause, without being acknowledged."""

    def __str__(self) -> str:
        where = f"{self.axis.value}: " if self.axis else ""
        loud = f"{self.act_now} " if self.act_now else ""
        limit = f", limit {self.limit}" if self.limit else ""
        return f"{loud}{where}{self.name}: {self.measured}{limit} (see {self.page}#{self.anchor})"

    @property
    def anchor(self) -> str:
        return self.name.replace(" ", "-")


@dataclass(frozen=True, slots=True)
class LearntMotor:
    """One direction of a motor, as the box has found it."""

    speed_dps: float
    coast_deg: float
    """How far it goes on when switched off at full speed."""


@dataclass(frozen=True, slots=True)
class AxisStatus:
    min_deg: float
    max_deg: float
    angle_deg: float | None = None
    """Where the axis is on its own scale; the last good value while the sensor is out; None before the first."""
    raw: float | None = None
    """The sensor's own reading, for calibration."""
    source: str = "measured"
    target_deg: float | None = None
    """The axis angle aimed at; None: at rest, nothing to do."""
    drive: Direction = Direction.OFF
    moving: bool = False
    """Driven, or still coasting."""
    uncalibrated: str = ""
    """Why this axis obeys only jog: what is missing. Empty: fully commissioned."""
    calibration: tuple[tuple[float, float], ...] | None = None
    """The table in force, (raw, degrees), for whoever keeps it."""
    fault: Fault | None = None
    homing: bool = False
    """It looks for its end stop."""
    notices: tuple[str, ...] = ()
    """What a person should know of this axis though it stops nothing."""
    learnt: tuple[LearntMotor, LearntMotor] | None = None
    """Its motor, clockwise or up and back, for whoever keeps it; None: it has none to learn."""


@dataclass(frozen=True, slots=True)
class Status:
    at_s: float
    azimuth: AxisStatus
    elevation: AxisStatus
    wanted_azimuth_deg: float | None = None
    """The direction last ordered, as ordered: what the display calls SAT."""
    wanted_elevation_deg: float | None = None
    latched: str = ""
    """Who pressed a stop that only a person releases; empty: nobody."""
    controlled_by: str = ""
    timed_point: int = 0
    timed_points: int = 0
    simulated: bool = False
    speed_level: int = 4
    mode: Mode = Mode.AUTO
    """What a front panel's switch says; without one, AUTO."""
    cycle_late_s: float = 0.0
    """How late the last control cycle was."""

    def axis(self, axis: Axis) -> AxisStatus:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    @property
    def moving(self) -> bool:
        return self.azimuth.moving or self.elevation.moving

    @property
    def cut(self) -> bool:
        """Whether the motors' supply is to be switched off."""
        return any(fault.cut for fault in self.faults)

    @property
    def faults(self) -> tuple[Fault, ...]:
        return tuple(a.fault for a in (self.azimuth, self.elevation) if a.fault)
