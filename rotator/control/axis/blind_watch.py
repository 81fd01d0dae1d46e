"""The watch over an axis from which nothing comes back: how long its motor may run in one go, and no more.

Whether it turns, which way, and whether a relay has opened, nothing shows: so no relay is ever doubted here, and no
fault that needs a reading is found.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.estimator import Estimator
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.run_watch import endless
from rotator.control.axis.vain_runs import VainRuns
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Notice
from rotator.exchange.motor import ALL_OPEN, Motor, Trusts


class BlindWatch:
    """The `RelayWatch` of an axis that is reckoned by time. `travel`: from stop to stop."""

    notices: tuple[Notice, ...] = ()
    noise_deg = 0.0
    trusts: Trusts = ALL_OPEN
    looks = False
    unsure = False

    def __init__(self, axis: Axis, travel: Range, motors: Mapping[Direction, Motor]) -> None:
        self._axis = axis
        self._travel = travel
        self._slowest_dps = min(motor.speed_dps for motor in motors.values())
        self.runs = VainRuns(Estimator(motors, 0.0))
        """Never told of a run: of none it could be seen to be in vain."""
        self._relays = RelayState()

    def note_relays(self, relays: RelayState) -> None:
        self._relays = relays

    def see(self, at_s: float, _angle_deg: float, _condition: Condition = NORMAL) -> Fault | None:
        relays = self._relays
        if not relays.closed:
            return None
        return endless(self._axis, relays.direction, at_s - relays.since_s, self._travel, self._slowest_dps)

    def homes(self, *, homing: bool, failed: bool) -> None:
        """At its stop it looks like anywhere else."""

    def rescale(self, _motors: Mapping[Direction, Motor], *, placed: bool) -> None:
        """The travel stays as long."""

    def forbids(self, _direction: Direction) -> bool:
        return False

    def accuse(self, _direction: Direction) -> Fault | None:
        return None

    def acknowledge(self) -> None:
        """No fault of this watch keeps the supply off."""

    def checked(self) -> None:
        """No relay is ever in doubt."""
