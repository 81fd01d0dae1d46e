"""Whether a relay that was switched off has been seen to open: the axis slows down, or stands where nothing holds it.

A relay that has welded keeps its motor powered: the axis goes on as before, or is held by a stop. So the relay counts
as open only after readings that no powered motor makes:

* the axis turned when the relay was switched off, and is slower since, so far inside its limits that it cannot have met
  a stop (speeds are compared with what this run measured, not with what the file says);
* or it stands, inside its limits, after a run in which it was seen to turn.

A sensor that filters or averages shows the axis late, and a sudden stop as a slow one: what it shows is counted as far
ahead as a motor turns in that time.

Otherwise the relay is in doubt until a run in its direction ends as it should, or a person has looked at it. Readings
without a supply (the master is open) do not count. Before the first relay of a run of the program closes, the axis must
be seen to stand. Knows the motion, the relays and the supply. Decides nothing.
"""

from __future__ import annotations

import math
from collections import deque

from hw.ports import Direction
from rotator.control.axis.observed_motion import ObservedMotion
from rotator.control.axis.relay_state import BLINK_S, RelayState
from rotator.control.axis.relay_trust import BOTH_WAYS, RelayTrusts
from rotator.control.axis.run_on import RunOn
from rotator.control.axis.seen_run import (
    BLIND_S,
    END_WINDOWS_S,
    EXTRAPOLATED_AFTER_S,
    HELD_UNSEEN_S,
    LONGEST_WINDOW_S,
    POWERED_SHARE,
    EndedRun,
    SeenRun,
)
from rotator.control.axis.standing import STOP_BEYOND_DEG, Obstacles, RestPlace
from rotator.control.axis.trend import LONGEST_GAP_S, Slope
from rotator.exchange.motor import Trust

DOUBTS_AFTER_S = 0.5
GAP_S = 0.5
"""No command to a relay holds for longer without being renewed."""
MEAN_BEHIND_S = 0.05
"""The mean of three readings lies so far behind the latest one."""
PLACE_NOISES = 1.7
"""That mean is surely right within this many noises: three of its standard errors."""
MOVED_DEG, MOVED_NOISES = 0.5, 4.0
"""An axis has been moved when it is this far from where it stood, and this many times the noise."""


