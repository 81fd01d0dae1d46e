"""One axis as the controller sees it, whether relays switch its motor or the motor goes to an angle by itself.

Knows the shape that both kinds share. An axis owns its goal: the controller sets it by `aim`, `jog` and `halt`, and
reads it back only as values. A question changes nothing.
"""

from __future__ import annotations

from typing import Protocol

from hw.ports import Direction
from rotator.control.axis.readings import Reading
from rotator.control.commands import Command, Decision, Steer
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Missing, Notice
from rotator.exchange.status import AxisStatus


class ControlledAxis(Protocol):
    @property
    def angle_deg(self) -> float | None:
        """The last believable angle, on the axis's own scale; None before the first."""

    @property
    def speed_dps(self) -> float:
        """How fast the motor is, as known now."""

    @property
    def aiming(self) -> AimGoal | None:
        """The target that the axis points at; None: it rests, jogs or homes."""

    @property
    def busy(self) -> bool:
        """Whether the axis has a goal: it aims, jogs or homes."""

    @property
    def jog_is_held(self) -> bool:
        """Whether the axis turns only for as long as its sender is there: a jog without a time, or a held one."""

    @property
    def driven(self) -> bool:
        """Whether the motor was on after the last cycle."""

    @property
    def missing(self) -> tuple[Missing, ...]:
        """What the axis lacks before it may be aimed; empty: nothing."""

    @property
    def pressed_in_vain(self) -> bool:
        """Whether presses without a calibration have failed to move it so often that a person has to look."""

    @property
    def confirmable(self) -> bool:
        """Whether a person may say at which angle the axis stands."""

    @property
    def has_relays(self) -> bool:
        """Whether relays switch its motor, so that its starts can be counted."""

    @property
    def turns_when_fed(self) -> bool:
        """Whether its motor turns as soon as a master relay feeds the motors: a relay of it was found closed."""

    @property
    def homeable(self) -> bool:
        """Whether the axis counts pulses, and so has an end stop to find."""

    @property
    def homing(self) -> bool:
        """Whether the axis is on its way to its end stop."""

    @property
    def waits(self) -> bool:
        """Whether its motor rests after a long run, or its relay may not close yet: it goes on by itself."""

    def moving(self, now_s: float) -> bool:
        """Driven, or still coasting."""

    def confirmed(self) -> None:
        """A person says where it stands: its readings jump there, and that is no fault of the sensor."""

    def see(self, reading: Reading, now_s: float) -> None:
        """Take the latest reading. The same reading again is not new, but it may have grown too old."""

    def aim(self, goal: AimGoal) -> None:
        """Point there from now on."""

    def nudged(self) -> None:
        """A person has shifted the target: it is worth a move, also within the tolerance."""

    def limit_speed(self, level: int) -> None:
        """No faster than X1 to X4 of a GS-232 says, where an output sets the speed."""

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        """Turn that way for `seconds`, or until halted (None). OFF halts. `held`: no wait prolongs the time."""

    def home(self) -> None:
        """Find the end stop. Raises Refused where it is not `homeable`."""

    def halt(self) -> None:
        """Stop and have no goal."""

    def forget_path(self) -> None:
        """Keep the target where it is now: its path is not known any more."""

    def fail(self, fault: Fault) -> None:
        """Stop until the fault is acknowledged."""

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        """A person, or a stop on a link, acknowledges the fault. It stays while its cause is present. A link may not
        have a motor tried again too often. Returns whether the acknowledgement counts.
        """

    @property
    def fault(self) -> Fault | None:
        """What stopped the axis; None: it may be driven."""

    def calibrate_end(self, *, high_end: bool) -> None:
        """The axis stands at an end of its range: take its reading for that end. Raises Refused."""

    def checked(self) -> None:
        """A person has looked at both relays: they are open. Raises Refused where there are none."""

    def decide(self, now_s: float) -> Decision:
        """The order to the drive from now on: the one that the goal asks for, if it is safe."""

    def sweep(self, now_s: float, command: Command | None) -> Range:
        """The angles that the axis may pass from now until it has come to rest, if this command is the last one.

        A command of None: it is to stop now. Returns `UNKNOWN` where its angle is not known.
        """

    @property
    def stopping_room_deg(self) -> float:
        """Distance it may travel after a start before a command can stop it."""

    @property
    def position_error_deg(self) -> float:
        """Possible error of the known angle."""

    def hold_back(self, now_s: float, why: str) -> None:
        """The latest command is not carried out, for this reason. This ends a jog and the way to an end stop."""

    def shortened(self, now_s: float, command: Steer) -> None:
        """This command replaces the latest one, which would lead too far. A jog ends there."""

    def note_driven(self, now_s: float, driven: Direction) -> None:
        """After the cycle: the direction in which its relays are really closed (OFF where there are none)."""

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        """The axis as others see it. What only the controller knows of it: `starts` of its motor in this pass, and
        `more` notices."""
