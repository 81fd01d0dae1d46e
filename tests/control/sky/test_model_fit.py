"""The terms of a mount come back from points, as many as the points can tell, and never for the worse."""

from __future__ import annotations

import math
import random
from dataclasses import astuple, replace

import pytest

from rotator.control.sky.angles import great_circle_deg
from rotator.control.sky.model_fit import ALL, OFFSETS, TILT, NoFit, SkyPoint, fitted, rms_deg
from rotator.control.sky.pointing_model import PERFECT, PointingModel
from tests.search import some

NOISE_DEG = 0.07
"""How well a person centres the Sun, to the right and above: 0.1° in all."""


def points_of(model: PointingModel, count: int, draw: random.Random, noise_deg: float = NOISE_DEG) -> list[SkyPoint]:
    """Places of the axes all around the sky and from low to high, and where the boom of that mount points there."""
    lows_deg = [10 + 70 * number / count for number in range(count)]
    draw.shuffle(lows_deg)
    points = []
    for number, low_deg in enumerate(lows_deg):
        axes = 360 * (number + draw.random()) / count, low_deg + 70 * draw.random() / count
        azimuth_deg, elevation_deg = model.pointed(*axes)
        azimuth_deg += draw.gauss(0, noise_deg) / math.cos(math.radians(elevation_deg))
        points.append(SkyPoint(*axes, azimuth_deg, elevation_deg + draw.gauss(0, noise_deg)))
    return points


def over_the_sky_deg(model: PointingModel, truth: PointingModel) -> float:
    """How far the boom points from where the model takes it to point, rms over all places of the axes up to 85°."""
    squares = [
        great_circle_deg(*truth.pointed(azimuth_deg, elevation_deg), *model.pointed(azimuth_deg, elevation_deg)) ** 2
        for azimuth_deg in range(0, 360, 15)
        for elevation_deg in range(0, 86, 5)
    ]
    return math.sqrt(sum(squares) / len(squares))


@pytest.mark.search
@pytest.mark.parametrize("seed", some(range(20)))
def test_six_errors_of_up_to_five_degrees_come_back_from_twelve_noisy_points(seed: int) -> None:
    draw = random.Random(seed)
    truth = PointingModel(*(draw.uniform(-5, 5) for _ in ALL))
    fit = fitted(points_of(truth, 12, draw))
    assert fit.terms == ALL
    assert over_the_sky_deg(fit.model, truth) <= 0.1


def test_without_noise_every_term_comes_back_to_the_digit() -> None:
    truth = PointingModel(5, -5, 4, -3, 2, -1)
    fit = fitted(points_of(truth, 6, random.Random(1), noise_deg=0))
    assert astuple(fit.model) == pytest.approx(astuple(truth), abs=1e-3)
    assert fit.rms_deg < 0.001


@pytest.mark.parametrize(("count", "terms"), [(1, OFFSETS), (2, OFFSETS), (3, TILT), (5, TILT)])
def test_few_points_tell_few_terms(count: int, terms: tuple[str, ...]) -> None:
    truth = PointingModel(2, -1, *((1.5, -2) if terms == TILT else (0, 0)))
    fit = fitted(points_of(truth, count, random.Random(count), noise_deg=0.02))
    assert fit.terms == terms
    assert over_the_sky_deg(fit.model, truth) <= 0.15


def test_what_few_points_cannot_tell_stays_as_it_was() -> None:
    before = PointingModel(an_deg=2, ca_deg=1)
    fit = fitted(points_of(replace(before, ia_deg=3), 2, random.Random(1)), before)
    assert (fit.model.an_deg, fit.model.ca_deg) == (2, 1)
    assert fit.model.ia_deg == pytest.approx(3, abs=0.3)


def test_points_in_one_corner_of_the_sky_tell_no_tilt() -> None:
    """The Sun within an hour: a tilt there looks like an offset."""
    draw = random.Random(3)
    truth = PointingModel(2, 1, 1, -1, 0.5, 0.5)
    points = [
        SkyPoint(*truth.axis_angles(az + draw.gauss(0, 0.2), el + draw.gauss(0, 0.2)), az, el)
        for az, el in ((150, 20), (153, 21), (156, 22), (159, 22.5), (162, 23), (165, 23.5), (168, 24), (171, 24))
    ]
    assert fitted(points).terms == OFFSETS


def test_a_mount_without_tilt_is_given_none() -> None:
    fit = fitted(points_of(PointingModel(3, -2), 8, random.Random(5)))
    assert over_the_sky_deg(fit.model, PointingModel(3, -2)) <= 0.15


def test_points_over_the_top_count_like_others() -> None:
    truth = PointingModel(1, 2, -1, 1.5, 2, -2)
    points = []
    for azimuth_deg, elevation_deg in ((0, 20), (60, 150), (120, 45), (180, 120), (240, 70), (300, 165), (30, 100)):
        points.append(SkyPoint(*truth.axis_angles(azimuth_deg, elevation_deg), azimuth_deg, elevation_deg))
    assert astuple(fitted(points).model) == pytest.approx(astuple(truth), abs=0.01)


def test_a_heavier_point_counts_more() -> None:
    light, heavy = SkyPoint(100, 30, 101, 30), SkyPoint(100, 30, 103, 30, weight=9)
    assert fitted([light, heavy]).model.ia_deg == pytest.approx(-2.8, abs=0.01)


def test_a_fit_no_better_than_what_is_there_is_refused() -> None:
    truth = PointingModel(2, 1, 1, -1, 0.5, 0.5)
    points = points_of(truth, 12, random.Random(7))
    best = fitted(points).model
    with pytest.raises(NoFit, match="it stays"):
        fitted(points, best)


@pytest.mark.parametrize("points", [[], [SkyPoint(100, 30, 160, 30)], [SkyPoint(100, 30, 280, 10)]])
def test_what_is_no_mounts_error_is_refused(points: list[SkyPoint]) -> None:
    with pytest.raises(NoFit):
        fitted(points)


def test_one_wrong_point_shows_by_what_is_left_of_it() -> None:
    points = points_of(PointingModel(2, 1), 8, random.Random(9))
    points[3] = replace(points[3], axis_azimuth_deg=points[3].axis_azimuth_deg + 8)
    lefts = [math.hypot(*miss) for miss in fitted(points).misses]
    assert lefts.index(max(lefts)) == 3


def test_a_miss_is_where_the_target_was_as_seen_along_the_boom() -> None:
    assert SkyPoint(100, 0, 103, 0).miss(PERFECT) == pytest.approx((3, 0))
    assert SkyPoint(100, 0, 100, 2).miss(PERFECT) == pytest.approx((0, 2))
    assert rms_deg([SkyPoint(100, 0, 103, 0), SkyPoint(50, 0, 50, 4)], PERFECT) == pytest.approx(math.sqrt(12.5))
