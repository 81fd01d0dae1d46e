"""Whether the relay of an axis that counts has been seen to open: its contact stops changing, where it would change.

Knows when the contact changed, what the relays do, and on which sides of the axis another edge of the contact lies
before its stop. A contact that is silent shows that the motor has no current only where that motor would soon have
changed it: after a run in which it did, and with an edge ahead. Otherwise the relay is in doubt, as in `opening_watch`.
Times are compared with those of the latest run; before one, with those of a motor at a third of its speed.
"""

from __future__ import annotations

import math
from collections import deque

from hw.ports import Direction
from rotator.control.axis.readings import Condition
from rotator.control.axis.relay_state import BLINK_S, BOTH_WAYS, RelayState, RelayTrusts
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Trust

SLOWEST_SHARE = 0.3
"""A powered motor turns at this share of its speed at least."""
SURE_PAUSES = 1.4
"""A contact is silent after this many times the longest pause between two changes of a run."""
CHANGE_READ_S = 0.1
"""A change of the contact has been read after this time."""
LONGEST_SHOW_S = 2.0
"""No relay waits longer for its own contact: pulses that are further apart show a weld over several pauses."""
UNSURE_PERIODS = 2.0
"""Where a change of the contact may have been counted the wrong way, no stop may be nearer than this."""
BLIND_PERIODS = 3.0
"""An axis driven for this many periods in all without a change of its contact was not seen to turn."""
TURNING_CHANGES = 2
"""Two late changes mean that the motor still has current. One may come from a coast that ends just beyond an edge.

Where the count is lost, one is enough: the next edge may lie behind a stop.
"""


