"""The steps of an on/off motor along a path that is known to its end: the best places, and the best moments to leave.

Knows one axis's path, what an error weighs at each moment, how fast the motor is, and the price of a start. Knows
nothing of sensors, relays or the sky.

An on/off motor follows a path in steps: it stands, lets the target drift past, and moves on. Without the motor's speed,
the best steps are the best piecewise constant curve through the path with a price for each piece; that is found exactly,
by dynamic programming over the moments of change (`_pieces`). A motor takes its time, so each step is then shifted in
time and place, a little at a time, for as long as the error along the motor's real way falls (`_settled`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from rotator.orders import PLAN_STEP_S, Step

GRID_S = PLAN_STEP_S
LONGEST_S = 240.0
"""No motor stands still for longer while its target moves by more than nothing."""
HOPELESS = 50.0
"""A piece whose error has cost so many starts is not made longer."""
ROUNDS = 5
FIRST_SHIFT_S, FIRST_SHIFT_DEG = 2.0, 1.0
FINER = 1.7
"""How the shifts shrink from round to round."""


@dataclass(frozen=True, slots=True)
class Trail:
    """Axis angles every `GRID_S` from `begin_s` on, and the weight of an error squared there."""

    begin_s: float
    angles_deg: Sequence[float]
    weights: Sequence[float]


def best_steps(trail: Trail, speed_dps: float, price: float, play_deg: float = 0.0) -> list[Step]:
    """The first step leads to where the path is met first; the motor may set off for it at any time before.

    `price`: what a start is worth, in degrees squared times seconds. `play_deg`: of the gear between the sensor and the
    antenna; a place is where the sensor is to be for the antenna to be right.
    """
    steps = _settled(_pieces(trail, price), trail, speed_dps)
    placed, before_deg = [], None
    for step in steps:
        side = 0.0 if before_deg is None else math.copysign(play_deg / 2, step.place_deg - before_deg)
        placed.append(Step(trail.begin_s + step.leave_s, step.place_deg + side))
        before_deg = step.place_deg
    return placed


def _pieces(trail: Trail, price: float) -> list[Step]:
    """The least sum of weighted squared errors and prices, over all piecewise constant curves."""
    shares = [weight * GRID_S for weight in trail.weights]
    base_deg = trail.angles_deg[0]
    relative = [angle_deg - base_deg for angle_deg in trail.angles_deg]
    sums = [0.0, *accumulate(shares)]
    firsts = [0.0, *accumulate(share * deg for share, deg in zip(shares, relative, strict=True))]
    seconds = [0.0, *accumulate(share * deg * deg for share, deg in zip(shares, relative, strict=True))]
    longest = int(LONGEST_S / GRID_S)
    costs, froms = [0.0], [0]
    for end in range(1, len(relative) + 1):
        least, start = math.inf, end - 1
        hopeless = HOPELESS * price
        for begin in range(end - 1, max(-1, end - longest - 1), -1):
            first = firsts[end] - firsts[begin]
            error = seconds[end] - seconds[begin] - first * first / (sums[end] - sums[begin])
            if error > hopeless:
                break
            if costs[begin] + error < least:
                least, start = costs[begin] + error, begin
        costs.append(least + price)
        froms.append(start)
    steps, end = [], len(relative)
    while end:
        begin = froms[end]
        place_deg = base_deg + (firsts[end] - firsts[begin]) / (sums[end] - sums[begin])
        steps.append(Step(begin * GRID_S, place_deg))
        end = begin
    return steps[::-1]


def _settled(steps: list[Step], trail: Trail, speed_dps: float) -> list[Step]:
    """The steps shifted to where a motor of this speed, which leaves earlier than it arrives, errs least."""
    # Half of a move lies before the moment at which a motor without mass would jump.
    steps = [
        steps[0],
        *(
            Step(max(0.0, b.leave_s - abs(b.place_deg - a.place_deg) / speed_dps / 2), b.place_deg)
            for a, b in pairwise(steps)
        ),
    ]
    steps = [step for step, after in pairwise(steps) if step.leave_s < after.leave_s] + steps[-1:]
    shift_s, shift_deg = FIRST_SHIFT_S, FIRST_SHIFT_DEG
    for _ in range(ROUNDS):
        for index in range(len(steps)):
            for by_s, by_deg in ((shift_s, 0.0), (-shift_s, 0.0), (0.0, shift_deg), (0.0, -shift_deg)):
                _shift(steps, index, by_s, by_deg, trail, speed_dps)
        shift_s, shift_deg = shift_s / FINER, shift_deg / FINER
    return steps


def _shift(steps: list[Step], index: int, by_s: float, by_deg: float, trail: Trail, speed_dps: float) -> None:
    """Keep the shift if the error around the step falls by it."""
    if by_s and index == 0:
        return
    before = steps[index]
    after = Step(before.leave_s + by_s, before.place_deg + by_deg)
    if index and after.leave_s <= steps[index - 1].leave_s:
        return
    if index + 1 < len(steps) and after.leave_s >= steps[index + 1].leave_s:
        return
    cost = _cost_around(steps, index, trail, speed_dps)
    steps[index] = after
    if _cost_around(steps, index, trail, speed_dps) >= cost:
        steps[index] = before


def _cost_around(steps: list[Step], index: int, trail: Trail, speed_dps: float) -> float:
    """The error from the step before to the second step after, along the motor's way."""
    first = max(0, index - 1)
    angle_deg = steps[first].place_deg
    begin = math.ceil(steps[first].leave_s / GRID_S) if first else 0
    # The motor may be on its way to the first place when the time begins: its step counts from where it comes from.
    if first:
        angle_deg = steps[first - 1].place_deg
    until = index + 2
    end = math.ceil(steps[until].leave_s / GRID_S) if until < len(steps) else len(trail.angles_deg)
    travel_deg = speed_dps * GRID_S
    cost, at = 0.0, first
    for moment in range(begin, end):
        while at + 1 < len(steps) and steps[at + 1].leave_s <= moment * GRID_S:
            at += 1
        off_deg = trail.angles_deg[moment] - angle_deg
        cost += trail.weights[moment] * off_deg * off_deg
        left_deg = steps[at].place_deg - angle_deg
        angle_deg += max(-travel_deg, min(travel_deg, left_deg))
    return cost
