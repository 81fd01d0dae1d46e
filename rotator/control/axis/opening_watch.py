"""Whether a relay that was switched off has been seen to open: the axis slows down, or stands where nothing holds it.

A relay that has welded keeps its motor powered: the axis goes on as before, or is held by a stop. So a relay counts as
open only after readings that no powered motor makes: the axis has fallen behind such a motor where nothing could hold
it, or it has fallen behind and still moves on. Else the relay is in doubt until a run in its direction ends as it
should, or a person has looked at it. A sensor that filters or averages shows the axis late, and a sudden stop as a slow
one: what it shows is counted as far ahead as a motor turns in that time.

Knows how the axis moves (`estimator`), what may hold it (`obstacles`), and the supply. Decides nothing.
"""

from __future__ import annotations

from hw.ports import Direction
from rotator.control.axis.estimator import Estimator
from rotator.control.axis.obstacles import HOLDS_DEG, STOP_BEYOND_DEG, Obstacles
from rotator.control.axis.relay_state import BLINK_S, BOTH_WAYS, RelayState, RelayTrusts
from rotator.control.axis.trend import Slope
from rotator.control.sky.mount import Range
from rotator.exchange.motor import Trust

HELD_S, HELD_SURE = 0.8, 1.5
"""An axis may be driven for this time in all without being seen to turn, or until it is this many times surely held."""
STANDS_BEFORE_S, DOUBTS_AFTER_S = 0.15, 0.5
"""A powered motor is surely behind after the first time. Once the axis stands, a doubt is raised after the second: more
readings may still show that it has moved."""
LOST_SHARE = 0.8
"""A powered motor would not only seem to stay level with its pursuer, it gets ahead: this share of what is sure is
enough to be without current."""
MOVED_SHARE = 0.75
"""An axis at rest has been moved when it is ahead by this share of what is sure: that only asks for another look."""
COASTING_S, MEAN_OVER_S = 1.5, 0.1
"""No coast lasts longer. A place that is so much later shares few readings."""
LATE_OPEN_S, COASTS_SHARE = 0.25, 1.5
"""A burnt contact opens late by this time at most. A coast is at most 1.5 times the known coast. Only a powered motor
turns its axis further."""
RAN_ON_S, RAN_ON_AFTER_S, RAN_ON_SHARE, RAN_ON_LOOKS = 0.45, 1.5, 0.9, 5
"""An axis runs on that has, this long after a run as long as the second time, gone this share of the way of a powered
motor, at so many looks in a row."""
SUDDEN_SHARE, AROUND_S = 0.82, 0.08
"""An axis that has this share of its way behind it when a powered motor would have arrived did not slow down."""
LONGEST_WAIT_S = 4.5
"""What the readings have not shown after this time they do not show."""


