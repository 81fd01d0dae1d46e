"""The state of the box at one moment: immutable, made by the controller, read by views, protocols and links.

Knows only values. Its readers never ask the hardware.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from hw.ports import AngleSource, Axis, Direction
from rotator.exchange.faults import Fault, Missing, Notice
from rotator.exchange.motor import ALL_OPEN, NO_TRIES, Motor, Tries, Trust, Trusts
from rotator.exchange.orders import Mode

AT_END_NOISES, AT_END_MOST_DEG = 5.0, 1.0
"""A reading beyond an end of the range is shown as that end, up to this many times the noise and up to this many
degrees. Five times: one reading in three million is further off."""

SHOWN_OFF_DEG = 1.0
"""Degrees: nearer than this to its target, nobody asks why an axis does not turn."""
JOG_ENDS_DEG = 0.5
"""Degrees: nearer than this to an end of its range, no jog turns an axis towards that end."""


@dataclass(frozen=True, slots=True)
class AxisStatus:
    min_deg: float
    max_deg: float
    angle_deg: float | None = None
    """The axis angle on its own scale; the last good value while the sensor is out; None before the first value."""
    seen: bool = True
    """Whether the latest reading is good. False: the sensor is out, and `angle_deg` is the last good angle."""
    raw: float | None = None
    """The sensor's own reading, for calibration."""
    source: AngleSource = AngleSource.MEASURED
    target_deg: float | None = None
    """The axis angle that it goes to, or has reached; None: no target."""
    missed_deg: float | None = None
    """The target as ordered, where a fault has ended it or a sector keeps the axis from it; None: it has none, or goes
    there. A stop, another order, or a release after the cause has gone ends it."""
    tolerance_deg: float | None = None
    """The distance from the target that counts as reached; None: no target."""
    drive: Direction = Direction.OFF
    moving: bool = False
    """Whether the axis is driven or still coasts."""
    by_itself_dps: float = 0.0
    """The speed at which it turns by itself without a motor, clockwise or up positive; 0: it stands, or is driven."""
    starts: int | None = None
    """The number of motor starts in this pass; None: no relay starts it."""
    missing: tuple[Missing, ...] = ()
    """The missing steps of this axis. Until they are done it obeys only jog orders. Empty: commissioned."""
    lost: str = ""
    """Why the count is lost, if `missing` has HOMING."""
    confirmable: bool = False
    """Whether a person may confirm the angle: the axis counts pulses, or its controller cannot know the angle."""
    calibration: tuple[tuple[float, float], ...] | None = None
    """The present calibration, (raw, degrees), for the configuration file."""
    fault: Fault | None = None
    fault_present: bool = False
    """Whether the cause of the fault is still seen: no `resume` ends the fault now."""
    homeable: bool = False
    """Whether it has an end stop to find."""
    homing: bool = False
    """Whether the axis searches its end stop."""
    notices: tuple[Notice, ...] = ()
    """Remarks about this axis for a person. They stop nothing."""
    noise_deg: float = 0.1
    """Scatter of the readings, rms, since the start."""
    learnt: tuple[Motor, Motor] | None = None
    """The measured motor, first clockwise or up, then the other direction; None: the drive has nothing to learn."""
    trusts: Trusts = ALL_OPEN
    """The trust in its two relays."""
    tries: Tries = NO_TRIES
    """The vain tries of its motor."""
    correction_deg: float = 0.0
    """The boom's direction minus the axis angle, from the measured tilt and offset of the mount."""
    error_deg: float | None = None
    """How far an angle reckoned by time may be off; infinite: it is lost. None: the angle is seen or counted."""
    waiting: bool = False
    """Whether its relay waits to close, until the axis stands visibly or the opposite relay has visibly opened."""
    endless: bool = False
    """Whether it turns on and on. Its angles are then shown from 0 to 360, and the way from one to another is the short
    one."""
    fitted: bool = True
    """Whether the rotor has this axis. False: the antenna stands at `angle_deg` there, and nothing turns it."""

    @property
    def shown_deg(self) -> float | None:
        """`angle_deg` for programs and people: at an end stop without the noise beyond it."""
        if self.angle_deg is None:
            return None
        nearest_deg = min(max(self.angle_deg, self.min_deg), self.max_deg)
        margin_deg = min(AT_END_NOISES * self.noise_deg, AT_END_MOST_DEG)
        return nearest_deg if abs(self.angle_deg - nearest_deg) <= margin_deg else self.angle_deg

    @property
    def homes_first(self) -> bool:
        """Whether it finds its end stop by itself before the next target, and lacks nothing else."""
        return self.error_deg is not None and self.missing == (Missing.HOMING,)

    @property
    def error_text(self) -> str:
        """` ± 6°` where the angle is reckoned by time; empty: it is not."""
        if self.error_deg is None:
            return ""
        return f" ± {math.ceil(self.error_deg)}°" if math.isfinite(self.error_deg) else " ± ?"

    @property
    def points_deg(self) -> float | None:
        """The direction of the boom for programs: on the turn of the axis, and above 90° over the top."""
        return None if self.shown_deg is None else self.shown_deg + self.correction_deg

    @property
    def at_target(self) -> bool:
        """Whether the axis stands within the tolerance of its target."""
        if self.target_deg is None or self.tolerance_deg is None or self.angle_deg is None:
            return False
        off_deg = abs(self._way_deg(self.angle_deg, self.target_deg))
        return not self.moving and off_deg <= self.tolerance_deg + AT_END_NOISES * self.noise_deg

    @property
    def ordered_deg(self) -> float | None:
        """The axis angle last ordered, whether it goes there or is kept from there; None: no order."""
        return self.target_deg if self.missed_deg is None else self.missed_deg

    @property
    def off_deg(self) -> float | None:
        """How far it would have to turn to what was ordered; clockwise or up is positive. None: no order, or no
        angle."""
        if self.ordered_deg is None or self.shown_deg is None:
            return None
        return self._way_deg(self.shown_deg, self.ordered_deg)

    def _way_deg(self, from_deg: float, to_deg: float) -> float:
        return math.remainder(to_deg - from_deg, 360.0) if self.endless else to_deg - from_deg

    def at_end(self, direction: Direction) -> bool:
        """Whether the axis surely stands where no jog turns it further in this direction."""
        if self.missing or self.angle_deg is None or not self.seen or not self.fitted or self.endless:
            return False
        end_deg = self.max_deg if direction > 0 else self.min_deg
        return direction is not Direction.OFF and (end_deg - self.angle_deg) * direction <= JOG_ENDS_DEG

    @property
    def relays_in_doubt(self) -> bool:
        """Whether a person should check that its relays are open."""
        return self.fault is not None or self.waiting or Trust.DOUBTED in self.trusts or Trust.WELDED in self.trusts

    @property
    def uncalibrated(self) -> str:
        """The missing steps of this axis, as text; empty: commissioned."""
        return ", ".join(f"{each.text} ({self.lost})" if each is Missing.HOMING else each.text for each in self.missing)