class ContactWatch:
    """Give it every reading and every change of the relays, in order of time.

    `limits`: from stop to stop. `period_s`, `period_deg`: from pulse to pulse at full speed. `coast_s`: how long the
    motor coasts at most.
    """

    def __init__(
        self, trusts: RelayTrusts, limits: Range, period_s: float, period_deg: float, coast_s: float, *, look: bool
    ) -> None:
        self._limits = limits
        self._period_deg = period_deg
        self._period_s = period_s
        self._coast_s = coast_s
        self._trusts = trusts
        self.looked = not look
        self.homing = False
        """A person watches how it finds its stop, and that it turns back there."""
        self._relays = RelayState()
        self._supplied_s: float | None = None
        self._changes: int | None = None
        self._read_s = -math.inf
        """When the latest reading was taken."""
        self._late_changes = 0
        """The changes of the contact when a motor without current would stand, until it is silent again."""
        self._changed_s = -math.inf
        self._angle_deg = 0.0
        self._ahead: frozenset[Direction] = frozenset()
        self._turned_back = False
        """A change after the latest run counted as a turn back. It may be an edge ahead: the count is uncertain."""
        self._moments_s: deque[float] = deque(maxlen=3)
        """The latest changes of the present or latest run."""
        self._blind_s = 0.0
        """For how long relays were closed since the contact last changed."""
        self.turns = False
        """The contact has changed while the relays were off, and has not been silent since then."""
        self._doubted_before = False
        """A relay was in doubt already when these changes began."""
        self.caught = False
        """The latest reading shows that such a relay is closed: its motor has current."""
        self._settled = False
        """The contact has been silent for long enough since the latest run."""
        self._ran_since = dict.fromkeys(BOTH_WAYS, False)
        """Whether a relay has been closed again since it was doubted."""

    def waits(self, direction: Direction) -> bool:
        """Whether that relay has to wait: nothing has shown yet that its opposite is open, or it has not been off for
        long enough to show that it has welded itself. One closing after the other would hide that.
        """
        if self._relays.direction is direction:
            return False
        # A late change may be the first of a powered motor: the contact must be silent first.
        if not self.looked or self._late_changes > 0 or self._trusts.of(Direction(-direction)) is not Trust.OPEN:
            return True
        shows_s = min(self._coast_s + self._period_s, LONGEST_SHOW_S)
        pending = direction is self._relays.last and self._trusts.of(direction) is Trust.UNSEEN and not self.homing
        return pending and BLINK_S <= self._relays.off_for_s(self._read_s) < shows_s

    @property
    def settles(self) -> bool:
        """The relay of the latest run is off, and has not been seen open yet."""
        last = self._relays.last
        return not self._relays.closed and last in BOTH_WAYS and self._trusts.of(last) is Trust.UNSEEN

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the contact will not show that any more: it has been silent for too long, or it
        has not changed in a run that it was to clear."""
        return Trust.DOUBTED in self._trusts.both and (self._settled or self._in_vain)

    @property
    def _in_vain(self) -> bool:
        """The run of the doubted relay has shown nothing, its coast is over, and the other relay needs no look."""
        last = self._relays.last
        if self._relays.closed or self._moments_s or self.homing or not self.looked or last not in BOTH_WAYS:
            return False
        over = self._read_s > self._relays.since_s + self._coast_s + CHANGE_READ_S
        other = self._trusts.of(Direction(-last))
        return over and self._trusts.of(last) is Trust.DOUBTED and other is Trust.OPEN

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._trusts.checked()
        self._blind_s, self.turns = 0.0, False

    def silent(self) -> None:
        """A fault has ended a run in which the contact did not change."""
        self._blind_s = math.inf

    def note_relays(self, relays: RelayState) -> None:
        """The relays have changed."""
        was, self._relays = self._relays, relays
        if was.closed:
            self._blind_s += relays.since_s - max(was.since_s, self._changed_s)
        if relays.closed:
            self._trusts.closed(relays.direction)
            self._moments_s.clear()
            self._turned_back, self._settled, self._late_changes = False, False, 0
            self._ran_since[relays.direction] = True

    def see(self, at_s: float, angle_deg: float, condition: Condition) -> None:
        changes = 0 if self._changes is None else condition.changes - self._changes
        changed = changes != 0
        self._changes, before_s, self._read_s = condition.changes, self._read_s, at_s
        relays = self._relays
        if changed and not relays.closed:
            went_back = (angle_deg - self._angle_deg) * relays.last < 0.0
            again_ahead = relays.last in condition.ahead - self._ahead
            self._turned_back = self._turned_back or went_back or again_ahead
        self._angle_deg, self._ahead, self.caught = angle_deg, condition.ahead, False
        if changed:
            self._changed_s, self._blind_s, self._settled = at_s, 0.0, False
        if relays.closed:
            if changed:
                self._moments_s.append(at_s)
        elif not condition.supplied:
            self._supplied_s = None
        else:
            self._supplied_s = at_s if self._supplied_s is None else self._supplied_s
            still_s = relays.since_s + self._coast_s + CHANGE_READ_S
            if before_s > still_s:
                self._late_changes += changes
            if changed and self._late_changes >= (1 if condition.lost else TURNING_CHANGES):
                self._turns_by_itself()
            else:
                self._see_rest(at_s, still_s, condition)

    def _see_rest(self, at_s: float, still_s: float, condition: Condition) -> None:
        assert self._supplied_s is not None
        if at_s - max(still_s, self._changed_s, self._supplied_s) >= self._pause_s:
            self._note_standing(condition)

    @property
    def _pause_s(self) -> float:
        """For how long the contact of a powered motor may be silent."""
        if len(self._moments_s) == self._moments_s.maxlen:
            return SURE_PAUSES * (self._moments_s[-1] - self._moments_s[0])
        return self._period_s / SLOWEST_SHARE

    def _turned(self, *, lost: bool) -> bool:
        """Whether the axis turned when the latest run ended, as far as its contact can show."""
        if self.homing:
            return True
        if not lost:
            return self._blind_s <= BLIND_PERIODS * self._period_s
        measured = len(self._moments_s) == self._moments_s.maxlen
        # The axis may have met its stop anywhere: the last change must be as recent as that of an axis that turns.
        return self._blind_s <= (self._moments_s[-1] - self._moments_s[0] if measured else self._period_s)

    @property
    def _room_deg(self) -> float:
        """From the counted angle to the stop in the direction of the latest run."""
        limits = self._limits
        return limits.max_deg - self._angle_deg if self._relays.last > 0 else self._angle_deg - limits.min_deg

    def _turns_by_itself(self) -> None:
        """The contact changes by itself. It does not show in which direction the axis turns."""
        if not self.turns:
            self._doubted_before = Trust.DOUBTED in self._trusts.both
        self.turns, self.caught = True, self._doubted_before
        for way in BOTH_WAYS:
            if self._trusts.of(way) is not Trust.OPEN and way is self._relays.last:
                self._doubt(way)
            else:
                self._trusts.closed(way)

    def _note_standing(self, condition: Condition) -> None:
        self.looked, self._settled, self.turns, self._late_changes = True, True, False, 0
        ahead = frozenset(BOTH_WAYS) if condition.lost or self.homing else condition.ahead
        if self._turned_back and not self.homing and self._room_deg < UNSURE_PERIODS * self._period_deg:
            ahead -= {self._relays.last}
        turned = self._turned(lost=bool(condition.lost))
        for way in BOTH_WAYS:
            trust = self._trusts.of(way)
            # A doubt of a relay ends only after a run of its own.
            own_run = way is self._relays.last and self._ran_since[way] and bool(self._moments_s)
            if turned and way in ahead and (trust is not Trust.DOUBTED or own_run):
                self._trusts.seen_open(way)
            elif trust is Trust.UNSEEN:
                self._doubt(way)

    def _doubt(self, way: Direction) -> None:
        self._trusts.doubt(way)
        self._ran_since[way] = False
