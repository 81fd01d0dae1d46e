"""Where a switched axis should stand next, and when it should set off: pointing error traded against relay starts.

Knows one axis's path over the next minute and how fast its motor is. Knows nothing of sensors, relays or the sky.

An on/off motor follows a moving target in steps: it stands, lets the target drift through its window, and moves past
it. A step costs one start. The best place to stand for a while is the mean of the path over that while; the best while
is the one whose mean cost (squared error and the price of a start) is least; and the best moment to leave is when the
target is midway between the old place and the new, at half the travel time from now, so that a motor slower than the
sky sets off early. For a target at a steady rate the window comes out as the cube root of the rate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

PRICE = 3.3
"""Degrees squared times seconds that a start is worth, for a tolerance of one degree; it grows with the cube."""

OFFSETS_S = (*(0.5 * i for i in range(20)), *(10.0 + 2.0 * i for i in range(26)))
"""The moments at which a path is looked at: close together first, to a minute ahead."""
_WIDTHS_S = (*(b - a for a, b in pairwise(OFFSETS_S)), 2.0)

_ROUNDS = 3
_HOPELESS = 1.5
"""Where the mean cost has grown this much past its least it will not fall again."""


@dataclass(frozen=True, slots=True)
class Path:
    """Axis angles at `OFFSETS_S` from `at_s`, and the weight of an error squared there (cosine squared, in azimuth)."""

    at_s: float
    angles_deg: Sequence[float]
    weights: Sequence[float]

    def angle_deg(self, moment_s: float) -> float:
        index, share = self._place(moment_s)
        return self.angles_deg[index] * (1 - share) + self.angles_deg[index + 1] * share

    def weight(self, moment_s: float) -> float:
        index, share = self._place(moment_s)
        return self.weights[index] * (1 - share) + self.weights[index + 1] * share

    def _place(self, moment_s: float) -> tuple[int, float]:
        offset_s = min(max(moment_s - self.at_s, 0.0), OFFSETS_S[-1])
        index = int(offset_s / 0.5) if offset_s < 10.0 else 20 + int((offset_s - 10.0) / 2.0)
        index = min(index, len(OFFSETS_S) - 2)
        return index, (offset_s - OFFSETS_S[index]) / _WIDTHS_S[index]


def next_place_deg(path: Path, angle_deg: float, speed_dps: float, tolerance_deg: float, start_s: float = 0.0) -> float:
    """Where to stand after the next move, if it were ordered now. `start_s`: how long a start takes."""
    price = PRICE * tolerance_deg**3
    place_deg = path.angles_deg[0]
    for _ in range(_ROUNDS):
        place_deg = _best_place_deg(path, start_s + abs(place_deg - angle_deg) / speed_dps / 2, price)
    return place_deg


def _best_place_deg(path: Path, from_s: float, price: float) -> float:
    """The mean of the path from `from_s` on, over the while with the least mean cost."""
    weight_sum = first_sum = second_sum = lasted_s = 0.0
    best_cost, best_deg = float("inf"), path.angles_deg[0]
    base_deg = path.angles_deg[0]
    for offset_s, width_s, angle_deg, weight in zip(OFFSETS_S, _WIDTHS_S, path.angles_deg, path.weights, strict=True):
        if offset_s + width_s <= from_s and offset_s < OFFSETS_S[-1]:
            continue
        share = weight * width_s
        relative_deg = angle_deg - base_deg
        weight_sum += share
        first_sum += share * relative_deg
        second_sum += share * relative_deg * relative_deg
        lasted_s += width_s
        cost = (second_sum - first_sum * first_sum / weight_sum + price) / lasted_s
        if cost < best_cost:
            best_cost, best_deg = cost, base_deg + first_sum / weight_sum
        elif cost > _HOPELESS * best_cost:
            break
    return best_deg
