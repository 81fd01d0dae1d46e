"""An axis that the rotor does not have: the elevation of most rotors on the air.

The antenna stands at one angle there. Every target counts as reached, so that a satellite's azimuth is followed while
its elevation is not. Knows no reading and no drive: nothing reads or turns it.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.control.axis.readings import Reading
from rotator.control.axis.settings import AbsentSettings
from rotator.control.commands import HOLD, Command, Decision, Steer
from rotator.control.refused import Refused, is_not_fitted
from rotator.control.sky.goal import AimGoal
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Missing, Notice
from rotator.exchange.status import AxisStatus


class AbsentAxis:
    """The kind of `ControlledAxis` that is not fitted."""

    fault: Fault | None = None
    missing: tuple[Missing, ...] = ()
    speed_dps = 1.0
    """Of no effect, as every way has no length; above 0, because plans divide by it."""
    busy = jog_is_held = driven = pressed_in_vain = confirmable = False
    has_relays = turns_when_fed = homeable = homing = waits = False
    stopping_room_deg = position_error_deg = 0.0

    def __init__(self, settings: AbsentSettings) -> None:
        self._settings = settings
        self._goal: AimGoal | None = None

    @property
    def angle_deg(self) -> float:
        return self._settings.limits.min_deg

    @property
    def aiming(self) -> AimGoal | None:
        return self._goal

    def moving(self, now_s: float) -> bool:
        return False

    def confirmed(self) -> None:
        self._refuse()

    def see(self, reading: Reading, now_s: float) -> None:
        pass

    def aim(self, goal: AimGoal) -> None:
        self._goal = AimGoal(self.angle_deg, goal.tolerance_deg)

    def nudged(self) -> None:
        pass

    def limit_speed(self, level: int) -> None:
        pass

    def jog(self, direction: Direction, seconds: float | None, now_s: float, *, held: bool = False) -> None:
        if direction is not Direction.OFF:
            self._refuse()

    def home(self) -> None:
        self._refuse()

    def halt(self) -> None:
        self._goal = None

    def forget_path(self) -> None:
        pass

    def fail(self, fault: Fault) -> None:
        pass

    def acknowledge(self, now_s: float, *, by_person: bool) -> bool:
        return False  # there is nothing, and so no errand for the rotor

    def calibrate_end(self, *, high_end: bool) -> None:
        self._refuse()

    def checked(self) -> None:
        self._refuse()

    def decide(self, now_s: float) -> Decision:
        return Decision(HOLD)

    def sweep(self, now_s: float, command: Command | None) -> Range:
        return self._settings.limits

    def hold_back(self, now_s: float, why: str) -> None:
        pass

    def shortened(self, now_s: float, command: Steer) -> None:
        pass

    def note_driven(self, now_s: float, driven: Direction) -> None:
        pass

    def status(self, now_s: float, *, starts: int | None = None, more: tuple[Notice, ...] = ()) -> AxisStatus:
        angle_deg = self.angle_deg
        goal = self._goal
        return AxisStatus(
            min_deg=angle_deg,
            max_deg=angle_deg,
            angle_deg=angle_deg,
            target_deg=None if goal is None else goal.target_deg,
            tolerance_deg=None if goal is None else goal.tolerance_deg,
            fitted=False,
        )

    def _refuse(self) -> None:
        raise Refused(is_not_fitted(self._settings.axis.value))
