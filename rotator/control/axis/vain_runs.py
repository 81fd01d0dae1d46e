"""Runs and moves that do not turn their axis: how many, and whether that is enough to say so.

Knows how far the axis is behind a motor so slow that it stands (`estimator`), and what the relays do. Judges nothing:
`motion_watch` makes a fault of it, and of an axis without a calibration the person who presses makes what they see. Of
an axis that counts, knows when its contact changed; of a positioned one, how far it came nearer to where it was sent.
"""

from __future__ import annotations

import math

from hw.ports import Axis
from rotator.control.axis.estimator import START_S, Behind, Estimator
from rotator.control.axis.relay_faults import WAYS
from rotator.control.axis.relay_state import RelayState
from rotator.exchange.faults import Fault, FaultKind, Notice

STANDS_S, SHORT_S, LONGEST_S, SURE_SHARE = 1.2, 0.5, 4.0, 0.85
"""An axis stands after it was driven for the first time in all, and is behind by this share of what is sure: by what
its pursuer runs in the second time at least. Where noise asks for more than he runs in the third, that is enough; in
the first, until the axis has shown that it turns."""
SETTLES_S = 0.6
"""After a run the relay has opened, the axis has come to rest and its place has followed within this time."""
ENOUGH_PRESSES, ENOUGH_S, LONG_S = 3, 1.0, 4.5
"""An axis without a calibration is pressed in vain after so many presses, of the first time in all; or after the second
time: presses that follow each other without a pause look like one."""
STANDING_FAULTS = frozenset({FaultKind.STANDS_STILL, FaultKind.END_STOP, FaultKind.BRAKE_HELD})
"""The faults of a motor that does not turn."""
IN_VAIN = Notice(
    "presses did not move it: a program turns it again after a person has turned it, or after `resume`", "NOT TURNING"
)


class VainRuns:
    """Tell it of every change of the relays (`note_relays`) and of each look (`see`), after the estimator."""

    def __init__(self, seen: Estimator) -> None:
        self._seen = seen
        self.tries = 0
        """Runs without motion since the last fault, or since the axis was last seen to turn."""
        self._pressed = False
        """In an earlier run of the program presses did not turn the axis."""

    @property
    def in_vain(self) -> bool:
        """Whether the present run, or one before it, has not been seen to turn the axis."""
        seen = self._seen
        return self.tries > 0 or (not seen.turned and seen.relays.closed) or self.settles(seen.trend.last_s)

    def settles(self, now_s: float) -> bool:
        """Whether the last run is just over and was not seen to turn the axis: the readings may show it yet."""
        seen = self._seen
        return not seen.turned and not seen.relays.closed and seen.relays.off_for_s(now_s) < SETTLES_S

    @property
    def stands(self) -> bool:
        """Whether the axis was driven for long enough, in one run or in several, to be sure that it stands."""
        seen = self._seen
        most_s = LONGEST_S if seen.shown else STANDS_S
        least_s = max(min(SURE_SHARE * seen.sure_deg / seen.stands_dps, most_s), SHORT_S)
        return seen.short.for_s >= STANDS_S and seen.short.deg >= least_s * seen.stands_dps

    @property
    def pressed(self) -> bool:
        """Whether an axis without a calibration has been pressed in vain often enough, or for long enough."""
        for_s = self._seen.short.for_s
        return self._pressed or for_s >= LONG_S or (self.tries >= ENOUGH_PRESSES and for_s >= ENOUGH_S)

    def note_pace(self, pace: float) -> None:
        """The motor turns at this share of its full speed from now on."""
        self._seen.note_pace(pace)

    def note_relays(self, relays: RelayState, was: RelayState) -> None:
        """The relays have changed; `was`: before."""
        if was.closed and not self._seen.turned and relays.since_s - was.begun_s >= START_S:
            self.tries += 1

    def see(self) -> None:
        if self._seen.turned and self._seen.relays.last:
            self.tries, self._pressed = 0, False

    def struck(self, kind: FaultKind) -> None:
        """A fault has stopped the axis. If it stood still, one more run without motion is enough for the next fault."""
        seen = self._seen
        self.tries, seen.back_deg, seen.turned = 0, 0.0, True
        stood = kind in STANDING_FAULTS
        seen.short = Behind(seen.sure_deg, STANDS_S - SHORT_S, seen.sure_deg) if stood else Behind()

    def forget(self, *, pressed: bool = False) -> None:
        """A person has looked. `pressed`: what an earlier run of the program knew of presses."""
        self.tries, self._pressed, self._seen.short = 0, pressed, Behind()


