"""Whether a relay that was switched off has been seen to open: the axis slows down, or stands where nothing holds it.

A relay that has welded keeps its motor fed: the axis goes on as before, or is held by a stop. So it counts as open only
after readings that no fed motor makes:

* the axis turned when the relay was switched off, and is slower since, inside its limits; speeds are compared with what
  this run measured, not with what the file says of the motor;
* or it stands, inside its limits, after a run in which it was seen to turn.

Standing at a stop, beyond a limit, after running on, or after a run in which it stood, shows nothing: the relay is then
in doubt, until a run in its direction ends as it should, or a person has looked at it. Readings without a supply (the
master is open) do not count. Before the first relay of a run of the program the axis is seen to stand. Knows the
motion, the relays and the supply. Decides nothing.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace

from hw.ports import Direction
from rotator.control.axis.observed_motion import RELAY_S, ObservedMotion
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.run_on import RAN_ON_READINGS, RAN_ON_S, ended_suddenly, goes_on, went_far
from rotator.control.axis.seen_run import END_WINDOWS_S, FED_SHARE, SLOWED_SHARE, STEADY_S, UNSEEN_S, EndedRun, SeenRun
from rotator.control.axis.standing import HeldPlaces, Rest
from rotator.control.axis.trend import Slope
from rotator.status import Trust, Trusts

PLUS, MINUS = Direction.PLUS, Direction.MINUS
DOUBTS_AFTER_S = 0.5
GAP_S = 0.5
"""No command to a relay holds for longer without being renewed."""
LATE_S = 0.2
"""When its latest reading is older, where an axis is has to be reckoned."""
BLIND_S = 1.0
"""So long, in all, an axis may have been driven by short runs that it was not seen to follow."""
BEYOND_DEG = 0.5
"""So far beyond its limit an axis may come to rest: its stop is a degree beyond the limit at least."""
MOVED_DEG = 0.5
"""An axis this far, and four times the noise, from where it stood has been moved."""
COASTS_NOISES, COASTS_S = 5.0, 1.5
"""Two places that differ by so many times the noise are not the same: each is the mean of three readings."""
SHORTEST_WINDOW_S, LONGEST_WINDOW_S = 0.3, 4.5
"""An axis is looked at for so long before it is taken to stand: longer where the readings scatter more."""


class OpeningWatch:
    """Give it every change of the relays (`note_relays`) and every good reading (`see`), in order of time.

    `placed`: the limits are known, and the stops lie beyond them. `look`: nothing has been seen of this axis yet.
    """

    def __init__(self, seen: ObservedMotion, trusts: Trusts, *, placed: bool, look: bool) -> None:
        self._seen = seen
        self._placed = placed
        self._trust = dict(zip((PLUS, MINUS), trusts, strict=True))
        self.looked = not look
        """The axis has been seen to stand in this run of the program."""
        self.ran_on = False
        """It went on at its speed after its relay was switched off."""
        self._going = 0
        """How many readings in a row have shown that."""
        self._held_up = False
        """It went on until something held it."""
        self._run = SeenRun(seen)
        self._supplied_s: float | None = None
        """Since when the motor would have current if a relay were closed; None: it would not."""
        self._unbroken = False
        """There has been a supply ever since the latest run."""
        self._latest: deque[float] = deque(maxlen=3)
        self._resting: deque[float] = deque(maxlen=20)
        """The latest readings without a relay on."""
        self._rest_deg: float | None = None
        """Where the axis stands."""
        self._rested_s: float | None = None
        """Since when it stands."""
        self._seen_s = -math.inf
        """When the latest reading was taken."""
        self._from: Rest | None = None
        """Where it stood when it had last been seen to turn."""
        self._from_here = False
        """It stands there still."""
        self._blind_s = 0.0
        """For how long relays were closed since the axis was last seen to turn."""
        self._lagged_deg: float | None = None
        """Where the axis was when it had fallen behind a motor with current."""
        self._held = HeldPlaces()

    @property
    def trusts(self) -> Trusts:
        return self._trust[PLUS], self._trust[MINUS]

    def trust(self, direction: Direction) -> Trust:
        return self._trust[direction]

    @property
    def measured_dps(self) -> float | None:
        """The slower of the speeds that the latest runs have shown; None: there was none yet."""
        return self._run.measured_dps

    @property
    def place(self) -> str:
        """Where the axis stands, for a person."""
        return f" stands at {self._place_deg:.1f}°" if self._latest and self._placed else ""

    @property
    def unsure(self) -> bool:
        """A relay may be closed, and the axis has stood for so long that its readings will not show that any more."""
        stood = self._rested_s is not None and self._seen_s - self._rested_s >= self._doubts_after_s
        return stood and not {Trust.DOUBTED, Trust.WELDED}.isdisjoint(self.trusts)

    def waits(self, direction: Direction) -> bool:
        """Whether that relay stays open, because the readings have not yet shown that its opposite is open."""
        if not self.looked or self._trust[Direction(-direction)] is not Trust.OPEN:
            return True
        # Only now did it begin to turn the other way: what turns it may be the opposite relay.
        slope = self._seen.trend.slope(self._seen.trend.last_s - END_WINDOWS_S[1])
        fed_dps = FED_SHARE * self._run.motor_dps
        return slope is not None and -slope.speed_dps * direction - 2.0 * slope.rough_dps > fed_dps

    def found_closed(self, direction: Direction) -> None:
        self._trust[direction] = Trust.WELDED
        self.ran_on = True

    def checked(self) -> None:
        """A person has looked at both relays: they are open."""
        self._trust = {PLUS: Trust.OPEN, MINUS: Trust.OPEN}
        self._run.ended, self._blind_s, self.ran_on = None, 0.0, False
        self._held.forget_all()

    def note_relays(self, relays: RelayState, was: RelayState) -> None:
        """The relays have changed; `was`: before."""
        if was.closed:
            self._end(relays.since_s, was.direction, relays.since_s - was.begun_s)
        if relays.closed:
            if self._trust[relays.direction] is Trust.OPEN:
                self._trust[relays.direction] = Trust.UNSEEN
            self._resting.clear()
            self._from_here = False
            self._rest_deg = self._rested_s = self._lagged_deg = None
            self._run.begin()
            self.ran_on, self._held_up, self._going = False, False, 0

    def see(self, at_s: float, angle_deg: float, *, supplied: bool) -> None:
        """A good reading, on the line of the others."""
        self._latest.append(angle_deg)
        gap_s, self._seen_s = at_s - self._seen_s, at_s
        if self._seen.relays.closed:
            # After a long gap the guard has opened the relay: how the run went before it is what counts.
            if gap_s <= GAP_S or self._run.line is None:
                self._see_run(at_s)
        elif not supplied:
            self._supplied_s, self._unbroken = None, False
        else:
            self._supplied_s = at_s if self._supplied_s is None else self._supplied_s
            self._resting.append(angle_deg)
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
            self._blind_s, self._from = 0.0, None
            self._held.turned_to(self._place_deg)
        elif at_s - max(relays.begun_s, run.turned_s) > max(BLIND_S, 1.5 * run.unseen_s):
            self._held.note(relays.direction, self._place_deg)
            self._from = self._from or Rest(self._place_deg, len(self._latest))

    def _end(self, now_s: float, direction: Direction, lasted_s: float) -> None:
        if self._run.line is None:
            self._blind_s += now_s - max(now_s - lasted_s, self._run.turned_s)
        place_deg = self._place_deg if self._latest else 0.0
        if self._run.line is not None and now_s - self._seen_s > LATE_S:
            # Without readings it has gone on with current until now.
            place_deg += self._run.line.speed_dps * (now_s - self._seen_s)
        self._run.end(now_s, direction, lasted_s, place_deg)

    # --- no relay is closed

    def _see_rest(self, at_s: float) -> None:
        ended = self._run.ended
        if ended is not None and ended.line is not None and self._unbroken:
            self._note_slowing(at_s, ended, ended.line)
        if self._stands(at_s):
            self._note_standing(at_s)
        elif self._rest_deg is not None and self._moved_from(self._rest_deg):
            self._note_moved(self._rest_deg)

    def _note_slowing(self, at_s: float, ended: EndedRun, line: Slope) -> None:
        if self.ran_on or self._trust[ended.direction] is Trust.OPEN:
            return
        slope = self._seen.trend.slope(ended.off_s + RELAY_S)
        if slope is None:
            return
        way = PLUS if line.speed_dps > 0 else MINUS
        least_dps = abs(line.speed_dps) - 2.0 * line.rough_dps
        slowed = slope.speed_dps * way + 3.0 * slope.rough_dps < SLOWED_SHARE * least_dps
        passed_s = at_s - ended.off_s
        gone_deg = (self._place_deg - ended.angle_deg) * way
        coasts = not went_far(self._seen, self._run, gone_deg)
        if (slowed and coasts and self._free(way, self._place_deg)) or self._still_coasts(passed_s, gone_deg, line):
            self._trust[ended.direction] = Trust.OPEN
        elif passed_s >= RAN_ON_S and ended.lasted_s >= STEADY_S:
            self._going = self._going + 1 if goes_on(self._seen, line, passed_s, gone_deg) else 0
            self.ran_on = self._going >= RAN_ON_READINGS

    def _still_coasts(self, passed_s: float, gone_deg: float, line: Slope) -> bool:
        """Whether the axis has fallen behind a motor with current, and yet goes on: a stop would have held it there.

        Many readings are compared for it, so it takes more than for one; and none coasts for long.
        """
        if passed_s > COASTS_S:
            return False
        sure_deg = COASTS_NOISES * self._seen.trend.noise_deg
        if self._lagged_deg is None:
            behind_deg = abs(line.speed_dps) * passed_s - gone_deg
            if behind_deg > sure_deg + 3.0 * line.rough_dps * passed_s:
                self._lagged_deg = gone_deg
            return False
        return gone_deg - self._lagged_deg > sure_deg

    def _stands(self, at_s: float) -> bool:
        trend, fed_dps = self._seen.trend, self._run.fed_dps
        window_s = min(max(SHORTEST_WINDOW_S, trend.window_s(fed_dps / 6.0)), LONGEST_WINDOW_S)
        assert self._supplied_s is not None
        from_s = max(self._supplied_s, self._run.ended.off_s if self._run.ended else -math.inf, trend.since_s)
        if at_s - window_s < from_s:
            return False
        slope = trend.slope(at_s - window_s)
        return slope is not None and abs(slope.speed_dps) + slope.rough_dps < fed_dps

    def _note_standing(self, at_s: float) -> None:
        self.looked = True
        if self._rested_s is None:
            self._rested_s = at_s
            self._held_up = self._held_up or ended_suddenly(self._seen, self._run, self._place_deg)
            while len(self._resting) > 3:
                self._resting.popleft()  # it was coasting
        rest = Rest(sum(self._resting) / len(self._resting), len(self._resting))
        creeps_deg = rest.mean_deg - self._rest_deg if self._rest_deg is not None else 0.0
        self._held.creep(creeps_deg)
        self._from = self._from and replace(self._from, mean_deg=self._from.mean_deg + creeps_deg)
        self._rest_deg = rest.mean_deg
        if self._from is None or self._from_here:
            self._from, self._from_here = rest, True
        elif rest.differs(self._from, self._seen.trend.noise_deg):
            if self._moved_from(self._from.mean_deg):
                self._run.turned_s = -math.inf
                # It has left what held it, or its readings had stood still.
                self._held.left(self._place_deg, self._moved_deg)
            self._from, self._from_here, self._blind_s = rest, True, 0.0
        for way in (PLUS, MINUS):
            if self._trust[way] is Trust.OPEN:
                continue
            ended = self._run.ended if self._run.ended and self._run.ended.direction is way else None
            shown = self._followed(ended) if ended else self._trust[way] is Trust.UNSEEN and self._blind_s <= BLIND_S
            if self._trust[way] is Trust.WELDED:
                # The supply may have been switched off by hand: only a run that was seen shows that it opens.
                shown = shown and ended is not None and ended.line is not None
            if shown and not self.ran_on and self._free(way, self._rest_deg):
                self._trust[way] = Trust.OPEN
            elif self._trust[way] is Trust.UNSEEN and at_s - self._rested_s >= self._doubts_after_s:
                self._trust[way] = Trust.DOUBTED
                self._held.note(way, self._rest_deg)

    def _followed(self, ended: EndedRun) -> bool:
        """Whether the axis turned when its latest run ended; after a short run, whether it may have."""
        if ended.line is not None:
            return not self._held_up
        if ended.off_s - ended.lasted_s <= self._run.turned_s < ended.off_s - self._run.unseen_s:
            return False  # in this run it turned at first, and something held it
        return self._blind_s <= max(BLIND_S, 1.5 * self._run.unseen_s)

    @property
    def _doubts_after_s(self) -> float:
        """So long an axis stands before a doubt is raised: more readings may still show that it has moved."""
        return DOUBTS_AFTER_S + 2.0 * (self._run.unseen_s - UNSEEN_S)

    @property
    def _moved_deg(self) -> float:
        return MOVED_DEG + 4.0 * self._seen.trend.noise_deg

    def _moved_from(self, rest_deg: float) -> bool:
        return abs(self._place_deg - rest_deg) > self._moved_deg

    def _note_moved(self, rest_deg: float) -> None:
        """Something turns it, and no relay was closed: the one that would is not taken for open any more."""
        way = PLUS if self._place_deg > rest_deg else MINUS
        self._rest_deg = self._rested_s = None
        if self._trust[way] is Trust.OPEN:
            self._trust[way] = Trust.UNSEEN
        against = Direction(-way)
        if self._trust[against] is Trust.DOUBTED:
            # It has been turned away from what may have held it.
            self._trust[against], self._blind_s, self._run.ended = Trust.UNSEEN, 0.0, None
            self._held.forget(against)

    def _free(self, way: Direction, place_deg: float) -> bool:
        """Whether a motor with current could turn on that way from there."""
        limits = self._seen.limits
        limit_deg = limits.max_deg if way > 0 else limits.min_deg
        placed = not self._placed or (place_deg - limit_deg) * way <= BEYOND_DEG
        return placed and not self._held.hold(way, place_deg)
