"""Finds the middle of an antenna's beam from the signal strengths that a receiver has shown at places round a target.

The model of the strength: a bell (the beam) above a constant floor (the noise), in decibels. The signal may fade, and
the gears may have play. Fading that lasts from one place to the next is estimated and removed. The fit is a least
squares fit in plain Python (Levenberg and Marquardt). Knows no antenna, no clock and no receiver.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from rotator.control.sky.equations import solved

HALF_POWER = 4 * math.log(2.0)
DECIBELS = 10 / math.log(10.0)
WIDTH_DOUBT = 0.35
"""The expected error (rms) of the beam's width in the file: the logarithm of true width to width in the file."""
PLAY_DOUBT = 0.15
"""The expected play (rms) of a gear, in widths of the beam."""
SIGNAL_DOUBT = 3.0
"""The expected error (rms) of the first guess of signal to noise, as a logarithm."""
LEAST_NOISE_DB = 0.1
MOST_ALIKE = 0.9
"""The largest share of the fading at one place that is taken to last to the next place."""
LEAST_RISE_DB = 0.8
LEAST_GAIN = 30.0
"""A peak must fit better than a constant strength by this many variances of the noise."""
_ROUNDS, _PASSES = 40, 3


class NoPeak(ValueError):  # noqa: N818 - a sentence for a person; the program has not failed
    """Why the middle cannot be found from these strengths."""


@dataclass(frozen=True, slots=True)
class Heard:
    """The mean strength while the boom stood. The target was `right_deg` to its right and `above_deg` above it.

    `came_right`, `came_up`: the direction in which each axis turned before it stood: 1, -1, or 0 if it is not known.
    """

    right_deg: float
    above_deg: float
    strength_db: float
    came_right: int = 0
    came_up: int = 0


@dataclass(frozen=True, slots=True)
class Middle:
    """Where the target is in the middle of the beam: degrees to the right and above. A doubt is a standard error."""

    right_deg: float
    above_deg: float
    right_doubt_deg: float
    above_doubt_deg: float
    rise_db: float
    """How much stronger the signal is in the middle than at the weakest place."""
    noise_db: float
    """The difference (rms) between the measured strengths and the fit."""
    beam_deg: tuple[float, float]
    """The beam's width and height, between the points of half power."""
    play_deg: tuple[float, float]
    """The play of the gears of azimuth and elevation, in degrees on the sky."""

    @property
    def doubt_deg(self) -> float:
        return math.hypot(self.right_doubt_deg, self.above_doubt_deg)


def middle(heard: Sequence[Heard], beam_deg: float) -> Middle:
    """Raises NoPeak."""
    loudest, faintest = max(each.strength_db for each in heard), min(each.strength_db for each in heard)
    if loudest - faintest < 1e-6:
        raise NoPeak(f"the receiver shows {loudest:g} dB everywhere: does it hear the signal, and is its meter on?")
    best = min((_Fit(heard, beam_deg, start) for start in _starts(heard, beam_deg)), key=lambda fit: fit.cost)
    best.refine()
    found = best.middle()
    if found.rise_db < LEAST_RISE_DB or best.gain < LEAST_GAIN:
        raise NoPeak(f"no peak: the strength varies by {loudest - faintest:.1f} dB, as it would by chance alone")
    return found


