"""How long a motor may run: running fills the count, standing empties it."""

from __future__ import annotations

import pytest

from rotator.control.axis.endurance import Endurance


def after(endurance: Endurance, *spells: tuple[float, bool]) -> bool:
    now_s = 0.0
    for seconds, running in spells:
        endurance.note(now_s, running=running)
        now_s += seconds
        endurance.note(now_s, running=running)
    return endurance.resting


@pytest.mark.parametrize(
    ("spells", "resting"),
    [
        ([(299.0, True)], False),
        ([(300.0, True)], True),
        ([(200.0, True), (150.0, False), (140.0, True)], False),  # 150 s of standing make up for 50 s of running
        ([(200.0, True), (150.0, False), (151.0, True)], True),
        ([(300.0, True), (440.0, False)], True),
        ([(300.0, True), (451.0, False)], False),
        ([(60.0, True), (180.0, False)] * 20, False),
    ],
)
def test_running_fills_and_standing_empties(spells: list[tuple[float, bool]], resting: bool) -> None:
    endurance = Endurance(300.0, 900.0)
    assert after(endurance, *spells) is resting
    assert bool(endurance.notice) is resting


def test_no_limit_is_no_limit() -> None:
    assert not after(Endurance(0.0, 900.0), (100_000.0, True))