SHOWN_ERROR_DEG = 0.1
"""Degrees: a smaller expected error is not shown."""


@dataclass(frozen=True, slots=True)
class Flown:
    """The target of the planned pass that is flown. Times are on the clock of `Status.at_s`."""

    name: str
    begin_s: float
    """When the target rises; before `at_s`: it is up."""
    end_s: float
    """When the target sets; infinite: it does not."""
    expected_error_deg: float = 0.0
    """The possible error of its computed direction, from the age of its elements and from the clock."""
    recognised: bool = False
    """Whether a program's orders follow it. False: the box tracks it by itself."""
    beyond_beam: bool = False
    """Whether the expected error is more than half of the antenna's beam."""
    table: bool = False
    """Whether the target is a person's table, which begins and ends, but does not rise or set."""

    @property
    def error_text(self) -> str:
        """`, error up to 0.3°`, with a warning if that is beyond the beam; empty if the error is small."""
        if self.expected_error_deg < SHOWN_ERROR_DEG or self.recognised:
            return ""
        if self.beyond_beam:
            return f", ERROR UP TO {self.expected_error_deg:.0f}°: BEYOND THE BEAM"
        return f", error up to {self.expected_error_deg:.1f}°"


def time_left(seconds: float) -> str:
    """`1:05 min`, or `2 h 07 min`: the time until a target rises or sets, for a person."""
    minutes, seconds_left = divmod(round(seconds), 60)
    return f"{minutes // 60} h {minutes % 60:02d} min" if minutes >= 60 else f"{minutes}:{seconds_left:02d} min"


@dataclass(frozen=True, slots=True)
class Latch:
    """A stop that only a person releases."""

    by: str
    """The source of the stop."""
    storm: bool = False
    """Whether the stop is a storm park: then the antenna may go to its park position only."""


