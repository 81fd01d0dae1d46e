"""A knob on a long wire, in MANUAL: what its readings may do while nobody touches it, and how soon a turn counts."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.exchange.orders import Aim, Order
from tests.panel.person import LOOK_S, MANUAL, Person, about, at_the_panel
from tests.search import examples
from tests.tables import every_row

RANGE_DEG = 360.0
Noise = Callable[[random.Random], float]
NOISES: dict[str, Callable[[float], Noise]] = {
    "scatter": lambda size: lambda chance: chance.gauss(0.0, size / 3.0),
    "hum": lambda size: lambda chance: chance.uniform(-size / 2.0, size / 2.0),
    "two levels": lambda size: lambda chance: chance.choice((0.0, size)),
    "sparks": lambda size: lambda chance: chance.choice((-1.0, 1.0)) * 20.0 * size if chance.random() < 0.01 else 0.0,
}
SIZES = st.floats(0.0, 0.03)
"""Of the supply: 0.03 is 100 mV of 3.3 V."""


def left_alone(person: Person, share: float, noise: Noise, chance: random.Random, seconds: float) -> list[Order]:
    return [
        order
        for _ in range(round(seconds / LOOK_S))
        for order in person.sees(azimuth_knob=min(max(share + noise(chance), 0.0), 1.0))
    ]


def at_rest(share: float) -> Person:
    person = at_the_panel(MANUAL)
    person.waits(3.0, azimuth_knob=share)
    return person


@every_row("wrong", [1, 2])
@every_row("by", [0.015, -0.015, 0.3, -0.2])
def test_a_spark_of_one_reading_or_two_moves_nothing(by: float, wrong: int) -> None:
    person = at_rest(0.2)
    assert person.waits(wrong * LOOK_S, azimuth_knob=0.2 + by) == []
    assert person.waits(10.0, azimuth_knob=0.2) == []


def test_neither_does_a_hand_that_turns_it_away_and_back() -> None:
    person = at_rest(0.2)
    for share in (0.3, 0.4, 0.5, 0.4, 0.3):
        assert person.waits(0.4, azimuth_knob=share) == []
    assert person.waits(5.0, azimuth_knob=0.2) == []


@pytest.mark.long
@settings(max_examples=examples(60), deadline=None)
@given(kind=st.sampled_from(sorted(NOISES)), size=SIZES, share=st.floats(0.0, 1.0), seed=st.integers(0, 2**32))
def test_noise_moves_nothing(kind: str, size: float, share: float, seed: int) -> None:
    person, chance, noise = at_the_panel(MANUAL), random.Random(seed), NOISES[kind](size)
    person.waits(1.5, azimuth_knob=None)
    assert left_alone(person, share, noise, chance, 120.0) == []


@settings(max_examples=examples(60), deadline=None)
@given(
    kind=st.sampled_from(sorted(NOISES)),
    size=SIZES,
    begins=st.floats(0.0, 1.0),
    ends=st.floats(0.0, 1.0),
    takes_s=st.floats(0.0, 3.0),
    seed=st.integers(0, 2**32),
)
def test_a_turn_is_followed_within_seconds_whatever_the_noise(
    *, kind: str, size: float, begins: float, ends: float, takes_s: float, seed: int
) -> None:
    """It is turned by 36° of the rotor at least, and ends at the antenna's order, to the noise."""
    if abs(ends - begins) < 0.1:
        ends = begins + 0.3 if begins < 0.5 else begins - 0.3
    person, chance, noise = at_the_panel(MANUAL), random.Random(seed), NOISES[kind](size)
    person.waits(1.5, azimuth_knob=None)
    left_alone(person, begins, noise, chance, 3.0)
    looks = max(1, round(takes_s / LOOK_S))
    for look in range(1, looks + 1):
        share = begins + (ends - begins) * look / looks
        left_alone(person, share, noise, chance, LOOK_S)
    orders = left_alone(person, ends, noise, chance, 6.0)
    assert orders, "the antenna does not follow"
    assert isinstance(orders[-1], Aim)
    assert orders[-1].azimuth_deg == about(RANGE_DEG * ends, abs=RANGE_DEG * (0.01 + size))


def test_a_small_turn_of_a_quiet_knob_counts_too() -> None:
    person = at_rest(0.5)
    assert person.waits(1.2, azimuth_knob=0.506) == [Aim(about(RANGE_DEG * 0.506), None, place=True)]
