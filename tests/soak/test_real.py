"""What the soak finds wrong in what it has read: growth, a lost thread, a leaked file."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import pytest

from benchmarks.soak.box import Held
from benchmarks.soak.soaked import Soaked, judge
from benchmarks.soak.words import WORDS
from rotator.config.links import ProtocolName

BOUT_S = 120.0
OWN = ("MainThread", "control", "guard", "sensors")
HELD = 30


def soaked(kib_per_h: float = 0.0, *, noise_kib: int = 0) -> Soaked:
    """An hour, one reading every two minutes; every seventh is odd by the noise."""
    held = []
    for count in range(1, HELD + 1):
        at_s = count * BOUT_S
        grown_kib = int(kib_per_h * at_s / 3600) + (noise_kib if count % 7 == 0 else 0)
        early_kib = 3000 if at_s < 600 else 0  # what is filled in the first minutes does not count
        held.append(Held(at_s, 40_000 - early_kib + grown_kib, 250_000, 33, 44, (*OWN, "asyncio_0")))
    return Soaked(held=held, lasted_s=HELD * BOUT_S)


@pytest.mark.parametrize(("kib_per_h", "wrong"), [(0.0, False), (900.0, False), (1150.0, True), (5000.0, True)])
def test_memory_may_grow_by_a_mebibyte_an_hour(kib_per_h: float, wrong: bool) -> None:
    seen = soaked(kib_per_h)
    judge(seen)
    assert bool(seen.found) is wrong


@pytest.mark.parametrize(
    ("threads", "says"),
    [(OWN[:-1], "lost ['sensors'], new []"), ((*OWN, "stray"), "lost [], new ['stray']")],
)
def test_a_thread_that_is_missing_once_or_new_is_told(threads: tuple[str, ...], says: str) -> None:
    seen = soaked()
    seen.held[20] = replace(seen.held[20], threads=threads)
    judge(seen)
    (found,) = seen.found
    assert says in found


@pytest.mark.parametrize(
    ("more", "says"),
    [({"files": 45}, "file descriptors grew from 44 to 45"), ({"tasks": 34}, "asyncio tasks grew from 33 to 34")],
)
def test_one_file_or_task_that_stays_is_growth_and_one_that_passes_is_none(more: dict[str, int], says: str) -> None:
    seen = soaked()
    seen.held[12] = replace(seen.held[12], **more)  # type: ignore[arg-type]
    judge(seen)
    assert seen.found == []
    seen.held[12:] = [replace(each, **more) for each in seen.held[12:]]  # type: ignore[arg-type]
    judge(seen)
    assert seen.found == [says]


def test_no_protocol_is_left_out() -> None:
    assert {words.protocol for words in WORDS} == set(get_args(ProtocolName))
