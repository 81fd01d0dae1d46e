"""What may never happen in the simulated world: one judge for each line of the table, over both axes.

Knows the truth (`world`) and the orders in force (`orders`). Never asks the box. A judge accuses only where physics and
the script leave no excuse: the wind, a hand, a welded contact without a master, a sensor that lies without a trace.
"""

from __future__ import annotations

import math
from collections import deque

from benchmarks.drills.accusations import (
    AFTER_STOP,
    AWAY,
    BEYOND,
    BOTH_FED,
    BRAKED,
    LOOK_S,
    NO_ORDER,
    NOT_FITTED,
    SPED,
    STANDING_CURRENT,
    STARTS,
    Violation,
)
from benchmarks.drills.axis_case import COUNTED_PERIODS, START_S, WELDED_S, AxisCase
from benchmarks.drills.goals import AxisOrders, Goal
from benchmarks.drills.orders import Orders
from benchmarks.drills.world import AxisTruth

BEYOND_S = 2.0
SPED_S = 2.0
STOP_S = 0.3
AWAY_S = 2.0
LEASE_S = 0.5
MET_S = 0.7
"""An axis that stops this soon after its relay opened may have coasted to rest: the box need not see a weld."""
FAR_DEG = 10.0
CHATTER_S, CHATTER_STARTS, STARTS_AN_ORDER = 10.0, 20, 2
"""An order starts each axis once. More than `CHATTER_STARTS` further starts within `CHATTER_S` are chatter."""
TRIES, TRIES_WITHIN_S = 3, 600.0
GOING_SHARE = 0.1
ALONE_S = 12.0
"""Programs may press an axis that was never set up for this time in all without moving it: a press that meets its stop,
one in which its readings settle, 4.5 s of further ones, and the rest of the last."""


