"""What watches the relays of one axis, as `relay_gate` sees it: the shape that both kinds of watch share.

`MotionWatch` watches an axis whose angle is measured, `RunWatch` one that counts. A question changes nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from hw.ports import Direction
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.vain_runs import VainRuns
from rotator.exchange.faults import Fault, Notice
from rotator.exchange.motor import Motor, Trusts


class RelayWatch(Protocol):
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time."""

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
