"""Finds the terms of the mount's pointing model from points: the axes stood there, and the boom pointed at a target.

Knows how many terms can be found from how many points. Refuses a fit that points worse than the model before, and one
that no real mount can have. The fit is a least squares fit on the sphere (Gauss and Newton), in plain Python. Knows no
files, no clock and no rotor.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace

from rotator.control.sky.angles import dot, unit
from rotator.control.sky.equations import solved
from rotator.control.sky.pointing_model import PERFECT, PointingModel

MOST_DEG = 10.0
"""No real mount has a larger term."""
OFFSETS = ("ia_deg", "ie_deg")
TILT = (*OFFSETS, "an_deg", "aw_deg")
ALL = tuple(field.name for field in fields(PointingModel))
TERMS = ((1, OFFSETS), (3, TILT), (6, ALL))
"""The least number of points, and the terms that can be found from that many."""
NOISE_DEG = 0.1
"""The error of a single point is not smaller than this. Points that agree better do so by chance."""
DOUBT_DEG = 1.0
"""A tilt, or six terms, count as found only if the standard error is not larger anywhere on the sky."""
PROBES = tuple((60.0 * turn, elevation_deg) for turn in range(6) for elevation_deg in (15.0, 60.0))
"""Places all over the sky, at which that standard error is computed."""
GAIN_DEG = 0.01
"""A fit must point this much better than the model before."""
_ROUNDS = 12
_DONE_DEG = 1e-7
_STEP_DEG = 1e-3

Miss = tuple[float, float]
"""The distance from where a model says that the boom pointed to the target: to the right and above, in degrees."""


class NoFit(ValueError):  # noqa: N818 - a sentence for a person; the program has not failed
    """Why no model can be found from these points, and what to do."""


@dataclass(frozen=True, slots=True)
class SkyPoint:
    """The axes stood at these angles while the boom pointed in this direction. `weight`: how much the point counts."""

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
        # The length of the result is the angle between both directions.
        off_deg = math.degrees(math.atan2(math.hypot(right, above), ahead))
        share = off_deg / (math.hypot(right, above) or 1.0)
        return -right * share, -above * share


@dataclass(frozen=True, slots=True)
class Fit:
    model: PointingModel
    terms: tuple[str, ...]
    """The terms that were found. The other terms are those of the model before."""
    misses: tuple[Miss, ...]
    """The distance that remains at each point."""
    rms_deg: float
    before_deg: float
    """The rms distance by the model before."""


def rms_deg(points: Sequence[SkyPoint], model: PointingModel) -> float:
    """The rms distance between boom and target over all points, by this model."""
    total = sum(point.weight for point in points)
    return math.sqrt(sum(point.weight * (x * x + y * y) for point, (x, y) in _misses(points, model)) / total)


def fitted(points: Sequence[SkyPoint], before: PointingModel = PERFECT) -> Fit:
    """The model that fits best, with as many terms as can be found from these points. Raises NoFit."""
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
            f"the best fit misses these points by {left_deg:.2f}°, the model in force by {before_deg:.2f}°; it stays"
        )
    return Fit(model, terms, tuple(point.miss(model) for point in points), left_deg, before_deg)


def _unseen_deg(points: Sequence[SkyPoint], before: PointingModel, terms: tuple[str, ...]) -> float:
    """The error (rms) at points that were not used: each point is left out once, and predicted from the others.

    With more terms the fit always comes nearer to the points that were used. So the set of terms is chosen by this
    error.
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
    """The least squares fit with these terms; None: no mount is like that."""
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
    """Whether a real mount can have these terms, and the model is sure enough all over the sky."""
    if max(abs(getattr(model, term)) for term in terms) > MOST_DEG:
        return False
    try:
        return terms == OFFSETS or _doubt_deg(points, model, terms) <= DOUBT_DEG
    except ZeroDivisionError:
        return False


def _doubt_deg(points: Sequence[SkyPoint], model: PointingModel, terms: tuple[str, ...]) -> float:
    """The largest standard error of the model at `PROBES`."""
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
    """The normal equations of the fit: the weighted sums of products of slopes, and of slopes and distances."""
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
    """How far the boom moves to the right and up when each term grows by one degree."""
    here = point.miss(model)
    after = [point.miss(replace(model, **{term: getattr(model, term) + _STEP_DEG})) for term in terms]
    right, above = ([(here[part] - each[part]) / _STEP_DEG for each in after] for part in range(2))
    return right, above


def _misses(points: Sequence[SkyPoint], model: PointingModel) -> Iterator[tuple[SkyPoint, Miss]]:
    return ((point, point.miss(model)) for point in points)
