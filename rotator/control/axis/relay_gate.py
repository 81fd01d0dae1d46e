"""Whether a direction relay of one axis may close now: only where its opposite has been seen to open.

Knows the relays, what the readings have shown of them, and whether a person watches. While a run waits, the motor gets
its supply alone where a master is wired: that shows a welded relay. Knows no goal and no limit.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Protocol

from hw.ports import Direction
from rotator.control.axis.motion_watch import MotionWatch
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_faults import WAYS, doubts, unstoppable
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.run_watch import BlindWatch, RunWatch
from rotator.control.axis.settings import SwitchedSettings
from rotator.control.axis.timed_homing import TimedHomingSettings
from rotator.control.axis.vain_runs import VainRuns
from rotator.control.commands import Feed, Run
from rotator.control.sky.mount import Range
from rotator.exchange.faults import Fault, Notice
from rotator.exchange.motor import Motor, Trust, Trusts


class RelayWatch(Protocol):
    """What watches the relays of one axis. Give it every change of them (`note_relays`) and every good reading (`see`),
    in order of time. A question changes nothing."""

    runs: VainRuns
    """Those that were not seen to turn the axis."""

    @property
    def trusts(self) -> Trusts:
        """What is known of the two relays."""

    @property
    def looks(self) -> bool:
        """Whether the axis has to be seen at rest before any relay closes."""

    @property
    def unsure(self) -> bool:
        """Whether a relay may be closed, and the readings will not show that any more."""

    @property
    def noise_deg(self) -> float:
        """Scatter of the readings, rms, as seen up to now."""

    @property
    def notices(self) -> tuple[Notice, ...]: ...

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""

    def see(self, at_s: float, angle_deg: float, condition: Condition) -> Fault | None:
        """Take a reading. Returns the fault that it shows, if any."""

    def homes(self, *, homing: bool, failed: bool) -> None:
        """Whether the axis looks for its end stop, and may stand there, driven. `failed`: a fault has ended that."""

    def rescale(self, motors: Mapping[Direction, Motor], *, placed: bool) -> None:
        """The readings mean other places than before. What is known of the relays stays."""

    def forbids(self, direction: Direction) -> bool:
        """Whether this relay must not close yet, because its opposite may still be closed."""

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction, as long as the opposite relay is suspected."""

    def acknowledge(self) -> None:
        """The fault is acknowledged: the supply comes back with the next order."""

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""


SETTLED_AFTER_S = 1.0
"""A motor counts as moving until it has been off this long."""
WAITS_SHOWN_AFTER_S = 4.0
"""A shorter wait of a relay is not shown to a person."""
WAITS = Notice("waits until it stands still before its relay closes")


class RelayGate:
    """Give it every change of the relays (`note_relays`), and its `watch` every good reading. It passes a run, or not.

    `placed`: the readings are angles, and the limits are known.
    """

    def __init__(
        self, settings: SwitchedSettings, motors: Mapping[Direction, Motor], *, lease_s: float, placed: bool
    ) -> None:
        self._settings = settings
        self._lease_s = lease_s
        self._relays = RelayState()
        self.watch = _new_watch(settings, motors, placed=placed)
        self._waits_s = math.inf
        """Since when a run waits for the opposite relay to be seen open; infinite: no run waits."""

    @property
    def waiting(self) -> bool:
        return self._waits_s < math.inf

    @property
    def turns_when_fed(self) -> bool:
        """A relay was found closed: its motor turns as soon as the box switches the supply on for the other motor."""
        return self._settings.master and Trust.WELDED in self.watch.trusts

    @property
    def unsure(self) -> bool:
        """A relay may be stuck. Only cutting the supply, which the box can do, is sure to stop the motor."""
        return self._settings.master and self.watch.unsure

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        self._relays = relays
        self.watch.note_relays(relays)

    def accuse(self, direction: Direction) -> Fault | None:
        """The fault of an order in this direction; None: the opposite relay is not suspected."""
        return None if self._passes_doubt(direction) else self.watch.accuse(direction)

    def rests(self) -> None:
        """No run is wanted."""
        self._waits_s = math.inf

    def passed(self, run: Run, now_s: float) -> Run | Feed:
        """The run, or what is done while it waits."""
        if self._passes_doubt(run.direction) or not self.watch.forbids(run.direction):
            self._waits_s = math.inf
            return run
        self._waits_s = min(self._waits_s, now_s)
        # With the supply on, a motor shows whether a relay has not opened. Without a master it always has its supply.
        return Feed(now_s + self._lease_s) if self._settings.master else Run(Direction.OFF, now_s)

    def blind(self, fault: Fault | None, now_s: float) -> Fault | None:
        """This fault of the sensor. If it hides whether the motor has stopped, the fault cuts the supply."""
        relays = self._relays
        if fault is None or relays.last is Direction.OFF:
            return fault
        trust = self.watch.trusts[0 if relays.last > 0 else 1]
        if trust is Trust.OPEN or relays.off_for_s(now_s) < SETTLED_AFTER_S:
            return fault
        way = WAYS[self._settings.axis, relays.last]
        unseen = fault.told(f"{fault.exceeded}, and it may still run {way}")
        return unstoppable(unseen, master=self._settings.master)

    def notices(self, now_s: float) -> tuple[Notice, ...]:
        waits = (WAITS,) if now_s - self._waits_s >= WAITS_SHOWN_AFTER_S else ()
        doubted = doubts(self._settings.axis, self.watch.trusts) if self._settings.attended else ()
        return (*self.watch.notices, *doubted, *waits)

    def _passes_doubt(self, direction: Direction) -> bool:
        """Whether the opposite relay is only in doubt, and a person watches who has driven the axis to its stop.

        The first look at the axis with its supply on comes before that: a person may not have seen what it shows.
        """
        if self.watch.looks:
            return False
        plus, minus = self.watch.trusts
        return self._settings.attended and (minus if direction > 0 else plus) is Trust.DOUBTED


def _new_watch(settings: SwitchedSettings, motors: Mapping[Direction, Motor], *, placed: bool) -> RelayWatch:
    axis, limits, homing, behind_s = settings.axis, settings.limits, settings.homing, settings.behind_s
    master, trusts, look = settings.master, settings.trusts, settings.look
    if isinstance(homing, TimedHomingSettings):
        return BlindWatch(axis, Range(homing.home_deg, homing.home_deg + homing.travel_deg), motors)
    if homing is None:
        return MotionWatch(axis, limits, motors, behind_s, master=master, trusts=trusts, placed=placed, look=look)
    return RunWatch(axis, limits, motors, homing.period_s, homing.coast_s, master=master, trusts=trusts, look=look)
