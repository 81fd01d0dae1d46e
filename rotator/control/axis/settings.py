"""What is known of an axis before the box starts, for both kinds: switched and positioned.

Knows values, made from the configuration. Knows no file.
"""

from __future__ import annotations

from dataclasses import dataclass

from hw.ports import AngleSource, Axis
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import Window
from rotator.control.axis.timed_homing import TimedHomingSettings
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Missing
from rotator.exchange.motor import ALL_OPEN, NO_TRIES, Motor, Tries, Trusts

NEAR_DEG = 0.5
"""How far from its place a positioned axis may come to rest, where its drive leaves no dead band."""


@dataclass(frozen=True, slots=True)
class BrakeSettings:
    release_s: float
    """A start takes so much longer while the brake holds."""
    held_off_s: float
    """So long after a run the brake is still off."""
    rock: bool = False
    """An axis that stands at its start is run the other way for a moment, once."""


@dataclass(frozen=True, slots=True)
class SpeedSettings:
    lowest_share: float
    """The lowest speed, as a share of full speed."""
    slow_start_s: float
    slow_down_s: float
    """From the lowest speed to full speed, and back."""


@dataclass(frozen=True, slots=True)
class SwitchedSettings:
    axis: Axis
    limits: Range
    tolerance_deg: float
    motor: Motor
    """The motor as the configuration describes it."""
    window: Window
    calibration: Calibration | None
    missing: tuple[Missing, ...] = ()
    """What a person has still to do before this axis may be aimed; empty: commissioned."""
    source: AngleSource = AngleSource.MEASURED
    learnt: tuple[Motor, Motor] | None = None
    """The motor as an earlier run learnt it, clockwise or up first, then the other way."""
    longest_run_s: float = 0.0
    rest_s: float = 0.0
    """How long the motor may run in one go, and how long it then takes to cool; zero: no limit."""
    master: bool = False
    """Whether an output switches the motors' supply."""
    homing: HomingSettings | TimedHomingSettings | None = None
    """How to find its end stop, where it counts pulses or time; None: its sensor needs no homing."""
    trusts: Trusts = ALL_OPEN
    """What an earlier run of the program knew of its two relays."""
    brake: BrakeSettings | None = None
    """Its brake, which the drive works; None: it has none."""
    speed: SpeedSettings | None = None
    """What an output can set its motor's speed to; None: it turns at full speed."""
    look: bool = False
    """The axis must be seen to stand before its first relay closes."""
    sensor: str = "pot"
    """What reads the angle, in a word for the messages of faults."""
    behind_s: float = 0.0
    """A reading shows a place where the axis was at most so long ago: the sensor filters, or averages."""
    attended: bool = False
    """A person watches the antenna, and drives it to its stops on purpose. A relay in doubt forbids nothing then."""
    tries: Tries = NO_TRIES
    """What earlier runs of the program have tried in vain."""


@dataclass(frozen=True, slots=True)
class PositionedSettings:
    axis: Axis
    limits: Range
    tolerance_deg: float
    speed_dps: float
    window: Window
    calibration: Calibration | None
    missing: tuple[Missing, ...] = ()
    """What a person has still to do before this axis may be aimed; empty: commissioned."""
    source: AngleSource = AngleSource.MEASURED
    near_deg: float = NEAR_DEG
    """How far from its place the drive may leave the axis."""
    accel_dps2: float | None = None
    """How hard the motor brakes; None: it stops at once."""
    reversal_rest_s: float = 0.0
    """How long the drive lets a motor rest that is to turn the other way."""
    confirmable: bool = False
    """A person may say at which angle the axis stands."""
    homes: bool = False
    """Its drive finds its end stop by itself."""
    own_motor: bool = False
    """While it is to hold, neither wind nor a hand can turn it: only its own motor."""
    master: bool = False
    """Whether an output switches its motor's supply."""
    tries: Tries = NO_TRIES
    """What earlier runs of the program have tried in vain."""
    sensor: str = "pot"
    """What reads the angle, in a word for the messages of faults."""


@dataclass(frozen=True, slots=True)
class AbsentSettings:
    """An axis that the rotor does not have: the antenna stands at the one angle of `limits`."""

    axis: Axis
    limits: Range
    tolerance_deg: float


AxisSettings = SwitchedSettings | PositionedSettings | AbsentSettings
