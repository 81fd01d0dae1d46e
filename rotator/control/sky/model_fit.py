"""The terms of the mount from points: where the axes stood, and what the boom pointed at then.

Knows which terms so many points can tell, and refuses what they cannot: a fit that points worse than the model before,
or that is nothing like a mount. Least squares on the sphere (Gauss and Newton), in plain Python. Knows no files, no
clock and no rotor.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

from rotator.control.sky.angles import dot, unit
from rotator.control.sky.equations import solved
from rotator.control.sky.pointing_model import PERFECT, PointingModel

MOST_DEG = 10.0
"""No term of a mount that stands is larger."""
OFFSETS = ("ia_deg", "ie_deg")
TILT = (*OFFSETS, "an_deg", "aw_deg")
ALL = tuple(field.name for field in fields(PointingModel))
TERMS = ((1, OFFSETS), (3, TILT), (6, ALL))
"""From so many points on, these terms can be found."""
NOISE_DEG = 0.1
"""A person, or a beam, points no better than this: points that agree better than that do so by chance."""
DOUBT_DEG = 1.0
"""A tilt, or six terms, that leave a place of the sky in doubt by more than this are not taken from these points."""
PROBES = tuple((60.0 * turn, elevation_deg) for turn in range(6) for elevation_deg in (15.0, 60.0))
"""Places of the axes, all over the sky."""
GAIN_DEG = 0.01
"""A fit must point this much better than the model before."""
_ROUNDS = 12
_DONE_DEG = 1e-7
_STEP_DEG = 1e-3

Miss = tuple[float, float]
"""How far the target was from where the boom pointed, by a model: to the right and above, in degrees on the sky."""


class NoFit(ValueError):  # noqa: N818 - a sentence for a person; the program has not failed
    """Why these points give no model, and what to do."""


@dataclass(frozen=True, slots=True)
class SkyPoint:
    """The axes stood here, and the boom pointed at that direction. `weight`: how much it counts, beside the others."""

    axis_azimuth_deg: float
    axis_elevation_deg: float
    azimuth_deg: float
    elevation_deg: float
    weight: float = 1.0

    def miss(self, model: PointingModel) -> Miss:
        az, el = math.radians(self.azimuth_deg), math.radians(self.elevation_deg)
        boom = model.boom(self.axis_azimuth_deg, self.axis_elevation_deg)
        right = dot(boom, (math.cos(az), -math.sin(az), 0.0))
        above = dot(boom, (-math.sin(el) * math.sin(az), -math.sin(el) * math.cos(az), math.cos(el)))
        ahead = dot(boom, unit(self.azimuth_deg, self.elevation_deg))
        # The angle between the two, in the direction in which the target was.
        off_deg = math.degrees(math.atan2(math.hypot(right, above), ahead))
        share = off_deg / (math.hypot(right, above) or 1.0)
        return -right * share, -above * share


@dataclass(frozen=True, slots=True)
class Fit:
    model: PointingModel
    terms: tuple[str, ...]
    """The terms found from the points; the others are as they were."""
    misses: tuple[Miss, ...]
    """What is left at each point."""
    rms_deg: float
    before_deg: float
    """The same by the model before."""


def rms_deg(points: Sequence[SkyPoint], model: PointingModel) -> float:
    """How far off the boom points by a model, over all points."""
    total = sum(point.weight for point in points)
    return math.sqrt(sum(point.weight * (x * x + y * y) for point, (x, y) in _misses(points, model)) / total)


def fitted(points: Sequence[SkyPoint], before: PointingModel = PERFECT) -> Fit:
    """The model that fits best: with as many terms as the points can tell. Raises NoFit."""
    if not points:
        raise NoFit("there is no point yet")
    before_deg = rms_deg(points, before)
    sets = [terms for least, terms in TERMS if len(points) >= least]
    models = [(terms, _model(points, before, terms)) for terms in sets]
    found = [(terms, model) for terms, model in models if model is not None and _sure(points, model, terms)]
    if not found:
        raise NoFit("the points do not agree with any mount: was each one at the target? Take the wrong one back")
    terms, model = min(found, key=lambda each: _unseen_deg(points, before, each[0]))
    left_deg = rms_deg(points, model)
    if left_deg > before_deg - GAIN_DEG:
        raise NoFit(
            f"the best fit misses these points by {left_deg:.2f}°, the model in force by {before_deg:.2f}°: it stays"
        )
    return Fit(model, terms, tuple(point.miss(model) for point in points), left_deg, before_deg)


def _unseen_deg(points: Sequence[SkyPoint], before: PointingModel, terms: tuple[str, ...]) -> float:
    """How far off a model with these terms points where it has not been fitted: each point by the fit of the others.

    More terms always come nearer to the points they were fitted to; they are worth it only if this shrinks, too.
    """
    if len(points) < 3:
        return 0.0
    total = 0.0
    for index, left_out in enumerate(points):
        others = [*points[:index], *points[index + 1 :]]
        model = _model(others, before, terms)
        if model is None:
            return math.inf
        total += left_out.weight * sum(part * part for part in left_out.miss(model))
    return math.sqrt(total / sum(point.weight for point in points))


def _model(points: Sequence[SkyPoint], before: PointingModel, terms: tuple[str, ...]) -> PointingModel | None:
    """The least squares with these terms; None: there is no such mount."""
    model = before
    try:
        for _ in range(_ROUNDS):
            steps = solved(*_equations(points, model, terms))
            moved = {term: getattr(model, term) + step for term, step in zip(terms, steps, strict=True)}
            model = replace(model, **moved)
            if max(abs(value) for value in moved.values()) > 3 * MOST_DEG:
                return None
            if max(abs(step) for step in steps) < _DONE_DEG:
                break
    except ZeroDivisionError:
        return None
    return replace(model, **{term: round(getattr(model, term), 4) + 0.0 for term in terms})


def _sure(points: Sequence[SkyPoint], model: PointingModel, terms: tuple[str, ...]) -> bool:
    """Whether each term is one of a mount that stands, and the points tell it well enough for all of the sky."""
    if max(abs(getattr(model, term)) for term in terms) > MOST_DEG:
        return False
    try:
        return terms == OFFSETS or _doubt_deg(points, model, terms) <= DOUBT_DEG
    except ZeroDivisionError:
        return False


def _doubt_deg(points: Sequence[SkyPoint], model: PointingModel, terms: tuple[str, ...]) -> float:
    """How far off the boom may point where the model is least sure: the largest standard error at `PROBES`."""
    matrix, _ = _equations(points, model, terms)
    spare = 2 * len(points) - len(terms)
    mean_weight = sum(point.weight for point in points) / len(points)
    left = sum(point.weight * (x * x + y * y) for point, (x, y) in _misses(points, model)) / mean_weight
    noise_deg = max(NOISE_DEG, math.sqrt(left / spare) if spare else 0.0)
    worst = 0.0
    for axes in PROBES:
        probe = SkyPoint(*axes, *model.pointed(*axes))
        total = 0.0
        for slopes in _slopes(probe, model, terms):
            spread = solved(matrix, slopes)
            total += sum(a * b for a, b in zip(slopes, spread, strict=True))
        worst = max(worst, total)
    return noise_deg * math.sqrt(mean_weight * worst)


def _equations(
    points: Sequence[SkyPoint], model: PointingModel, terms: tuple[str, ...]
) -> tuple[list[list[float]], list[float]]:
    """The weighted sums of products: of how each term moves the boom, and of what is to be moved."""
    size = len(terms)
    matrix, side = [[0.0] * size for _ in terms], [0.0] * size
    for point, miss in _misses(points, model):
        for part, slopes in zip(miss, _slopes(point, model, terms), strict=True):
            for row in range(size):
                side[row] += point.weight * slopes[row] * part
                for column in range(size):
                    matrix[row][column] += point.weight * slopes[row] * slopes[column]
    return matrix, side


def _slopes(point: SkyPoint, model: PointingModel, terms: tuple[str, ...]) -> tuple[list[float], list[float]]:
    """How far a degree of each term moves the boom, to the right and up."""
    here = point.miss(model)
    after = [point.miss(replace(model, **{term: getattr(model, term) + _STEP_DEG})) for term in terms]
    right, above = ([(here[part] - each[part]) / _STEP_DEG for each in after] for part in range(2))
    return right, above


def _misses(points: Sequence[SkyPoint], model: PointingModel) -> Iterator[tuple[SkyPoint, Miss]]:
    return ((point, point.miss(model)) for point in points)