class OpeningWatch:
    """Tell it of every change of the relays (`note_relays`), before the estimator, and of each look (`see`) after it.

    `limits`: the stops lie beyond them; None: not known. `look`: nothing has been seen of this axis yet.
    """

    def __init__(
        self, seen: Estimator, trusts: RelayTrusts, limits: Range | None, behind_s: float, *, look: bool
    ) -> None:
        self._seen = seen
        self._trusts = trusts
        self._behind_s = behind_s
        self.obstacles = Obstacles(limits)
        self.looks = look
        """The axis was not seen to stand in this run of the program yet."""
        self._stands_s: float | None = None
        """Since when it stands; None: it was not seen to stand since it was driven or moved."""
        self._moved = False
        """With no relay on, the axis left the place where it stood."""
        self._stood_deg = 0.0
        """Where it stood, by the latest look."""
        self.rested = True
        """The axis has stood since its relay opened."""
        self._run_begins()

    def _run_begins(self) -> None:
        """What the run before has shown is forgotten."""
        self._supplied = True
        """There has been a supply ever since the run."""
        self.ran_on, self._going = False, 0
        """The axis went on at its speed after its relay was switched off; and at how many looks in a row up to now."""
        self._held_up = False
        """The axis went on until something held it."""
        self._fell_s: float | None = None
        """When it was first clearly slower than a powered motor."""
        self._fell_deg: float | None = None
        """How far it had gone when the readings had followed it there."""

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the axis has stood for too long: its readings will not show that any more."""
        return self._stood(self._seen.trend.last_s) and not {Trust.DOUBTED, Trust.WELDED}.isdisjoint(self._trusts.both)

    def waits(self, direction: Direction) -> bool:
        """Whether this relay must not close yet: its opposite may still be closed, or it may itself have welded, which
        one closing after the other would hide."""
        seen, against = self._seen, Direction(-direction)
        if self.looks or self._trusts.of(against) is not Trust.OPEN:
            return True
        if direction is seen.relays.last and self._trusts.of(direction) is Trust.UNSEEN:
            return BLINK_S <= seen.relays.off_for_s(seen.trend.last_s) < LONGEST_WAIT_S
        return seen.fast[against].deg > seen.sure_deg  # the axis turns the other way, perhaps by the opposite relay

    def found_closed(self, way: Direction) -> None:
        self._trusts.found_closed(way)
        self.ran_on = True

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._trusts.checked()
        self.ran_on = False
        self._seen.released()
        self.obstacles.forget_all()

    def note_relays(self, relays: RelayState, was: RelayState) -> None:
        """The relays have changed; `was`: before."""
        if was.closed:
            self.rested = False
        if relays.closed:
            self._trusts.closed(relays.direction)
            self._stands_s = None
            self._run_begins()

    def see(self, at_s: float, gone_deg: float, *, supplied: bool) -> None:
        """A look, with no relay closed. `gone_deg`: since the look before."""
        self._supplied = self._supplied and supplied
        seen = self._seen
        if seen.line is not None and seen.off_deg is not None and self._supplied:
            self._note_slowing(at_s, seen.line)
        if self._stands_s is not None and (way := self._pushed()):
            self._note_moved(way)
            return
        least_deg = max(LOST_SHARE * seen.sure_deg, STANDS_BEFORE_S * seen.powered_dps)
        if min(seen.lost_deg.values()) <= least_deg:
            return
        self.looks, self.rested = False, True
        if self._stands_s is None:
            self._stands_s, self._held_up = at_s, self._ended_suddenly()
            if self._moved:
                self.obstacles.left(self._place_deg)
            self._moved = False
        else:
            self.obstacles.drift(gone_deg)
        self._stood_deg = self._place_deg
        for way in BOTH_WAYS:
            self._conclude(at_s, way)

    def _note_slowing(self, at_s: float, line: Slope) -> None:
        """The axis turned when its relay was switched off: does it slow down, or does it go on?"""
        seen, way = self._seen, self._seen.relays.last
        if self.ran_on or self._trusts.of(way) is Trust.OPEN or line.way is not way:
            return
        passed_s, placed_s = at_s - seen.relays.since_s, seen.place_s - seen.relays.since_s
        self._note_fallen(at_s, (abs(line.speed_dps) - 3.0 * line.error_dps) * placed_s - seen.gone_deg, passed_s)
        # Something would hold a powered motor where it has fallen behind: an axis that still moves on has no current.
        moves_on = self._fell_deg is not None and seen.gone_deg - self._fell_deg > seen.sure_deg
        ahead_deg = (max(seen.full_dps, abs(line.speed_dps) + line.error_dps)) * (self._behind_s + MEAN_OVER_S)
        free = self.obstacles.free(way, self._place_deg + way * (ahead_deg + seen.sure_deg), STOP_BEYOND_DEG)
        fallen = seen.lost_deg[way] > LOST_SHARE * seen.sure_deg
        if (moves_on and passed_s <= COASTING_S) or (fallen and free and not self._went_far(seen.trend.noise_deg)):
            self._trusts.seen_open(way)
        elif passed_s >= RAN_ON_S + self._behind_s and seen.relays.since_s - seen.relays.begun_s >= RAN_ON_AFTER_S:
            on = seen.gone_deg - 0.5 * seen.sure_deg > RAN_ON_SHARE * seen.full_dps * placed_s
            self._going = self._going + 1 if on else 0
            self.ran_on = self._going >= RAN_ON_LOOKS

    def _note_fallen(self, at_s: float, behind_deg: float, passed_s: float) -> None:
        if self._fell_s is None:
            seen_since = self._seen.place_s > self._seen.relays.since_s
            if seen_since and behind_deg > 1.3 * self._seen.sure_deg and passed_s <= COASTING_S:
                self._fell_s = at_s
        elif self._fell_deg is None and at_s - self._fell_s >= self._behind_s + MEAN_OVER_S:
            self._fell_deg = self._seen.gone_deg

    def _went_far(self, less_deg: float) -> bool:
        """Whether the axis has gone further than it coasts, since its relay was switched off."""
        seen, lag_s = self._seen, self._seen.motor.lag_s
        longest_s = max(LATE_OPEN_S + lag_s, COASTS_SHARE * lag_s) + self._behind_s
        error_dps = seen.line.error_dps if seen.line else 0.0
        return seen.gone_deg - less_deg > longest_s * (seen.full_dps + error_dps)

    def _ended_suddenly(self) -> bool:
        """Whether the axis, further than it coasts, was there already when a powered motor would have been.

        A coast ends slowly; an axis that something holds at full speed ends suddenly.
        """
        seen = self._seen
        if seen.line is None or seen.off_deg is None or not self._went_far(0.5 * seen.sure_deg):
            return False
        then_s = seen.relays.since_s + seen.gone_deg / seen.full_dps + self._behind_s
        then_deg = seen.trend.place_deg(then_s, AROUND_S)
        return then_deg is None or abs(then_deg - seen.off_deg) >= SUDDEN_SHARE * seen.gone_deg

    def _conclude(self, at_s: float, way: Direction) -> None:
        """The axis stands: decide whether that shows this relay open."""
        trust, seen = self._trusts.of(way), self._seen
        if trust is Trust.OPEN:
            return
        held = seen.held.deg >= max(HELD_S * seen.powered_dps, HELD_SURE * seen.sure_deg)
        if seen.relays.last is way:
            # The supply may have been switched off by hand: only a run that was seen shows that a welded relay opens.
            shown = not held and not self._held_up and not (trust is Trust.WELDED and seen.line is None)
        else:
            shown = not held and trust is Trust.UNSEEN
        if shown and not self.ran_on and self.obstacles.free(way, self._place_deg):
            self._trusts.seen_open(way)
        elif trust is Trust.UNSEEN and self._stood(at_s):
            self._trusts.doubt(way)
            self.obstacles.note(way, self._place_deg)

    def _stood(self, at_s: float) -> bool:
        return self._stands_s is not None and at_s - self._stands_s >= DOUBTS_AFTER_S + self._behind_s

    def _pushed(self) -> Direction:
        """The way in which the axis has left the place where it stood; OFF: it has not."""
        seen = self._seen
        carried_deg = self._place_deg - self._stood_deg  # in a gap of the readings
        if abs(carried_deg) > max(HOLDS_DEG, seen.sure_deg):
            return Direction.PLUS if carried_deg > 0.0 else Direction.MINUS
        moves = (way for way in BOTH_WAYS if seen.slow[way].deg > MOVED_SHARE * seen.sure_deg)
        return next(moves, Direction.OFF)

    def _note_moved(self, way: Direction) -> None:
        """Something turns the axis, though no relay was closed: the relay of that direction may be closed."""
        self._stands_s, self._moved = None, True
        self._trusts.closed(way)
        self._seen.released()
        against = Direction(-way)
        if self._trusts.of(against) is Trust.DOUBTED:
            # The axis has been turned away from what may have held it.
            self._trusts.look_again(against)
            self.obstacles.forget(against)

    @property
    def _place_deg(self) -> float:
        assert self._seen.place_deg is not None, "asked only after a look"
        return self._seen.place_deg
