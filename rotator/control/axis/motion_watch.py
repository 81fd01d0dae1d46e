"""The watch over an axis whose angle is measured: it runs when driven, the right way, and stands when not.

Knows what the relays do, the good readings, the motor as learnt, and the limits. Time is an argument. Decides nothing:
it returns a fault, and the axis stops.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.driven_watch import DrivenWatch
from rotator.control.axis.observed_motion import ObservedMotion
from rotator.control.axis.opening_watch import OpeningWatch
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.relay_trust import RelayTrusts
from rotator.control.axis.weld_watch import WeldWatch
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Notice
from rotator.exchange.motor import Motor, Trusts


class MotionWatch:
    """The `RelayWatch` of an axis whose angle is measured.

    `placed`: the angles are calibrated, and the limits known. Without that only the relays are watched. `look`: nothing
    has been seen of the axis in this run of the program. `behind_s`: how old what a reading shows may be.
    """

    def __init__(
        self,
        axis: Axis,
        limits: Range,
        motors: Mapping[Direction, Motor],
        behind_s: float = 0.0,
        *,
        master: bool,
        trusts: Trusts,
        placed: bool,
        look: bool,
    ) -> None:
        self._axis = axis
        self._limits = limits
        self._behind_s = behind_s
        self._master = master
        self._trusts = RelayTrusts(trusts)
        self._begin(motors, placed=placed, look=look)

    def _begin(self, motors: Mapping[Direction, Motor], *, placed: bool, look: bool) -> None:
        self._placed = placed
        self._seen = ObservedMotion(self._axis, self._limits, motors, behind_s=self._behind_s)
        self._driven = DrivenWatch(self._seen)
        self._opening = OpeningWatch(self._seen, self._trusts, placed=placed, look=look)
        self._weld = WeldWatch(self._seen, self._opening, self._trusts, master=self._master)

    @property
    def trusts(self) -> Trusts:
        """What is known of the two relays."""
        return self._trusts.both

    @property
    def looks(self) -> bool:
        """Nothing has been seen of the axis yet."""
        return not self._opening.looked

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the readings will not show that any more."""
        return self._opening.unsure

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        was = self._seen.relays
        self._opening.note_relays(relays, was)
        self._seen.note_relays(relays)
        self._weld.note_relays(relays, was)

    def see(self, at_s: float, angle_deg: float, condition: Condition = NORMAL) -> Fault | None:
        """A good reading. Returns the fault that it shows, if any."""
        on_line = self._seen.see(at_s, angle_deg)
        if on_line:
            self._opening.see(at_s, angle_deg, supplied=condition.supplied)
        if self._seen.relays.closed:
            return self._driven.judge(at_s, angle_deg, on_line=on_line) if self._placed else None
        return self._weld.judge(at_s) if on_line else None

    def homes(self, *, homing: bool, failed: bool) -> None:
        """An axis that measures has no end stop to find."""

    def rescale(self, motors: Mapping[Direction, Motor], *, placed: bool) -> None:
        """The readings mean other places from now on: what they have shown is forgotten."""
        relays = self._seen.relays
        self._begin(motors, placed=placed, look=self.looks)
        self.note_relays(relays)

    def forbids(self, direction: Direction) -> bool:
        """Whether this relay must not close yet, because its opposite may still be closed."""
        return self._seen.relays.direction is not direction and self._opening.waits(direction)

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction, as long as the opposite relay is suspected."""
        return self._weld.accuse(direction)

    def acknowledge(self) -> None:
        """The fault is acknowledged: the supply comes back with the next order."""
        self._weld.acknowledge()

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._opening.checked()

    @property
    def noise_deg(self) -> float:
        """Scatter of the readings, rms, as seen up to now."""
        return self._seen.trend.noise_deg

    @property
    def notices(self) -> tuple[Notice, ...]:
        return self._weld.notices
