"""What may never happen in the simulated world: one judge for each line of the table, over both axes.

Knows the truth (`world`) and the orders in force (`orders`). Never asks the box. A judge accuses only where physics and
the script leave no excuse: the wind, a hand, a welded contact without a master, a sensor that lies without a trace.
"""

from __future__ import annotations

from benchmarks.drills.accusations import AFTER_STOP, AWAY, BEYOND, BOTH_FED, LOOK_S, NO_ORDER, STARTS, Violation
from benchmarks.drills.axis_case import COUNTED_PERIODS, START_S, AxisCase
from benchmarks.drills.currents import TRIES, Currents
from benchmarks.drills.goals import AxisOrders, Goal
from benchmarks.drills.world import AxisTruth

BEYOND_S = 2.0
STOP_S = 0.3
AWAY_S = 2.0
LEASE_S = 0.5
STREAM_LEAD_S = 5.0
MET_S = 0.7
"""An axis that stops this soon after its relay opened may have coasted to rest: the box need not see a weld."""
FAR_DEG = 10.0
CHATTER_S, CHATTER_STARTS, STARTS_AN_ORDER = 10.0, 20, 2
"""An order starts each axis once. More than `CHATTER_STARTS` further starts within `CHATTER_S` are chatter."""


class Judges(Currents):
    """Call `look` after every cycle."""

    def look(self, now_s: float, axes: list[AxisTruth]) -> None:
        self._past_s, self._now_s = now_s - self._now_s, now_s
        stops_s = self._orders.stops.acknowledged_s, self._orders.ended_at_s
        if stops_s != (self._acknowledged_s, self._ended_s):
            program_ended = self._ended_s != self._orders.ended_at_s
            self._acknowledged_s, self._ended_s = stops_s
            for truth, case in zip(axes, self.cases, strict=True):
                if program_ended:
                    case.weld_forgotten()
                case.beyond_s = case.standing_s = 0.0  # the next order is a new try, also if the current never stopped
                case.winds_down_s = now_s if truth.relayed else now_s + truth.coasts_s + START_S
        if self._orders.stops.released_s != self._released_s:
            self._released_s = self._orders.stops.released_s
            for case in self.cases:
                case.tries_s.clear()
                case.at_stops_s = case.alone_s = 0.0
        pressed, self._pressed_s = self._orders.button.pressed_s != self._pressed_s, self._orders.button.pressed_s
        for truth, case in zip(axes, self.cases, strict=True):
            if pressed and self._watched(truth, case):
                case.press()
            if truth.shorted_s > case.shorted_s:
                # While an axis presses against its stop, nothing shows that its relay has welded: when it homes, for a
                # moment of each run of a counted axis, and in a calibration, where a person watches.
                unseen = case.counts and not case.trusted and case.pressed_s < case.patience_s / COUNTED_PERIODS
                homes = self._orders.axes[truth.name].homes
                held = (case.misplaced and truth.at_stop) or case.stalls
                met = held and case.pressed_s < case.patience_s and case.ran_on_s < MET_S
                on_purpose = truth.at_stop and (homes or unseen or self._orders.attended)
                excused = truth.welded and (on_purpose or met)
                if not excused:
                    self._accuse(BOTH_FED, truth, f"for {truth.shorted_s - case.shorted_s:.3f} s")
                case.shorted_s = truth.shorted_s
            self._welded(truth, case)
            self._fed(truth, case)
            if not truth.welded or (truth.coil and truth.coil == truth.power):
                case.ran_on_s = 0.0
            elif not truth.stands:
                case.ran_on_s += self._past_s
            if not (truth.power and truth.coil) or (case.deaf and truth.at_stop):
                case.rest(at_stop=truth.at_stop != 0)
                continue
            orders = self._orders.axes[truth.name]
            orders.turned(now_s, truth.coil, self._past_s)
            self._unordered(truth, case)
            self._standing(truth, case)
            self._alone(truth, case)
            if not orders.homes:  # when an axis homes, a person watches it touch its stop
                self._beyond(truth, case)
                self._away(truth, case, orders)

    def count(self, relay_starts: int | None) -> None:
        """Accuse a motor that starts and stops several times a second without an order. This needs no twin drill."""
        if relay_starts is None:
            return
        due = relay_starts - STARTS_AN_ORDER * self._orders.heard
        self._starts.append((self._now_s, due))
        while self._starts[0][0] < self._now_s - CHATTER_S:
            self._starts.popleft()
        if (more := due - self._starts[0][1]) > CHATTER_STARTS and (STARTS, "both axes") not in self._told:
            self._told.add((STARTS, "both axes"))
            measured = f"{more} in {CHATTER_S:g} s beyond those that orders ask for"
            self.found.append(Violation(self._now_s, STARTS, "both axes", measured))

    def _unordered(self, truth: AxisTruth, case: AxisCase) -> None:
        winds_down_s = STOP_S + LOOK_S + (0.0 if truth.relayed else truth.coasts_s) + case.deaf_s
        winds_down_s += case.beside_s(truth.full_dps)
        excused = self._now_s < self.excused_until_s or case.astray
        if self._now_s > self.unattended_s + LEASE_S + winds_down_s and self.ends_at_once and not excused:
            self._accuse(AFTER_STOP, truth, f"driven {self._now_s - self.unattended_s:.2f} s after the last lease")
        if self._orders.holds(truth.name) or excused:
            case.idle_s = 0.0
            return
        case.idle_s += self._past_s
        if case.idle_s > winds_down_s:
            last_s = self._orders.ended_s(truth.name)
            judge = AFTER_STOP if self._orders.stops.latched or last_s else NO_ORDER
            self._accuse(judge, truth, f"driven for {case.idle_s:.2f} s; its last order ended at {last_s:.2f} s")

    def _beyond(self, truth: AxisTruth, case: AxisCase) -> None:
        if case.astray:
            return
        over_deg = case.slack_deg + case.tolerance_deg
        beyond_deg = truth.shaft_deg - case.high_deg if truth.power > 0 else case.low_deg - truth.shaft_deg
        if truth.at_stop != truth.power and not (case.trusted and beyond_deg > over_deg):
            return
        case.beyond_s += self._past_s
        self._again(truth, case)
        if case.beyond_s > max(BEYOND_S, case.patience_s) + LOOK_S:
            self._accuse(BEYOND, truth, f"{case.beyond_s:.2f} s in all, at {truth.shaft_deg:.1f}°")

    def _again(self, truth: AxisTruth, case: AxisCase) -> None:
        """Accuse an axis that is driven against a stop again before a person has released it.

        A stop from a link and a restart release nothing. Within the range the first time may be ice.
        """
        pressed = self._watched(truth, case)
        if truth.at_stop != truth.power or not truth.relayed or case.counts or case.drifts or pressed:
            return
        case.at_stops_s += self._past_s
        if case.at_stops_s > TRIES * max(BEYOND_S, case.patience_s) + LOOK_S:
            self._accuse(BEYOND, truth, f"{case.at_stops_s:.2f} s since a person let it go, at {truth.shaft_deg:.1f}°")

    def _away(self, truth: AxisTruth, case: AxisCase, orders: AxisOrders) -> None:
        goals, here_deg = orders.goals.values(), truth.shaft_deg + case.shift_deg
        known = not self.goes_round and case.trusted and goals and all(goal.angles_deg for goal in goals)
        if not known or any(self._nearing(goal, here_deg, truth, case) for goal in goals):
            case.away_s = 0.0
            return
        case.away_s += self._past_s
        if case.away_s > max(AWAY_S, case.deaf_s) + case.beside_s(truth.full_dps) + LOOK_S:
            angles_deg = [angle_deg for goal in goals for angle_deg in goal.angles_deg]
            nearest_deg = min(angles_deg, key=lambda angle_deg: abs(angle_deg - here_deg))
            measured = f"for {case.away_s:.2f} s, at {here_deg:.1f}°, the target is {nearest_deg:.1f}°"
            self._accuse(AWAY, truth, measured)

    @staticmethod
    def _nearing(goal: Goal, here_deg: float, truth: AxisTruth, case: AxisCase) -> bool:
        """Whether the axis moves towards one of the goal's angles, or is near it. The target of a stream is a few
        seconds ahead."""
        slack_deg = 2.0 * case.tolerance_deg + case.slack_deg + STREAM_LEAD_S * goal.rate_dps
        places_deg = (*goal.angles_deg, *goal.ends_deg)
        return any((angle_deg - here_deg) * truth.power > -slack_deg for angle_deg in places_deg)

    def elsewhere(self, axes: list[AxisTruth]) -> frozenset[str]:
        """The axes that stand far from the angles of all orders in force for them."""
        return frozenset(
            truth.name
            for truth, case in zip(axes, self.cases, strict=True)
            if self._orders.holds(truth.name) and not self.goes_round and self._far(truth, case)
        )

    def _far(self, truth: AxisTruth, case: AxisCase) -> bool:
        goals, here_deg = self._orders.axes[truth.name].goals.values(), truth.shaft_deg + case.shift_deg
        far_deg = FAR_DEG + case.tolerance_deg + case.slack_deg
        places_deg = [place_deg for goal in goals for place_deg in (*goal.angles_deg, *goal.ends_deg)]
        return all(goal.angles_deg for goal in goals) and all(abs(place - here_deg) > far_deg for place in places_deg)
