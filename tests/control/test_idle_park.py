"""When the idle time begins, what prolongs it, and what ends it: the object alone, in time that is handed to it."""

from __future__ import annotations

import random

import pytest

from rotator.control.idle_park import CONTINUES_S, IdlePark

AFTER_S = 60.0


@pytest.fixture
def idle() -> IdlePark:
    return IdlePark(AFTER_S)


def parks_at(idle: IdlePark, *, until_s: float, busy: tuple[tuple[float, float], ...] = ()) -> float | None:
    """The first whole second at which it parks; None: it does not. `busy`: from when to when the antenna is."""
    for now_s in range(round(until_s)):
        if idle.due(now_s, busy=any(begin_s <= now_s < end_s for begin_s, end_s in busy)):
            return now_s
    return None


def test_where_the_file_asks_for_no_idle_time_it_does_not_park() -> None:
    idle = IdlePark(0.0)
    idle.ordered(0.0)
    assert parks_at(idle, until_s=300.0) is None


def test_a_motor_that_starts_within_ten_seconds_still_carries_out_the_order(idle: IdlePark) -> None:
    idle.ordered(0.0)
    assert not idle.due(CONTINUES_S, busy=True)
    assert not idle.due(CONTINUES_S + AFTER_S - 1.0, busy=False)
    assert idle.due(CONTINUES_S + AFTER_S, busy=False)


def test_after_an_end_it_waits_for_the_next_order_even_while_the_antenna_is_busy(idle: IdlePark) -> None:
    idle.ordered(0.0)
    idle.ended()
    assert parks_at(idle, until_s=300.0, busy=((0.0, 20.0),)) is None
    idle.ordered(300.0)
    assert idle.due(300.0 + AFTER_S, busy=False)


@pytest.mark.parametrize("seed", range(40))
def test_with_late_cycles_too_it_never_parks_before_the_order_has_been_done_for_its_time(
    idle: IdlePark, seed: int
) -> None:
    """A busy computer asks seldom. The order is carried out in pieces, with pauses that continue it."""
    chance = random.Random(seed)
    begin_s, pieces = 0.0, []
    for _ in range(chance.randrange(1, 6)):
        begin_s += chance.uniform(0.0, 0.4 * CONTINUES_S)
        pieces.append((begin_s, begin_s := begin_s + chance.uniform(10.0, 100.0)))
    idle.ordered(0.0)
    now_s, last_s = 0.0, 0.0
    while not idle.due(now_s, busy=any(low_s <= now_s < high_s for low_s, high_s in pieces)):
        last_s = max((now_s for low_s, high_s in pieces if low_s <= now_s < high_s), default=last_s)
        now_s += chance.choice((0.05, 0.05, 0.5, 3.0))
        if any(low_s + 5.0 < now_s < high_s - 25.0 for low_s, high_s in pieces) and chance.random() < 0.1:
            now_s += 20.0  # in the middle of a motion it had no turn
    assert now_s >= max(last_s, pieces[-1][1] - 4.0) + AFTER_S - 1e-9