class Judges:
    """Call `look` after every cycle."""

    def __init__(self, cases: tuple[AxisCase, AxisCase], orders: Orders, *, master: bool) -> None:
        self.cases = cases
        self._orders = orders
        self._master = master
        self._acknowledged_s = self._ended_s = self._released_s = self._pressed_s = 0.0
        self._now_s = self._past_s = 0.0
        self.unattended_s = math.inf
        """Since when the control thread does not run, or the program is dead; infinite: it runs."""
        self.ends_at_once = True
        """Whether the death of the program ends motion. False: the chips keep their last order."""
        self.goes_round = False
        """Forbidden sectors lie in the way: an axis may have to move away from its target first."""
        self.excused_until_s = 0.0
        """Until this moment the hardware moves by itself, as after a dip of its supply."""
        self.found: list[Violation] = []
        self._told: set[tuple[str, str]] = set()
        self._starts: deque[tuple[float, int]] = deque()
        """For each look of the last CHATTER_S: its moment, and the relay starts beyond those that orders ask for."""

    def look(self, now_s: float, axes: list[AxisTruth]) -> None:
        self._past_s, self._now_s = now_s - self._now_s, now_s
        stops_s = self._orders.stops.acknowledged_s, self._orders.ended_at_s
        if stops_s != (self._acknowledged_s, self._ended_s):
            program_ended = self._ended_s != self._orders.ended_at_s
            self._acknowledged_s, self._ended_s = stops_s
            for truth, case in zip(axes, self.cases, strict=True):
                if program_ended:
                    case.weld_forgotten()
                case.stopped(now_s if truth.relayed else now_s + truth.coasts_s + START_S)
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
                excused = truth.welded and (on_purpose or met or case.blind)
                if not excused:
                    self._accuse(BOTH_FED, truth, f"for {truth.shorted_s - case.shorted_s:.3f} s")
                case.shorted_s = truth.shorted_s
            # A welded contact feeds its motor, whatever the box does with its brake; wind or a hand turns an axis that
            # counts slower than its contact shows.
            harm = truth.braked_s, truth.jolts
            if harm != case.brake_harm and not (truth.welded or truth.pushed):
                self._accuse(BRAKED, truth, f"{truth.braked_s:.2f} s against it, {truth.jolts} jolts")
            case.brake_harm = harm
            self._sped(truth, case)
            if truth.power and not case.fitted:
                self._accuse(NOT_FITTED, truth, "")
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

    def _sped(self, truth: AxisTruth, case: AxisCase) -> None:
        left_on = truth.sped and not truth.coil and self._now_s <= self.unattended_s
        case.sped_s = case.sped_s + self._past_s if left_on else 0.0
        if case.sped_s > SPED_S:
            self._accuse(SPED, truth, f"for {case.sped_s:.1f} s")

    def count(self, relay_starts: int | None) -> None:
        """Accuse a motor that starts and stops several times a second without an order."""
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
        excused = self._now_s < self.excused_until_s or case.astray or case.unheard or case.runs_down
        excused = excused or (self._now_s > self.unattended_s and not self.ends_at_once)
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
        felt = truth.relayed and case.feels and not case.counts
        if truth.at_stop != truth.power or not felt or case.drifts or pressed:
            return
        case.at_stops_s += self._past_s
        if case.at_stops_s > TRIES * max(BEYOND_S, case.patience_s) + LOOK_S:
            self._accuse(BEYOND, truth, f"{case.at_stops_s:.2f} s since a person let it go, at {truth.shaft_deg:.1f}°")

    def _away(self, truth: AxisTruth, case: AxisCase, orders: AxisOrders) -> None:
        goals, here_deg = orders.goals.values(), truth.shaft_deg + case.shift_deg
        # An order that the other axis cannot follow is refused, and the order before it goes on.
        refused = any(other.stalls or other.befallen for other in self.cases if other is not case)
        plain = not (self.goes_round or refused) and case.trusted
        known = plain and goals and all(goal.angles_deg for goal in goals)
        slack_deg = 2.0 * case.tolerance_deg + case.slack_deg
        if not known or any(self._nearing(goal, here_deg, truth.power, slack_deg) for goal in goals):
            case.away_s = 0.0
            return
        case.away_s += self._past_s
        if case.away_s > max(AWAY_S, case.deaf_s) + case.beside_s(truth.full_dps) + LOOK_S:
            angles_deg = [angle_deg for goal in goals for angle_deg in goal.angles_deg]
            nearest_deg = min(angles_deg, key=lambda angle_deg: abs(angle_deg - here_deg))
            measured = f"for {case.away_s:.2f} s, at {here_deg:.1f}°, the target is {nearest_deg:.1f}°"
            self._accuse(AWAY, truth, measured)

    @staticmethod
    def _nearing(goal: Goal, here_deg: float, way: float, slack_deg: float = 0.0) -> bool:
        """Whether an axis that turns that way comes nearer to one of the goal's angles, or is past it by the slack."""
        return any((angle_deg - here_deg) * way > -slack_deg for angle_deg in goal.angles_deg)

    def elsewhere(self, axes: list[AxisTruth]) -> frozenset[str]:
        """The axes that stand far from the angles of all orders in force for them."""
        return frozenset(
            truth.name
            for truth, case in zip(axes, self.cases, strict=True)
            if self._orders.holds(truth.name) and not self.goes_round and self._far(truth, case)
        )

    def coming(self, axes: list[AxisTruth]) -> frozenset[str]:
        """The axes that turn to where an order in force may send them."""
        return frozenset(
            truth.name
            for truth, case in zip(axes, self.cases, strict=True)
            if self._orders.holds(truth.name)
            for goal in self._orders.axes[truth.name].goals.values()
            if not goal.angles_deg or self._nearing(goal, truth.shaft_deg + case.shift_deg, truth.speed_dps)
        )

    def _far(self, truth: AxisTruth, case: AxisCase) -> bool:
        goals, here_deg = self._orders.axes[truth.name].goals.values(), truth.shaft_deg + case.shift_deg
        far_deg = FAR_DEG + case.tolerance_deg + case.slack_deg
        places_deg = [place_deg for goal in goals for place_deg in goal.angles_deg]
        return all(goal.angles_deg for goal in goals) and all(abs(place - here_deg) > far_deg for place in places_deg)

    def _welded(self, truth: AxisTruth, case: AxisCase) -> None:
        turns = abs(truth.speed_dps) >= GOING_SHARE * truth.full_dps
        if truth.welded and truth.coil:
            return  # what it did in the pauses before is not forgotten
        if truth.coil or not truth.power or not self._master or not turns or case.blind:
            case.welded_s = 0.0
            return
        case.welded_s += self._past_s
        if case.welded_s > max(WELDED_S, case.patience_s) + LOOK_S:
            self._accuse(AFTER_STOP, truth, f"by a welded relay for {case.welded_s:.2f} s, with a master")

    def _fed(self, truth: AxisTruth, case: AxisCase) -> None:
        """Accuse a supply that is switched on again and again, for the other axis, while a known weld feeds a motor."""
        if not truth.welded or not self._master or case.blind or case.counts:
            case.weld_forgotten()
            return
        if truth.coil:
            return
        turns = abs(truth.speed_dps) >= GOING_SHARE * truth.full_dps
        case.weld_feeds(self._past_s, fed=truth.power != 0, turns=turns)
        if case.fed_s > max(WELDED_S, case.patience_s) + LOOK_S:
            self._accuse(STANDING_CURRENT, truth, f"through a welded relay that had shown, for {case.fed_s:.2f} s")

    def _watched(self, truth: AxisTruth, case: AxisCase) -> bool:
        """Whether a person sets this axis up, and no limit switch shows its present place."""
        return truth.name == self._orders.lacking and truth.at_stop not in case.shown_ends

    def _standing(self, truth: AxisTruth, case: AxisCase) -> None:
        drives_itself = case.astray and not truth.relayed
        if not case.feels or drives_itself or not truth.stands or self._is_there(truth, case):
            case.standing_s = case.stood_s = case.pressed_s = 0.0
            return
        before_s, case.standing_s = case.standing_s, case.standing_s + self._past_s
        if case.counts and not self._orders.axes[truth.name].homes and case.standing_s > START_S:
            case.stood_s += self._past_s
        tried = case.stood_s > case.patience_s if case.counts else before_s <= START_S < case.standing_s
        # A person who sets the axis up watches it: each press counts for itself.
        pressed = self._watched(truth, case)
        winds_down = self._now_s < case.winds_down_s
        if tried and not pressed and not winds_down and self._orders.holds(truth.name):
            case.stood_s = 0.0
            case.tries_s.append(self._now_s)
            while case.tries_s[0] < self._now_s - TRIES_WITHIN_S:
                case.tries_s.popleft()
            if len(case.tries_s) > TRIES:
                tries = f"{len(case.tries_s)} tries in {TRIES_WITHIN_S / 60:.0f} minutes"
                self._accuse(STANDING_CURRENT, truth, tries)
        # A moving target may have passed the standing axis: meanwhile nothing showed that it does not follow.
        goals = self._orders.axes[truth.name].goals.values()
        passes_by = not truth.relayed and any(not goal.angles_deg and not goal.way for goal in goals)
        if case.standing_s > case.patience_s * (2.0 if passes_by else 1.0) + LOOK_S:
            self._accuse(STANDING_CURRENT, truth, f"for {case.standing_s:.2f} s")

    def _alone(self, truth: AxisTruth, case: AxisCase) -> None:
        """Accuse programs that press an axis on and on which was never set up, does not move, and has no person."""
        left_alone = truth.name == self._orders.lacking and not self._orders.attended
        if not left_alone or case.counts or case.drifts or self._orders.by_person(truth.name):
            case.alone_s = 0.0
            return
        case.alone(self._past_s, truth.shaft_deg, stands=truth.stands)
        if case.alone_s > ALONE_S:
            self._accuse(STANDING_CURRENT, truth, f"never set up, and left alone, for {case.alone_s:.2f} s in all")

    def there(self, axes: list[AxisTruth]) -> frozenset[str]:
        """The axes whose control box has arrived, as far as the box can see."""
        pairs = zip(axes, self.cases, strict=True)
        return frozenset(truth.name for truth, case in pairs if self._is_there(truth, case))

    def _is_there(self, truth: AxisTruth, case: AxisCase) -> bool:
        """Whether the motor follows a set point, and the box sees the axis there: then nothing shows its current.

        Round a sector, or in a pass, the box sends the axis to angles that no order names.
        """
        near_deg, here_deg = case.tolerance_deg + case.slack_deg, truth.shaft_deg + case.shift_deg
        goals = self._orders.axes[truth.name].goals.values()
        places_deg = [angle_deg for goal in goals for angle_deg in goal.angles_deg]
        # A stop sends it to where it stands, whether or not its chip hears that.
        stopped = case.deaf and not self._orders.holds(truth.name)
        there = self.goes_round or stopped or any(abs(place_deg - here_deg) < near_deg for place_deg in places_deg)
        return not truth.relayed and (there or abs(truth.sent_deg - truth.shaft_deg) < near_deg)

    def _accuse(self, judge: str, truth: AxisTruth, measured: str) -> None:
        if (judge, truth.name) not in self._told:
            self._told.add((judge, truth.name))
            self.found.append(Violation(self._now_s, judge, truth.name, measured))
