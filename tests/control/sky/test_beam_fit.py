"""The middle of a beam, from strengths heard beside a target: noise, fading, play, and what tells no middle."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator

import pytest

from rotator.control.sky.beam_fit import Heard, NoPeak, middle
from tests.search import examples

BEAM_DEG = 20.0
STEPS = tuple(at / 4 - 1 for at in range(9))
Signal = Callable[[float, float], float]
"""Decibels, for a target so far to the right and above."""


def cross(heard_db: Signal, beam_deg: float = BEAM_DEG, play_deg: float = 0.0) -> list[Heard]:
    """There and back on both arms; a shaft with play leads its boom by half of it."""

    def places() -> Iterator[tuple[float, float, int, int]]:
        for way in (1, -1):
            yield from ((-way * step * beam_deg, 0.0, way, 0) for step in STEPS)
        for way in (1, -1):
            yield from ((0.0, -way * step * beam_deg, 0, way) for step in STEPS)

    return [
        Heard(right, above, heard_db(right + way * play_deg / 2, above + up * play_deg / 2), way, up)
        for right, above, way, up in places()
    ]


def bell(right_deg: float, above_deg: float, beam_deg: float = BEAM_DEG, signal_db: float = 20.0) -> Signal:
    """The power of a bell in the middle at that place, on a floor of noise at -48 dB."""

    def heard_db(right: float, above: float) -> float:
        off = math.hypot(right - right_deg, above - above_deg) / beam_deg
        return -48 + 10 * math.log10(1 + 10 ** (signal_db / 10) * 0.5 ** (4 * off**2))

    return heard_db


def faded(signal: Signal, chance: random.Random, fade_db: float, noise_db: float, stays: float) -> Signal:
    """With fading of which so much lasts to the next place."""
    fade = [0.0]

    def heard_db(right: float, above: float) -> float:
        fade[0] = stays * fade[0] + math.sqrt(1 - stays**2) * chance.gauss(0.0, fade_db)
        return round(signal(right, above) + fade[0] + chance.gauss(0.0, noise_db))

    return heard_db


def test_without_noise_it_is_exact_and_tells_width_and_play() -> None:
    found = middle(cross(bell(3.0, -4.0), play_deg=1.5), BEAM_DEG)
    assert (found.right_deg, found.above_deg) == pytest.approx((3.0, -4.0), abs=0.02)
    assert found.beam_deg == pytest.approx((BEAM_DEG, BEAM_DEG), abs=0.3)
    assert found.play_deg == pytest.approx((1.5, 1.5), abs=0.1)
    assert found.doubt_deg < 0.2


@pytest.mark.parametrize("beam_deg", [3.0, 40.0])
def test_a_beam_of_another_width_than_the_file_says_is_found(beam_deg: float) -> None:
    found = middle(cross(bell(0.2 * beam_deg, 0.1 * beam_deg, 1.5 * beam_deg), beam_deg), beam_deg)
    assert (found.right_deg, found.above_deg) == pytest.approx((0.2 * beam_deg, 0.1 * beam_deg), abs=0.01 * beam_deg)


@pytest.mark.search
def test_in_noise_and_fading_it_is_within_its_own_doubt() -> None:
    """One cross, without the one that refines: half of all are nearer than 7 % of the beam."""
    offs, surprise = [], []
    for seed in range(examples(80)):
        chance = random.Random(seed)
        true = chance.uniform(-8, 8), chance.uniform(-8, 8)
        signal = faded(bell(*true), chance, chance.uniform(0, 3), 0.7, chance.uniform(0, 0.9))
        found = middle(cross(signal), BEAM_DEG)
        right, above = found.right_deg - true[0], found.above_deg - true[1]
        offs.append(math.hypot(right, above) / BEAM_DEG)
        surprise += [right / found.right_doubt_deg, above / found.above_doubt_deg]
    assert sorted(offs)[len(offs) // 2] < 0.07
    assert max(offs) < 0.25
    assert 0.5 < math.sqrt(sum(x * x for x in surprise) / len(surprise)) < 1.8


@pytest.mark.search
def test_fading_alone_is_never_taken_for_a_peak() -> None:
    """From all round, or from nowhere: what changes with time alone has no middle."""
    for seed in range(examples(80)):
        chance = random.Random(seed)
        level = faded(lambda _right, _above: -30.0, chance, chance.uniform(0, 4), 0.7, chance.uniform(0, 0.97))
        with pytest.raises(NoPeak):
            middle(cross(level), BEAM_DEG)


def test_a_strength_that_never_changes_asks_for_the_receiver() -> None:
    with pytest.raises(NoPeak, match="shows -54 dB everywhere"):
        middle(cross(lambda _right, _above: -54.0), BEAM_DEG)


def test_a_signal_that_only_grows_is_no_peak() -> None:
    growing = iter(range(100))
    with pytest.raises(NoPeak):
        middle(cross(lambda _right, _above: -40 + 0.2 * next(growing)), BEAM_DEG)
