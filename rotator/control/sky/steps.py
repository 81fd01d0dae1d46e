"""Plans the steps of an on/off motor along a known path: where it stops, and when it leaves for the next place.

Knows the path of one axis, the weight of an error at each moment, the motor's speed, and the price of a start. Knows
nothing of sensors, relays or the sky.

An on/off motor follows a path in steps: it stands while the target passes by, and then moves on. For an infinitely fast
motor the best steps are the best piecewise constant curve through the path, with a price for each piece. That curve is
found exactly, by dynamic programming over the moments of change (`_pieces`). A beginning of the last piece that costs a
start more than the best one will never become the best again, so it is not tried further: Killick and others, "Optimal
detection of changepoints with a linear computational cost", 2012. A real motor needs time to turn. So each step is then
shifted in time and in place while the error of the real motor becomes smaller (`_Settling`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from rotator.exchange.flight_order import PLAN_STEP_S, Step

LONGEST_S = 240.0
"""The longest piece of the curve. If the motor stands for longer, two pieces have the same place."""
ROUNDS = 5
FIRST_SHIFT_S, FIRST_SHIFT_DEG = 2.0, 1.0
FINER = 1.7
"""The shifts shrink by this factor from round to round."""
SAME_DEG = 1e-6


@dataclass(frozen=True, slots=True)
class Trail:
    """Axis angles every `PLAN_STEP_S` from `begin_s` on, and the weight of an error squared at each of them."""

    begin_s: float
    angles_deg: Sequence[float]
    weights: Sequence[float]


def best_steps(trail: Trail, speed_dps: float, price: float, play_deg: float = 0.0) -> list[Step]:
    """The first step leads to the first place on the path. The motor may leave for it at any time before.

    `price`: the price of a start, in degrees squared times seconds. `play_deg`: the play of the gear between sensor and
    antenna. The place of a step is what the sensor shows when the antenna is at the right place.
    """
    placed: list[Step] = []
    before_deg: float | None = None
    for step in _Settling(trail, speed_dps).settled(_pieces(trail, price)):
        if before_deg is not None and abs(step.place_deg - before_deg) < SAME_DEG:
            continue
        side_deg = 0.0 if before_deg is None else math.copysign(play_deg / 2, step.place_deg - before_deg)
        placed.append(Step(trail.begin_s + step.leave_s, step.place_deg + side_deg))
        before_deg = step.place_deg
    return placed


def _pieces(trail: Trail, price: float) -> list[Step]:
    """The least sum of weighted squared errors and prices over all piecewise constant curves, from time 0 on."""
    base_deg = trail.angles_deg[0]
    shares = [weight * PLAN_STEP_S for weight in trail.weights]
    relative = [angle_deg - base_deg for angle_deg in trail.angles_deg]
    sums = [0.0, *accumulate(shares)]
    firsts = [0.0, *accumulate(share * deg for share, deg in zip(shares, relative, strict=True))]
    seconds = [0.0, *accumulate(share * deg * deg for share, deg in zip(shares, relative, strict=True))]
    longest = int(LONGEST_S / PLAN_STEP_S)
    costs, froms, begins = [0.0], [0], [0]
    for end in range(1, len(relative) + 1):
        total, first, second = sums[end], firsts[end], seconds[end]
        tried = [costs[at] + second - seconds[at] - (first - firsts[at]) ** 2 / (total - sums[at]) for at in begins]
        least = min(tried)
        froms.append(begins[tried.index(least)])
        costs.append(least + price)
        begins = [at for at, cost in zip(begins, tried, strict=True) if cost < least + price and at > end - longest]
        begins.append(end)
    steps, end = [], len(relative)
    while end:
        begin = froms[end]
        mean_deg = base_deg + (firsts[end] - firsts[begin]) / (sums[end] - sums[begin])
        steps.append(Step(begin * PLAN_STEP_S, mean_deg))
        end = begin
    return steps[::-1]


@dataclass(frozen=True, slots=True)
class _Move:
    """From one place to another, half of it before `middle_s`."""

    middle_s: float
    from_deg: float
    to_deg: float

    def begins_s(self, speed_dps: float) -> float:
        return self.middle_s - abs(self.to_deg - self.from_deg) / speed_dps / 2

    def ends_s(self, speed_dps: float) -> float:
        return self.middle_s + abs(self.to_deg - self.from_deg) / speed_dps / 2

    def joined(self, later: _Move) -> _Move:
        """Both moves as one. Its middle is between their middles, nearer to that of the longer move."""
        size_deg, later_deg = abs(self.to_deg - self.from_deg), abs(later.to_deg - later.from_deg)
        share = later_deg / (size_deg + later_deg) if size_deg + later_deg else 0.0
        return _Move(self.middle_s + share * (later.middle_s - self.middle_s), self.from_deg, later.to_deg)


class _Settling:
    """Shifts steps until the error of a motor of this speed is least. Moments count from the beginning of the trail."""

    def __init__(self, trail: Trail, speed_dps: float) -> None:
        self._trail = trail
        self._speed_dps = speed_dps
        self._steps: list[Step] = []

    def settled(self, pieces: Sequence[Step]) -> list[Step]:
        self._steps = self._on_the_way(pieces)
        shift_s, shift_deg = FIRST_SHIFT_S, FIRST_SHIFT_DEG
        for _ in range(ROUNDS):
            for index, _ in enumerate(self._steps):
                error = self._error_around(index)
                for by_s, by_deg in ((shift_s, 0.0), (-shift_s, 0.0), (0.0, shift_deg), (0.0, -shift_deg)):
                    error = self._shift(index, by_s, by_deg, error)
            shift_s, shift_deg = shift_s / FINER, shift_deg / FINER
        return self._steps

    def _on_the_way(self, pieces: Sequence[Step]) -> list[Step]:
        """Half of each move lies before the moment at which an infinitely fast motor would jump."""
        moves: list[_Move] = []
        for at, to in pairwise(pieces):
            move = _Move(to.leave_s, at.place_deg, to.place_deg)
            # A slow motor has not ended one move when it must begin the next: they become one.
            while moves and moves[-1].ends_s(self._speed_dps) >= move.begins_s(self._speed_dps):
                move = moves.pop().joined(move)
            moves.append(move)
        begun = [Step(max(0.0, move.begins_s(self._speed_dps)), move.to_deg) for move in moves]
        first = pieces[0] if not begun or begun[0].leave_s > pieces[0].leave_s else begun.pop(0)
        return [first, *begun]

    def _shift(self, index: int, by_s: float, by_deg: float, error: float) -> float:
        """Shift one step. Take that back if the error around it does not fall. Returns the error then."""
        before = self._steps[index]
        after = Step(before.leave_s + by_s, before.place_deg + by_deg)
        earliest_s = self._steps[index - 1].leave_s if index else -math.inf
        end_s = PLAN_STEP_S * len(self._trail.angles_deg)
        latest_s = self._steps[index + 1].leave_s if index + 1 < len(self._steps) else end_s
        if (by_s and not index) or not earliest_s < after.leave_s < latest_s:
            return error
        self._steps[index] = after
        shifted_error = self._error_around(index)
        if shifted_error < error:
            return shifted_error
        self._steps[index] = before
        return error

    def _error_around(self, index: int) -> float:
        """The weighted squared error from the step before this one to the second step after it."""
        steps, travel_deg = self._steps, self._speed_dps * PLAN_STEP_S
        angles_deg, weights = self._trail.angles_deg, self._trail.weights
        angle_deg = steps[max(0, index - 2)].place_deg
        error = 0.0
        for at in range(max(0, index - 1), min(index + 2, len(steps))):
            place_deg = steps[at].place_deg
            begin, end = self._moment(at), self._moment(at + 1)
            for moment in range(begin, end):
                off_deg = angles_deg[moment] - angle_deg
                error += weights[moment] * off_deg * off_deg
                ahead_deg = place_deg - angle_deg
                if ahead_deg > travel_deg:
                    angle_deg += travel_deg
                elif ahead_deg < -travel_deg:
                    angle_deg -= travel_deg
                else:
                    angle_deg = place_deg
        return error

    def _moment(self, at: int) -> int:
        """The first moment of the trail at which this step is in force; behind the last step, the trail's end."""
        if at == len(self._steps):
            return len(self._trail.angles_deg)
        return math.ceil(self._steps[at].leave_s / PLAN_STEP_S)