SILENT_PERIODS = 3.0
"""An axis does not turn if it was driven one way for this many periods in all without a change of its contact."""
TURNS_AFTER_S = 0.15
"""A motor needs this long in each run before it turns at its speed."""


class SilentRuns:
    """Whether an axis that counts turns at all when it is driven. A run that is too short to be judged by itself counts
    together with those before it in the same direction, until the contact changes.

    Give it every change of the relays (`note_relays`) and every reading (`see`), in order of time.
    """

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
            self._turns_s = relays.since_s + TURNS_AFTER_S

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


LEAST_TRY_S = 0.4
"""In a shorter move a motor may not have started yet."""


class VainMoves:
    """Whether a positioned axis follows: moves that did not bring it nearer, a moving target that it did not follow.

    A move that ends too early for a fault counts with the fault that comes later. Tell it of each look at an axis that
    is sent somewhere (`see`), and when its drive holds (`hold`).
    """

    def __init__(self) -> None:
        self.count = 0
        """Moves in vain since the axis last came nearer, or since a fault counted them; without the present one."""
        self._since_s: float | None = None
        """When the present move began; None: the axis is there, it came nearer, or the move is counted."""
        self._lasts_s = 0.0
        self._least_deg = 0.0

    @property
    def any(self) -> bool:
        """Whether the present move, or one before it, has not been seen to bring it nearer."""
        return self.count > 0 or self._since_s is not None

    def see(self, sent_s: float, nearer_deg: float, coming_deg: float, *, begins: bool) -> None:
        """`sent_s`: for how long, in all, the axis was sent somewhere. `nearer_deg`: how far, in all, it came nearer.

        `begins`: the drive held before, and the axis is sent elsewhere.
        """
        if begins:
            self._since_s, self._least_deg = sent_s, nearer_deg
        if self._since_s is None:
            return
        self._lasts_s = sent_s - self._since_s
        self._least_deg = min(self._least_deg, nearer_deg)
        if nearer_deg - self._least_deg >= coming_deg:
            self.count, self._since_s = 0, None

    def hold(self) -> None:
        if self._since_s is not None and self._lasts_s >= LEAST_TRY_S:
            self.count += 1
        self._since_s = None

    def struck(self) -> None:
        """A fault has stopped the axis, and has counted these moves and the present one."""
        self.count, self._since_s = 0, None


class LeftBehind:
    """Where the target was while the axis stood. It must follow a moving target from anywhere in its dead band."""

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """The axis is sent to another place."""
        self._stands_deg = math.inf
        self._low_deg, self._high_deg = math.inf, -math.inf
        self._since_s: float | None = None

    def seconds(
        self, sent_s: float, target_deg: float, place_deg: float, *, moved_deg: float, apart_deg: float
    ) -> float:
        """For how long the target has been `apart_deg` from where it was before, and the axis has not moved."""
        if abs(place_deg - self._stands_deg) >= moved_deg:
            self.begin()
            self._stands_deg = place_deg
        self._low_deg, self._high_deg = min(self._low_deg, target_deg), max(self._high_deg, target_deg)
        if self._high_deg - self._low_deg < apart_deg:
            return 0.0
        self._since_s = sent_s if self._since_s is None else self._since_s
        return sent_s - self._since_s
