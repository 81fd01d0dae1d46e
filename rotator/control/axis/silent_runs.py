"""Whether an axis that counts turns at all when it is driven, from one short run to the next.

Knows when the motor was driven and when its contact changed. A run that is too short to be judged by itself counts
together with those before it in the same direction, until the contact changes. Decides nothing: it returns a fault, and
the axis stops.
"""

from __future__ import annotations

from hw.ports import Axis
from rotator.control.axis.relay_faults import WAYS
from rotator.control.axis.relay_state import RelayState
from rotator.exchange.faults import Fault, FaultKind

SILENT_PERIODS = 3.0
"""An axis does not turn if it was driven one way for this many periods in all without a change of its contact."""
START_S = 0.15
"""A motor needs this long in each run before it turns at its speed."""


class SilentRuns:
    """Give it every change of the relays (`note_relays`) and every reading (`see`), in order of time."""

    def __init__(self, axis: Axis) -> None:
        self._axis = axis
        self._changes: int | None = None
        self._relays = RelayState()
        self._turns_s = 0.0
        """From when on the present run counts."""
        self._silent_s = 0.0
        """Total time of earlier runs without a pulse."""

    def forget(self) -> None:
        """A person watches the axis press against its stop."""
        self._silent_s = 0.0

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        was, self._relays = self._relays, relays
        if was.closed:
            self._silent_s += max(0.0, relays.since_s - self._turns_s)
        if relays.closed:
            if relays.direction is not was.last:
                self._silent_s = 0.0
            self._turns_s = relays.since_s + START_S

    def see(self, at_s: float, changes: int, period_s: float) -> Fault | None:
        """`changes`: of the contact, up to now. `period_s`: from pulse to pulse, at the motor's speed.

        Returns the fault that this shows, if any.
        """
        if changes != self._changes:
            self._changes, self._silent_s = changes, 0.0
            self._turns_s = max(self._turns_s, at_s)
        if not self._relays.closed:
            return None
        silent_s = self._silent_s + max(0.0, at_s - self._turns_s)
        if silent_s <= SILENT_PERIODS * period_s:
            return None
        self._silent_s, self._turns_s = 0.0, at_s
        way = WAYS[self._axis, self._relays.direction]
        measured = f"its motor ran {way} for {silent_s:.1f} s in all, and the contact did not change"
        return Fault(FaultKind.NO_PULSES, self._axis, measured)
