"""Which readings can be true: sparks, jumps that stay, and an axis that turns as fast as it can."""

from __future__ import annotations

import random

from hypothesis import given
from hypothesis import strategies as st

from rotator.control.axis.sparks import AGREEING_SPARKS, SeenAt, Sparks

STEP_S = 0.05
FASTEST_DPS = 6.0


def believed(angles_deg: list[float | None], noise_deg: float = 0.1) -> list[tuple[SeenAt, ...]]:
    """What each reading makes; None: there is no reading."""
    sparks = Sparks(FASTEST_DPS)
    return [
        () if angle_deg is None else sparks.believe(count * STEP_S, angle_deg, noise_deg)
        for count, angle_deg in enumerate(angles_deg)
    ]


def angles_of(angles_deg: list[float | None]) -> list[list[float]]:
    return [[angle_deg for _, angle_deg in places] for places in believed(angles_deg)]


def test_a_spark_is_left_out() -> None:
    assert angles_of([10.0, 10.1, 100.0, 10.2]) == [[10.0], [10.1], [], [10.2]]


def test_sparks_to_both_sides_are_left_out() -> None:
    assert angles_of([10.0, 100.0, -80.0, 100.0, -80.0, 10.0])[1:] == [[], [], [], [], [10.0]]


def test_what_stays_elsewhere_is_believed_whole() -> None:
    assert angles_of([10.0, 40.0, 40.1, 40.2, 40.3]) == [[10.0], [], [], [40.0, 40.1, 40.2], [40.3]]


def test_missing_readings_do_not_make_a_spark_true() -> None:
    assert angles_of([10.0, None, 100.0, None, 10.0, None, 100.0, None, 10.0])[2::2] == [[], [10.0], [], [10.0]]


def test_with_more_noise_more_is_believed() -> None:
    assert believed([10.0, 14.0], noise_deg=0.1)[1] == ()
    assert believed([10.0, 14.0], noise_deg=1.0)[1] != ()


def test_what_the_noise_and_twice_the_known_speed_explain_is_believed() -> None:
    """Three degrees or six noises, and 0.6° in the time from one reading to the next."""
    for noise_deg, most_deg in ((0.1, 3.6), (0.5, 3.6), (1.0, 6.6)):
        assert believed([10.0, 9.9 + most_deg], noise_deg)[1] != ()
        assert believed([10.0, 10.1 + most_deg], noise_deg)[1] == ()


@given(
    speed_dps=st.floats(-2.0 * FASTEST_DPS, 2.0 * FASTEST_DPS),
    seed=st.integers(0, 9999),
    each=st.integers(2, 50),
    gap=st.integers(0, AGREEING_SPARKS - 1),
)
def test_a_real_motion_is_never_left_out(speed_dps: float, seed: int, each: int, gap: int) -> None:
    """With noise, and with readings missing now and then, at up to twice the speed that is known."""
    chance = random.Random(seed)
    angles_deg = [
        None if count % each < gap else 100.0 + speed_dps * count * STEP_S + chance.gauss(0.0, 0.1)
        for count in range(200)
    ]
    assert all(places for places, angle_deg in zip(believed(angles_deg), angles_deg, strict=True) if angle_deg)


def test_when_the_readings_mean_other_places_the_next_one_is_believed_at_any_angle() -> None:
    sparks = Sparks(FASTEST_DPS)
    assert sparks.believe(0.0, 10.0, 0.1) == ((0.0, 10.0),)
    assert sparks.believe(0.05, 300.0, 0.1) == ()
    sparks.begin_anew()
    assert sparks.believe(0.1, 200.0, 0.1) == ((0.1, 200.0),)
    assert [sparks.believe(0.15, 300.0, 0.1), sparks.believe(0.2, 300.0, 0.1)] == [(), ()], (
        "the one before is forgotten"
    )