def _starts(heard: Sequence[Heard], beam_deg: float) -> list[list[float]]:
    """Where the search begins: the loudest place, the middle of the loud places, and the middle of all places."""
    floor_db = sorted(each.strength_db for each in heard)[len(heard) // 5]
    order = sorted(heard, key=lambda each: each.strength_db, reverse=True)
    loud = order[: max(3, len(order) // 8)]
    places = [
        (order[0].right_deg, order[0].above_deg),
        (sum(each.right_deg for each in loud) / len(loud), sum(each.above_deg for each in loud) / len(loud)),
        (sum(each.right_deg for each in heard) / len(heard), sum(each.above_deg for each in heard) / len(heard)),
    ]
    signal = math.log(max(10 ** ((order[0].strength_db - floor_db) / 10) - 1, 0.3))
    return [[right / beam_deg, above / beam_deg, floor_db, signal, 0.0, 0.0, 0.0, 0.0] for right, above in places]


class _Fit:
    """Finds eight numbers: the middle (right, above), in widths of the beam; the floor in decibels; the logarithms of
    signal to floor and of the beam's true width and height to those in the file; half the play of each axis, in widths.
    """

    def __init__(self, heard: Sequence[Heard], beam_deg: float, start: Sequence[float]) -> None:
        self._heard = heard
        self._beam_deg = beam_deg
        width, play = (0.0, WIDTH_DOUBT), (0.0, PLAY_DOUBT / 2)
        self._expected = (None, None, None, (start[3], SIGNAL_DOUBT), width, width, play, play)
        self._at = list(start)
        self._alike, self._noise_db = 0.0, 1.0
        self._settle()

    def refine(self) -> None:
        """Estimate the noise and how long fading lasts from the differences to the fit, and fit again."""
        for _ in range(_PASSES):
            left = self._left(self._at)
            total = sum(x * x for x in left)
            self._noise_db = max(LEAST_NOISE_DB, math.sqrt(total / max(len(left) - 6, 1)))
            beside = sum(a * b for a, b in pairwise(left))
            alike = beside / max(total, 1e-9)
            # The fit follows a part of the fading, so the differences show less fading than there is: add that part.
            self._alike = min(max(alike + (1 + 4 * alike) / len(left), 0.0), MOST_ALIKE)
            self._settle()

    @property
    def cost(self) -> float:
        return self._cost(self._at)

    @property
    def gain(self) -> float:
        """By how many variances of the noise the peak fits better than a constant strength."""
        level = [each.strength_db for each in self._heard]
        flat = min(self._squares([db - mean for db in level]) for mean in self._means(level))
        return flat - self._squares(self._left(self._at))

    def middle(self) -> Middle:
        matrix, _ = self._equations(self._at)
        doubts = [math.sqrt(max(solved(matrix, _only(index, len(self._at)))[index], 0.0)) for index in (0, 1)]
        beam_deg, at = self._beam_deg, self._at
        top_db, edge_db = self._bell(1.0, at), self._bell(min(self._share(each, at) for each in self._heard), at)
        return Middle(
            at[0] * beam_deg,
            at[1] * beam_deg,
            doubts[0] * beam_deg,
            doubts[1] * beam_deg,
            top_db - edge_db,
            self._noise_db,
            (beam_deg * math.exp(at[4]), beam_deg * math.exp(at[5])),
            (2 * at[6] * beam_deg, 2 * at[7] * beam_deg),
        )

    def _share(self, each: Heard, at: Sequence[float]) -> float:
        """The share of the signal's power that the beam receives. With play the boom stays behind its shaft."""
        right = each.right_deg / self._beam_deg + at[6] * each.came_right - at[0]
        above = each.above_deg / self._beam_deg + at[7] * each.came_up - at[1]
        return math.exp(-HALF_POWER * ((right / math.exp(at[4])) ** 2 + (above / math.exp(at[5])) ** 2))

    def _bell(self, share: float, at: Sequence[float]) -> float:
        return at[2] + DECIBELS * math.log1p(math.exp(min(at[3], 40.0)) * share)

    def _left(self, at: Sequence[float]) -> list[float]:
        return [each.strength_db - self._bell(self._share(each, at), at) for each in self._heard]

    def _whitened(self, values: Sequence[float]) -> list[float]:
        """The values without the part that lasts from the place before, in units of the noise."""
        scale = self._noise_db * math.sqrt(1 - self._alike**2)
        fresh = [(value - self._alike * before) / scale for before, value in pairwise(values)]
        return [values[0] / self._noise_db, *fresh]

    def _squares(self, left: Sequence[float]) -> float:
        return sum(value * value for value in self._whitened(left))

    def _means(self, level: Sequence[float]) -> list[float]:
        ones = self._whitened([1.0] * len(level))
        best = sum(a * b for a, b in zip(ones, self._whitened(level), strict=True)) / sum(a * a for a in ones)
        return [best, sum(level) / len(level)]

    def _cost(self, at: Sequence[float]) -> float:
        doubts = zip(at, self._expected, strict=True)
        return self._squares(self._left(at)) + sum(((x - e[0]) / e[1]) ** 2 for x, e in doubts if e is not None)

    def _equations(self, at: Sequence[float]) -> tuple[list[list[float]], list[float]]:
        by_place = [self._slopes(each, at) for each in self._heard]
        slopes = [self._whitened(column) for column in zip(*by_place, strict=True)]
        left = self._whitened(self._left(at))
        size = len(at)
        matrix = [[0.0] * size for _ in at]
        for row in range(size):
            for column in range(row + 1):
                matrix[row][column] = matrix[column][row] = _product(slopes[row], slopes[column])
        side = [_product(one, left) for one in slopes]
        for index, expected in enumerate(self._expected):
            matrix[index][index] += 1e-9
            if expected is not None:
                matrix[index][index] += 1 / expected[1] ** 2
                side[index] += (expected[0] - at[index]) / expected[1] ** 2
        return matrix, side

    def _slopes(self, each: Heard, at: Sequence[float]) -> tuple[float, ...]:
        """By how many decibels the strength there rises when each of the eight numbers grows by one."""
        right = (each.right_deg / self._beam_deg + at[6] * each.came_right - at[0]) / math.exp(at[4])
        above = (each.above_deg / self._beam_deg + at[7] * each.came_up - at[1]) / math.exp(at[5])
        over_floor = math.exp(min(at[3], 40.0)) * math.exp(-HALF_POWER * (right**2 + above**2))
        signal_db = DECIBELS * over_floor / (1 + over_floor)
        steep = 2 * HALF_POWER * signal_db
        sideways, upright = steep * right / math.exp(at[4]), steep * above / math.exp(at[5])
        return (
            sideways,
            upright,
            1.0,
            signal_db,
            steep * right**2,
            steep * above**2,
            -sideways * each.came_right,
            -upright * each.came_up,
        )

    def _settle(self) -> None:
        """Change the eight numbers in the direction of a smaller cost, until it hardly falls any more."""
        damping, cost = 1e-2, self._cost(self._at)
        for _ in range(_ROUNDS):
            matrix, side = self._equations(self._at)
            damped = [
                [value * (1 + damping) if row == column else value for column, value in enumerate(values)]
                for row, values in enumerate(matrix)
            ]
            steps = [min(max(step, -1.0), 1.0) for step in solved(damped, side)]
            there = [x + step for x, step in zip(self._at, steps, strict=True)]
            after = self._cost(there)
            if after >= cost:
                damping *= 8
                if damping > 1e6:
                    return
                continue
            gained, self._at, cost, damping = cost - after, there, after, damping / 4
            if gained < 1e-3:
                return


def _product(one: Sequence[float], other: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(one, other, strict=True))


def _only(index: int, size: int) -> list[float]:
    return [1.0 if at == index else 0.0 for at in range(size)]
