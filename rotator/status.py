"""The state of the box at one moment: immutable, made by the controller, read by views, protocols and links.

Knows only values. Its readers never ask the hardware.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from hw.ports import AngleSource, Axis, Direction
from rotator.faults import Fault, FaultKind, Missing, Notice
from rotator.orders import Mode


@dataclass(frozen=True, slots=True)
class LearntMotor:
    """One direction of a motor, as the box has found it."""

    speed_dps: float
    coast_deg: float
    """How far it goes on when switched off at full speed."""


class Trust(Enum):
    """What is known of a motor relay that was switched off. Each but OPEN keeps the opposite relay open."""

    OPEN = "open"
    """The axis has been seen to stop when this relay opened, and the relay has not been closed since."""
    UNSEEN = "not seen yet"
    """It has been closed, or may have been. A window of readings will tell."""
    DOUBTED = "doubted"
    """The window is over and has shown nothing: the axis stands where a motor with current might stand as well."""
    WELDED = "found closed"
    """The axis ran on after this relay was switched off, or turned by itself."""


Trusts = tuple[Trust, Trust]
"""Of the relays clockwise or up, and of the other way."""
ALL_OPEN: Trusts = (Trust.OPEN, Trust.OPEN)

Places = tuple[float | None, float | None]
"""Angles met clockwise or up, and the other way; None: none was."""


@dataclass(frozen=True, slots=True)
class Tries:
    """What one motor was tried for in vain: the next run of the program goes on from there."""

    faults: int = 0
    """How often a fault has stopped it lately."""
    kind: FaultKind | None = None
    """The latest of those faults."""
    stood_deg: Places = (None, None)
    """Where the driven axis stood still last."""
    stops_deg: Places = (None, None)
    """The stops that it has met: only a person lets it go there again."""
    pressed: bool = False
    """It has no calibration, and presses did not move it."""
    driven: bool = False
    """Its latest run has not been seen to move it."""


NO_TRIES = Tries()

AT_END_NOISES, AT_END_MOST_DEG = 5.0, 1.0
"""A reading beyond an end of the range by up to so many times the noise, and by so much at most, is that end. Five
times: one reading in three million is further off."""

JOG_ENDS_DEG = 0.5
"""Nearer than this to the end of its range no jog turns an axis towards that end."""


@dataclass(frozen=True, slots=True)
class AxisStatus:
    min_deg: float
    max_deg: float
    angle_deg: float | None = None
    """Where the axis is on its own scale; the last good value while the sensor is out; None before the first."""
    seen: bool = True
    """The latest reading is a good one. False: the sensor is out, and `angle_deg` is where the axis was last seen."""
    raw: float | None = None
    """The sensor's own reading, for calibration."""
    source: AngleSource = AngleSource.MEASURED
    target_deg: float | None = None
    """The axis angle aimed at; None: at rest, nothing to do."""
    tolerance_deg: float | None = None
    """So near to the target counts as there; None: no target."""
    drive: Direction = Direction.OFF
    moving: bool = False
    """Driven, or still coasting."""
    by_itself_dps: float = 0.0
    """The speed at which it turns though nobody drives it, clockwise or up positive; 0: it stands, or is driven."""
    starts: int | None = None
    """How often its motor has been started in this pass; None: no relay starts it."""
    missing: tuple[Missing, ...] = ()
    """What this axis lacks; until it has it, it obeys only jog. Empty: commissioned."""
    lost: str = ""
    """Why the count is lost, where `missing` holds HOMING."""
    confirmable: bool = False
    """A person may say at which angle the axis stands: it counts, or its controller cannot know."""
    calibration: tuple[tuple[float, float], ...] | None = None
    """The calibration in force, (raw, degrees), for the configuration file."""
    fault: Fault | None = None
    homing: bool = False
    """It looks for its end stop."""
    notices: tuple[Notice, ...] = ()
    """What a person should know of this axis though it stops nothing."""
    noise_deg: float = 0.1
    """Scatter of the readings, rms, as seen so far."""
    learnt: tuple[LearntMotor, LearntMotor] | None = None
    """Its motor as learnt, clockwise or up first, then the other way; None: the drive has nothing to learn."""
    trusts: Trusts = ALL_OPEN
    """What is known of its two relays."""
    tries: Tries = NO_TRIES
    """What it was tried for in vain."""
    correction_deg: float = 0.0
    """How much further the boom points than the axis reads, as the mount really stands."""
    waiting: bool = False
    """Its relay closes as soon as the axis has been seen to stand, or its opposite relay to open."""

    @property
    def shown_deg(self) -> float | None:
        """`angle_deg` as programs and people are told it: at an end stop without the noise that reads beyond it."""
        if self.angle_deg is None:
            return None
        nearest_deg = min(max(self.angle_deg, self.min_deg), self.max_deg)
        margin_deg = min(AT_END_NOISES * self.noise_deg, AT_END_MOST_DEG)
        return nearest_deg if abs(self.angle_deg - nearest_deg) <= margin_deg else self.angle_deg

    @property
    def points_deg(self) -> float | None:
        """Where the boom points, as programs read it: on the turn of the axis, and above 90° over the top."""
        return None if self.shown_deg is None else self.shown_deg + self.correction_deg

    @property
    def at_target(self) -> bool:
        """It stands as near to its target as it is asked to."""
        if self.target_deg is None or self.tolerance_deg is None or self.angle_deg is None:
            return False
        off_deg = abs(self.angle_deg - self.target_deg)
        return not self.moving and off_deg <= self.tolerance_deg + AT_END_NOISES * self.noise_deg

    def at_end(self, direction: Direction) -> bool:
        """It is known to stand where no jog turns it any further that way."""
        if self.missing or self.angle_deg is None or not self.seen:
            return False
        end_deg = self.max_deg if direction > 0 else self.min_deg
        return direction is not Direction.OFF and (end_deg - self.angle_deg) * direction <= JOG_ENDS_DEG

    @property
    def relays_in_doubt(self) -> bool:
        """It matters to the axis that a person has seen its relays open."""
        return self.fault is not None or self.waiting or Trust.DOUBTED in self.trusts or Trust.WELDED in self.trusts

    @property
    def uncalibrated(self) -> str:
        """What this axis lacks, as text; empty: it is commissioned."""
        return ", ".join(f"{each.text} ({self.lost})" if each is Missing.HOMING else each.text for each in self.missing)