@dataclass(frozen=True, slots=True)
class Status:
    at_s: float
    azimuth: AxisStatus
    elevation: AxisStatus
    wanted_azimuth_deg: float | None = None
    """The direction last ordered, as ordered: what the display calls SAT."""
    wanted_elevation_deg: float | None = None
    latched: str = ""
    """The source of a stop or storm park that only a person releases; empty: no such stop."""
    storm: bool = False
    """Whether the latched stop is a storm park in progress."""
    controlled_by: str = ""
    controlled_from: str = ""
    """The address of that sender's machine; empty: not known, or no network."""
    program_sends: bool = False
    """Whether that sender is a program whose latest order came a moment ago: more may follow."""
    held_by: str = ""
    """The person who has taken the antenna and not given it back; empty: no person holds it."""
    timed_point: int = 0
    timed_points: int = 0
    simulated: bool = False
    speed_level: int = 4
    mode: Mode = Mode.AUTO
    """The position of the front panel's mode switch. Without a switch: the mode set by a person; at the start AUTO."""
    mode_by: str = ""
    """The source that set the mode; empty: not set since the start."""
    mode_switch: bool = False
    """Whether a front panel has a mode switch."""
    flown: Flown | None = None
    """The planned pass that is flown; None: no planned pass."""
    nudge_azimuth_deg: float = 0.0
    """By how much a person has shifted the target in force, from the page or the console: until it ends."""
    nudge_elevation_deg: float = 0.0
    notices: tuple[str, ...] = ()
    """The sources whose orders have no effect, and why. A trouble keeps the same text as long as it lasts."""
    unkept: Notice | None = None
    """Why the card does not take what the box must not forget: also one of `notices`. None: it does."""
    cycle_late_s: float = 0.0
    """Seconds by which the last control cycle was late."""
    orders_wait: bool = False
    """Whether the box has an order that this status does not know yet."""

    def axis(self, axis: Axis) -> AxisStatus:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation

    @property
    def fitted(self) -> tuple[Axis, ...]:
        """The axes that the rotor has."""
        return tuple(axis for axis in Axis if self.axis(axis).fitted)

    def wanted_deg(self, axis: Axis) -> float | None:
        return self.wanted_azimuth_deg if axis is Axis.AZIMUTH else self.wanted_elevation_deg

    @property
    def latch(self) -> Latch | None:
        """The latched stop, which must survive the end of the program; None: nothing is latched."""
        return Latch(self.latched, storm=self.storm) if self.latched else None

    @property
    def recognised(self) -> str:
        """The satellite that a program's orders follow and whose true path the antenna takes; empty: none."""
        return self.flown.name if self.flown is not None and self.flown.recognised else ""

    @property
    def moving(self) -> bool:
        return self.azimuth.moving or self.elevation.moving

    @property
    def cut(self) -> bool:
        """Whether the motors' supply must be switched off."""
        return any(fault.cut for fault in self.faults)

    @property
    def stays(self) -> tuple[str, ...]:
        """Why an axis that an order has reached stands beside it, where no fault, notice or missing step says why."""
        return tuple(f"{axis.value}: {why}" for axis in self.fitted if (why := self._stays(axis, self.axis(axis))))

    def _stays(self, axis: Axis, each: AxisStatus) -> str:
        if each.target_deg is None or each.points_deg is None or each.moving or each.fault or each.missing:
            return ""
        target_deg, wanted_deg = each.target_deg + each.correction_deg, self.wanted_deg(axis)
        off_deg, raised_deg = abs(each.off_deg or 0.0), self.elevation.points_deg or 0.0
        if off_deg >= SHOWN_OFF_DEG and each.at_target and each.missed_deg is None:
            sky_deg = off_deg * abs(math.cos(math.radians(raised_deg)))
            sky = f", {sky_deg:.1f}° on the sky" if axis is Axis.AZIMUTH else ""
            return f"within tolerance: {off_deg:.1f}° from its target{sky}; it turns from {each.tolerance_deg:.1f}° on"
        if off_deg >= SHOWN_OFF_DEG and not each.notices:
            return "waits while the other axis turns" if self.moving else "waits for its motor"
        # While a path is flown the aim goes ahead of it.
        low = self.flown is None and wanted_deg is not None and wanted_deg < target_deg - SHOWN_OFF_DEG
        if axis is Axis.ELEVATION and low:
            return f"{wanted_deg:.1f}° is below its range or the horizon: it stays at {target_deg:.1f}°"
        return ""

    @property
    def ends_a_fault(self) -> bool:
        """Whether a `resume` ends a fault now: the cause of one of them is gone."""
        return any(a.fault and not a.fault_present for a in (self.azimuth, self.elevation))

    @property
    def faults(self) -> tuple[Fault, ...]:
        return tuple(a.fault for a in (self.azimuth, self.elevation) if a.fault)
