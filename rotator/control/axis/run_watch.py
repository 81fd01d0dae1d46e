"""The watch over an axis that counts: how long its motor may run in one go, and when its opposite relay may close.

Knows what the relays do and how long the travel takes; `contact_watch` and `vain_runs` say what its contact shows. A
count cannot run the wrong way, for the counter takes the direction from the relays. The counter itself sees pulses that
are missing in one long run, and pulses at rest. Of an axis from which nothing comes back, the first alone is watched.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.ports import Axis, Direction
from rotator.control.axis.contact_watch import ContactWatch
from rotator.control.axis.estimator import Estimator
from rotator.control.axis.readings import NORMAL, Condition
from rotator.control.axis.relay_faults import WAYS, accusation, unstoppable
from rotator.control.axis.relay_state import RelayState, RelayTrusts
from rotator.control.axis.vain_runs import SilentRuns, VainRuns
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, FaultKind, Notice
from rotator.exchange.motor import ALL_OPEN, Motor, Trusts

TRAVEL_SHARE, TRAVEL_MORE_S = 1.3, 5.0
"""A motor may run this much longer in one go than the travel from end to end takes."""


def endless(axis: Axis, direction: Direction, run_s: float, limits: Range, speed_dps: float) -> Fault | None:
    """The fault of having run in one direction for `run_s`, where that is too long."""
    longest_s = TRAVEL_SHARE * (limits.max_deg - limits.min_deg) / speed_dps + TRAVEL_MORE_S
    if run_s <= longest_s:
        return None
    measured = f"its motor ran {WAYS[axis, direction]} for {run_s:.0f} s without a pause"
    return Fault(FaultKind.RUN_TOO_LONG, axis, measured, f"{longest_s:.0f} s")


class RunWatch:
    """The `RelayWatch` of an axis that counts.

    `period_s`: from pulse to pulse at full speed. `coast_s`: how long the motor coasts at most. `look`: nothing has
    been seen of the axis in this run of the program.
    """

    notices: tuple[Notice, ...] = ()
    noise_deg = 0.0
    """A count does not scatter."""

    def __init__(
        self,
        axis: Axis,
        limits: Range,
        motors: Mapping[Direction, Motor],
        period_s: float,
        coast_s: float,
        *,
        master: bool,
        trusts: Trusts,
        look: bool,
    ) -> None:
        self._axis = axis
        self._limits = limits
        self._motors = motors
        self._master = master
        self._period_deg = period_s * max(motor.speed_dps for motor in motors.values())
        self._trusts = RelayTrusts(trusts)
        self._contact = ContactWatch(self._trusts, limits, period_s, self._period_deg, coast_s, look=look)
        self._silent = SilentRuns(axis)
        self.runs = VainRuns(Estimator(motors, 0.0))
        """A count shows no place between two pulses; `SilentRuns` tells of its runs."""
        self._relays = RelayState()
        self._angle_deg: float | None = None

    @property
    def trusts(self) -> Trusts:
        """What is known of the two relays."""
        return self._trusts.both

    @property
    def looks(self) -> bool:
        """The axis has not been seen to stand yet, or turns though its relays are off."""
        return not self._contact.looked or self._contact.turns

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the contact will not show that any more."""
        return self._contact.unsure

    def note_relays(self, relays: RelayState) -> None:
        self._relays = relays
        self._contact.note_relays(relays)
        self._silent.note_relays(relays)

    def see(self, at_s: float, angle_deg: float, condition: Condition = NORMAL) -> Fault | None:
        """A reading, and what the rotor says of its contact."""
        self._angle_deg = angle_deg
        self._contact.see(at_s, angle_deg, condition)
        speed_dps = self._motors[self._relays.direction or Direction.PLUS].speed_dps
        silent = self._silent.see(at_s, condition.changes, self._period_deg / speed_dps)
        if silent or (condition.fault and condition.fault.kind is FaultKind.NO_PULSES):
            self._contact.silent()
        relays = self._relays
        if not relays.closed:
            return self._runs_on() if self._master and self._contact.caught else None
        return silent or endless(self._axis, relays.direction, at_s - relays.since_s, self._limits, speed_dps)

    def _runs_on(self) -> Fault:
        """A doubt and two changes are enough where a master cuts the supply: the contact may stick at any moment."""
        measured = "a relay is in doubt, and its contact changes though its relays are off"
        return unstoppable(Fault(FaultKind.TURNS_BY_ITSELF, self._axis, measured), master=self._master)

    def rescale(self, motors: Mapping[Direction, Motor], *, placed: bool) -> None:
        """A new scale changes the angles only: what the contact has shown stays true."""
        self._motors, self._angle_deg = motors, None

    def homes(self, *, homing: bool, failed: bool) -> None:
        """A person watches, until the axis has been seen to stand at its stop."""
        if homing:
            self._silent.forget()
        self._contact.homing = homing or (self._contact.homing and not failed and self._contact.settles)

    def forbids(self, direction: Direction) -> bool:
        """Whether this relay must not close yet, because its opposite may still be closed."""
        return self._contact.waits(direction)

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction, as long as the opposite relay is suspected."""
        against = Direction(-direction)
        place = "" if self._angle_deg is None else f" stands at {self._angle_deg:.1f}°"
        return accusation(self._axis, against, self._trusts.of(against), place, master=self._master)

    def acknowledge(self) -> None:
        """No fault of this watch keeps the supply off."""

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._contact.checked()


class BlindWatch:
    """The `RelayWatch` of an axis that is reckoned by time. `travel`: from stop to stop.

    Whether it turns, which way, and whether a relay has opened, nothing shows: so no relay is ever doubted here, and no
    fault that needs a reading is found.
    """

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