SHOWN_ERROR_DEG = 0.1
"""A smaller expected error is not told."""


@dataclass(frozen=True, slots=True)
class Flown:
    """The target of a planned pass that is flown. Moments are on the clock of `Status.at_s`."""

    name: str
    begin_s: float
    """When it rises; earlier than the status: it is up."""
    end_s: float
    """When it sets; infinite: it does not."""
    expected_error_deg: float = 0.0
    """How far it may be from where it is computed, from the age of its elements and from the clock."""
    recognised: bool = False
    """In the orders of a program that follows it; else the box tracks it by itself."""
    beyond_beam: bool = False
    """The expected error is more than half of the antenna's beam."""
    table: bool = False
    """A table that a person has handed in: it begins and ends, and does not rise or set."""

    @property
    def error_text(self) -> str:
        """`, error up to 0.3°`, with a warning if that is beyond the beam; empty if it is not worth a word."""
        if self.expected_error_deg < SHOWN_ERROR_DEG or self.recognised:
            return ""
        if self.beyond_beam:
            return f", ERROR UP TO {self.expected_error_deg:.0f}°: BEYOND THE BEAM"
        return f", error up to {self.expected_error_deg:.1f}°"


@dataclass(frozen=True, slots=True)
class Latch:
    """A stop that only a person releases."""

    by: str
    """Who has stopped the antenna."""
    storm: bool = False
    """It is a storm park: the antenna may be sent to its park position, and nowhere else."""


@dataclass(frozen=True, slots=True)
class Status:
    at_s: float
    azimuth: AxisStatus
    elevation: AxisStatus
    wanted_azimuth_deg: float | None = None
    """The direction last ordered, as ordered: what the display calls SAT."""
    wanted_elevation_deg: float | None = None
    latched: str = ""
    """The source of a stop or storm park that only a person releases; empty: there is none."""
    storm: bool = False
    """What is latched is a storm park, and the antenna is at it."""
    controlled_by: str = ""
    controlled_from: str = ""
    """The address of the machine whose program that is; empty: not known, or there is none."""
    held_by: str = ""
    """The person who has taken the antenna and not given it back; empty: there is none."""
    timed_point: int = 0
    timed_points: int = 0
    simulated: bool = False
    speed_level: int = 4
    mode: Mode = Mode.AUTO
    """The position of the front panel's mode switch; without one, what a person has set: AUTO at the start."""
    mode_by: str = ""
    """Who has set it; empty: nobody, as at the start."""
    mode_switch: bool = False
    """A front panel has such a switch."""
    flown: Flown | None = None
    """The box knows the target's path, and flies it as planned; None: it does not."""
    notices: tuple[str, ...] = ()
    """Whose orders have no effect, and why. The same trouble has the same text for as long as it lasts."""
    cycle_late_s: float = 0.0
    """How late the last control cycle was."""

    def axis(self, axis: Axis) -> AxisStatus:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    def wanted_deg(self, axis: Axis) -> float | None:
        return self.wanted_azimuth_deg if axis is Axis.AZIMUTH else self.wanted_elevation_deg

    @property
    def latch(self) -> Latch | None:
        """What has to survive the end of the program; None: nothing is latched."""
        return Latch(self.latched, storm=self.storm) if self.latched else None

    @property
    def recognised(self) -> str:
        """The satellite that a program's orders follow, and whose true path the antenna takes; empty: there is none."""
        return self.flown.name if self.flown is not None and self.flown.recognised else ""

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