class OpeningWatch:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time.

    `placed`: the limits are known, and the stops lie beyond them. `look`: nothing has been seen of this axis yet.
    """

    def __init__(self, seen: ObservedMotion, trusts: RelayTrusts, *, placed: bool, look: bool) -> None:
        self._seen = seen
        self._trusts = trusts
        self._placed = placed
        self.looked = not look
        """The axis has been seen to stand in this run of the program."""
        self._run = SeenRun(seen)
        self._run_on = RunOn(seen, self._run)
        self._supplied_s: float | None = None
        """Since when the motor would have current if a relay were closed; None: it would not."""
        self._unbroken = False
        """There has been a supply ever since the latest run."""
        self._latest: deque[float] = deque(maxlen=3)
        self._seen_s = -math.inf
        """When the latest reading was taken."""
        self._rest = RestPlace()
        self._obstacles = Obstacles(seen.limits if placed else None)

    @property
    def ran_on(self) -> bool:
        """The axis went on at its speed after its relay was switched off."""
        return self._run_on.ran_on

    @property
    def measured_dps(self) -> float | None:
        """The slower of the speeds that the latest runs have shown; None: there was no such run."""
        return self._run.measured_dps

    @property
    def place(self) -> str:
        """Where the axis stands, for a person."""
        return f" stands at {self._place_deg:.1f}°" if self._latest and self._placed else ""

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the axis has stood for too long: its readings will not show that any more."""
        stood = self._rest.since_s is not None and self._seen_s - self._rest.since_s >= self._doubts_after_s
        return stood and not {Trust.DOUBTED, Trust.WELDED}.isdisjoint(self._trusts.both)

    def waits(self, direction: Direction) -> bool:
        """Whether that relay has to wait: the readings have not yet shown that its opposite is open, or that it has
        opened itself. One closing after the other would hide that it has welded.
        """
        if not self.looked or self._trusts.of(Direction(-direction)) is not Trust.OPEN:
            return True
        relays = self._seen.relays
        if direction is relays.last and self._trusts.of(direction) is Trust.UNSEEN:
            return BLINK_S <= relays.off_for_s(self._seen_s) < LONGEST_WINDOW_S
        # The axis is turning the other way, perhaps by the opposite relay: wait.
        slope = self._seen.trend.slope(self._seen.trend.last_s - END_WINDOWS_S[1])
        powered_dps = POWERED_SHARE * self._run.motor_dps
        return slope is not None and -slope.speed_dps * direction - 2.0 * slope.error_dps > powered_dps

    def found_closed(self, direction: Direction) -> None:
        self._trusts.found_closed(direction)
        self._run_on.ran_on = True

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._trusts.checked()
        self._run.ended, self._run.blind_s, self._run_on.ran_on = None, 0.0, False
        self._obstacles.forget_all()

    def note_relays(self, relays: RelayState, was: RelayState) -> None:
        """The relays have changed; `was`: before."""
        if was.closed:
            self._end(relays.since_s, was.direction, relays.since_s - was.begun_s)
        if relays.closed:
            self._trusts.closed(relays.direction)
            self._rest.driven()
            self._run.begin()
            self._run_on.begin()

    def see(self, at_s: float, angle_deg: float, *, supplied: bool) -> None:
        """A good reading, on the line of the others."""
        gap_s, self._seen_s = at_s - self._seen_s, at_s
        if gap_s > LONGEST_GAP_S:
            self._latest.clear()
        self._latest.append(angle_deg)
        if self._seen.relays.closed:
            # After a long gap the guard has opened the relay: how the run went before it is what counts.
            if gap_s <= GAP_S or self._run.line is None:
                self._see_run(at_s)
        elif not supplied:
            self._supplied_s, self._unbroken = None, False
        else:
            self._supplied_s = at_s if self._supplied_s is None else self._supplied_s
            if gap_s > LONGEST_GAP_S:
                self._run.seen_after_gap(at_s, gap_s, angle_deg)
            self._rest.see(angle_deg)
            self._see_rest(at_s)

    @property
    def _place_deg(self) -> float:
        return sum(self._latest) / len(self._latest)

    # --- a relay is closed

    def _see_run(self, at_s: float) -> None:
        relays, run = self._seen.relays, self._run
        self._supplied_s, self._unbroken = relays.begun_s, True
        run.see(at_s)
        if run.line is not None:
            self._rest.turned()
            self._obstacles.turned_to(self._place_deg)
        elif at_s - max(relays.begun_s, run.turned_s) > run.longest_blind_s:
            self._obstacles.note(relays.direction, self._place_deg)
            self._rest.held(self._place_deg, len(self._latest))

    def _end(self, now_s: float, direction: Direction, lasted_s: float) -> None:
        place_deg = self._place_deg if self._latest else 0.0
        if self._run.line is not None and now_s - self._seen_s > EXTRAPOLATED_AFTER_S:
            # Without readings: its motor was powered until now.
            place_deg += self._run.line.speed_dps * (now_s - self._seen_s)
        self._run.end(now_s, direction, lasted_s, place_deg)

    # --- no relay is closed

    def _see_rest(self, at_s: float) -> None:
        ended = self._run.ended
        if ended is not None and ended.line is not None and self._unbroken:
            self._note_slowing(at_s, ended, ended.line)
        if self._stands(at_s):
            self._note_standing(at_s)
            for way in BOTH_WAYS:
                self._conclude(at_s, way)
        elif self._rest.at_deg is not None and self._moved_from(self._rest.at_deg):
            self._note_moved(self._rest.at_deg)

    def _note_slowing(self, at_s: float, ended: EndedRun, line: Slope) -> None:
        if self._run_on.ran_on or self._trusts.of(ended.direction) is Trust.OPEN:
            return
        ahead_deg = (self._run_on.full_dps(ended) + line.error_dps) * (self._seen.behind_s + MEAN_BEHIND_S)
        ahead_deg += PLACE_NOISES * self._seen.trend.noise_deg
        free = self._obstacles.free(line.way, self._place_deg + line.way * ahead_deg, STOP_BEYOND_DEG)
        if self._run_on.slows(at_s, self._place_deg, ended, line, free=free):
            self._trusts.seen_open(ended.direction)

    def _stands(self, at_s: float) -> bool:
        assert self._supplied_s is not None
        return self._run.stands(at_s, max(self._supplied_s, self._run.ended.off_s if self._run.ended else -math.inf))

    def _note_standing(self, at_s: float) -> None:
        self.looked = True
        if self._rest.since_s is None:
            self._run_on.stands(self._place_deg)
        self._obstacles.drift(self._rest.stand(at_s))
        left_deg = self._rest.left_deg(self._seen.trend.noise_deg)
        if left_deg is None:
            return
        self._run.blind_s = 0.0
        if self._moved_from(left_deg):
            # The axis has left what held it, or its readings had stood still.
            self._run.turned_s = -math.inf
            self._obstacles.left(self._place_deg, self._moved_deg)

    def _conclude(self, at_s: float, way: Direction) -> None:
        """The axis stands: decide whether that shows this relay open."""
        trust, rest = self._trusts.of(way), self._rest
        if trust is Trust.OPEN:
            return
        assert rest.at_deg is not None
        assert rest.since_s is not None
        ended = self._run.ended if self._run.ended and self._run.ended.direction is way else None
        shown = self._followed(ended) if ended else trust is Trust.UNSEEN and self._run.blind_s <= BLIND_S
        if trust is Trust.WELDED:
            # The supply may have been switched off by hand: only a run that was seen shows that it opens.
            shown = shown and ended is not None and ended.line is not None
        if shown and not self._run_on.ran_on and self._obstacles.free(way, rest.at_deg):
            self._trusts.seen_open(way)
        elif trust is Trust.UNSEEN and at_s - rest.since_s >= self._doubts_after_s:
            self._trusts.doubt(way)
            self._obstacles.note(way, rest.at_deg)

    def _followed(self, ended: EndedRun) -> bool:
        """Whether the axis turned when its latest run ended; after a short run, whether it may have turned."""
        if ended.line is not None:
            return not self._run_on.held_up
        if ended.off_s - ended.lasted_s <= self._run.turned_s < ended.off_s - self._run.unseen_s:
            return False  # in this run it turned at first, and something held it
        return self._run.blind_s <= self._run.longest_blind_s

    @property
    def _doubts_after_s(self) -> float:
        """An axis stands this long before a doubt is raised: more readings may still show that it has moved."""
        return DOUBTS_AFTER_S + 2.0 * (self._run.unseen_s - HELD_UNSEEN_S) + self._seen.behind_s

    @property
    def _moved_deg(self) -> float:
        return MOVED_DEG + MOVED_NOISES * self._seen.trend.noise_deg

    def _moved_from(self, rest_deg: float) -> bool:
        return abs(self._place_deg - rest_deg) > self._moved_deg

    def _note_moved(self, rest_deg: float) -> None:
        """Something turns the axis, though no relay was closed: the relay of that direction may be closed."""
        way = Direction.PLUS if self._place_deg > rest_deg else Direction.MINUS
        self._rest.moved()
        self._trusts.closed(way)
        against = Direction(-way)
        if self._trusts.of(against) is Trust.DOUBTED:
            # The axis has been turned away from what may have held it.
            self._trusts.look_again(against)
            self._run.blind_s, self._run.ended = 0.0, None
            self._obstacles.forget(against)
