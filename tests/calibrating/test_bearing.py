"""North by a compass: the average, when it is refused, and the real driver on a simulated chip."""

from __future__ import annotations

import random

import pytest

from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.bno055 import Bno055 as SimBno055
from firmware_sim.clock import SimClock
from hw.buses.i2c import SmbusI2C
from hw.chips.bno055 import Bno055
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


def samples(*headings_deg: float, azimuth_deg: float = 90.0, magnetometer: int = 3) -> list[HeadingSample]:
    """Enough samples, the headings over and over."""
    return [
        HeadingSample(headings_deg[at % len(headings_deg)], azimuth_deg, magnetometer)
        for at in range(LEAST_SAMPLES + len(headings_deg))
    ]


@pytest.mark.parametrize(
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


@pytest.mark.parametrize(
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


# --- the real driver on a simulated chip

TRUE_OFFSET_DEG = 17.0
DECLINATION_DEG = 3.0


class Boom:
    """A rotor whose scale is 17 degrees off true north, and a compass on its boom."""

    def __init__(self, noise_deg_rms: float = 1.0, seed: int = 1) -> None:
        self.clock = SimClock()
        self.azimuth_deg = 90.0
        wire = SimI2CBus(self.clock.sleep)
        self.chip = SimBno055(
            self.clock,
            lambda: self.azimuth_deg + TRUE_OFFSET_DEG - DECLINATION_DEG,
            noise_deg_rms=noise_deg_rms,
            noise=random.Random(seed),
        )
        wire.attach(0x28, self.chip)
        self.compass = Bno055(SmbusI2C(wire, "bus 3"), self.clock, self.clock.sleep)
        self.compass.attitude()
        self.clock.sleep(30.0)

    def north(self, azimuth_deg: float, count: int = 50) -> North:
        self.azimuth_deg = azimuth_deg
        self.clock.sleep(5.0)
        taken = []
        for _ in range(count):
            self.clock.sleep(0.1)
            calibrated = self.compass.calibration()
            taken.append(HeadingSample(self.compass.heading_deg(), azimuth_deg, calibrated.magnetometer))
        return find_north(taken, DECLINATION_DEG)


@pytest.mark.parametrize(("noise_deg_rms", "within_deg"), [(0.3, 0.2), (1.0, 0.5), (2.0, 1.0)])
def test_averaging_takes_the_noise_away(noise_deg_rms: float, within_deg: float) -> None:
    errors_deg = [Boom(noise_deg_rms, seed).north(90.0).offset_deg - TRUE_OFFSET_DEG for seed in range(10)]
    worst_deg = max(abs(error_deg) for error_deg in errors_deg)
    print(f"noise {noise_deg_rms} deg rms: north within {worst_deg:.2f} deg after 50 readings, ten runs")  # noqa: T201
    assert worst_deg < within_deg


def test_garbled_answers_leave_north_where_it_is() -> None:
    boom = Boom()
    boom.chip.bit7_share = 0.02
    assert boom.north(200.0).offset_deg == pytest.approx(TRUE_OFFSET_DEG, abs=0.5)


def test_steel_near_the_compass_is_averaged_out_over_the_circle() -> None:
    boom = Boom()
    boom.chip.hard_iron_deg = 6.0
    places = [boom.north(azimuth_deg) for azimuth_deg in (0.0, 90.0, 180.0, 270.0)]
    alone_deg = max(abs(place.offset_deg - TRUE_OFFSET_DEG) for place in places)
    together = agree(places)
    error_deg = abs(together.offset_deg - TRUE_OFFSET_DEG)
    print(  # noqa: T201
        f"steel bending by 6 deg: one place up to {alone_deg:.1f} deg off, four together {error_deg:.2f} deg, "
        f"told as +-{together.uncertainty_deg:.1f}"
    )
    assert alone_deg > 4.0
    assert error_deg < 0.5
    assert together.uncertainty_deg > places[0].uncertainty_deg


def test_too_much_steel_is_refused() -> None:
    boom = Boom()
    boom.chip.hard_iron_deg = 20.0
    with pytest.raises(NorthUncertain, match="steel is too near"):
        agree([boom.north(azimuth_deg) for azimuth_deg in (0.0, 90.0, 180.0, 270.0)])


def test_a_compass_that_never_learnt_is_refused() -> None:
    boom = Boom()
    boom.chip.learns = False
    with pytest.raises(NorthUncertain, match=r"\(0 of 3\)"):
        boom.north(90.0)


def test_a_magnetic_disturbance_is_refused() -> None:
    boom = Boom()
    boom.chip.wander_deg = 15.0
    with pytest.raises(NorthUncertain, match="the compass swings by"):
        boom.north(90.0)
