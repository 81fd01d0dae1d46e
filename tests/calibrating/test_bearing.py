"""North by a compass: the average, and when it is refused. `test_north` has the driver and the chip."""

from __future__ import annotations

import pytest

from rotator.calibrating.bearing import (
    COMPASS_DEG,
    LEAST_SAMPLES,
    HeadingSample,
    North,
    NorthUncertain,
    agree,
    find_north,
)
from rotator.control.sky.angles import turn_deg
from tests.tables import every_row


def samples(*headings_deg: float, azimuth_deg: float = 90.0, magnetometer: int = 3) -> list[HeadingSample]:
    """Enough samples, the headings over and over."""
    return [
        HeadingSample(headings_deg[at % len(headings_deg)], azimuth_deg, magnetometer)
        for at in range(LEAST_SAMPLES + len(headings_deg))
    ]


@every_row(
    ("heading_deg", "azimuth_deg", "declination_deg", "compass_offset_deg", "offset_deg"),
    [
        (90.0, 90.0, 0.0, 0.0, 0.0),
        (100.0, 90.0, 0.0, 0.0, 10.0),
        (80.0, 90.0, 0.0, 0.0, -10.0),
        (90.0, 90.0, 4.5, 0.0, 4.5),  # declination east: true bearings are larger
        (90.0, 90.0, -11.0, 0.0, -11.0),
        (90.0, 180.0, 0.0, 90.0, 0.0),  # the compass samples to the left of the boom
        (5.0, 365.0, 0.0, 0.0, 0.0),  # in the overlap
        (355.0, 5.0, 0.0, 0.0, -10.0),
        (5.0, 355.0, 0.0, 0.0, 10.0),
        (10.0, 200.0, 0.0, 0.0, 170.0),
    ],
)
def test_the_offset_turns_the_rotors_scale_to_true_azimuths(
    heading_deg: float, azimuth_deg: float, declination_deg: float, compass_offset_deg: float, offset_deg: float
) -> None:
    north = find_north(samples(heading_deg, azimuth_deg=azimuth_deg), declination_deg, compass_offset_deg)
    assert north.offset_deg == pytest.approx(offset_deg, abs=1e-6)
    assert north.uncertainty_deg == pytest.approx(COMPASS_DEG, abs=1e-6)


def test_around_north_the_mean_is_north_not_south() -> None:
    assert find_north(samples(359.0, 1.0, azimuth_deg=0.0), 0.0).offset_deg == pytest.approx(0.0, abs=1e-6)


# --- refused


@every_row(
    ("taken", "words"),
    [
        ([], "0 compass readings are too few"),
        (samples(90.0)[: LEAST_SAMPLES - 1], "29 compass readings are too few; let it take at least 30"),
        (samples(90.0, magnetometer=1), r"\(1 of 3\); turn the antenna slowly all the way round"),
        ([*samples(90.0), HeadingSample(90.0, 90.0, 1)], r"\(1 of 3\)"),
        ([*samples(90.0), HeadingSample(90.0, 91.5, 3)], "the antenna turned while the compass was read"),
        (
            samples(80.0, 100.0),
            "the compass swings by 10.0 degrees while the antenna stands, 3 are allowed; move it away",
        ),
        (samples(0.0, 90.0, 180.0, 270.0), "the compass swings"),
    ],
)
def test_north_is_refused(taken: list[HeadingSample], words: str) -> None:
    with pytest.raises(NorthUncertain, match=words):
        find_north(taken, 0.0)


def test_calibrated_two_of_three_is_enough() -> None:
    assert find_north(samples(90.0, magnetometer=2), 0.0).offset_deg == pytest.approx(0.0, abs=1e-6)


# --- several places


def test_places_are_averaged_round_the_circle() -> None:
    north = agree([North(179.0, 2.5), North(-177.0, 2.6)])
    assert abs(turn_deg(-179.0, north.offset_deg)) < 1e-3
    assert 2.6 < north.uncertainty_deg < 3.5


def test_one_place_says_what_it_said() -> None:
    north = agree([North(12.0, 2.5)])
    assert [north.offset_deg, north.uncertainty_deg] == pytest.approx([12.0, 2.5])


@pytest.mark.parametrize(
    ("places", "words"),
    [
        ([], "no place gives north yet"),
        ([North(0.0, 2.5), North(30.0, 2.5)], "differs by 30 degrees from place to place; steel is too near"),
    ],
)
def test_places_that_contradict_each_other(places: list[North], words: str) -> None:
    with pytest.raises(NorthUncertain, match=words):
        agree(places)
