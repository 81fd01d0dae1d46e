"""The judges of the current in a motor: through a relay that has welded, and in a motor that does not turn.

Knows the truth of an axis, and the orders in force. Never asks the box. The other lines of the table are in `judges`.
"""

from __future__ import annotations

import math
from collections import deque

from benchmarks.drills.accusations import AFTER_STOP, LOOK_S, STANDING_CURRENT, Violation
from benchmarks.drills.axis_case import START_S, WELDED_S, AxisCase
from benchmarks.drills.orders import Orders
from benchmarks.drills.world import AxisTruth

TRIES, TRIES_WITHIN_S = 3, 600.0
GOING_SHARE = 0.1
ALONE_S = 12.0
"""Programs may press an axis that was never set up for this time in all without moving it: a press that meets its stop,
one in which its readings settle, 4.5 s of further ones, and the rest of the last."""


class Currents:
    """What all judges keep, and those of the current."""

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
