"""What may hold an axis: its stops, beyond the limits, and what held it last."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.obstacles import HOLDS_DEG, RESTS_BEYOND_DEG, Obstacles
from rotator.control.sky.mount import Range

MINUS, _, PLUS = Direction


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_a_stop_may_hold_it_beyond_its_limit_alone(way: Direction) -> None:
    limit_deg = 450.0 if way is PLUS else 0.0
    obstacles = Obstacles(Range(0.0, 450.0))
    assert obstacles.free(way, limit_deg + way * (RESTS_BEYOND_DEG - 0.01))
    assert not obstacles.free(way, limit_deg + way * (RESTS_BEYOND_DEG + 0.01))
    assert obstacles.free(Direction(-way), limit_deg + way * 2.0)
    assert Obstacles(None).free(way, limit_deg + way * 2.0), "its limits are not known"


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_what_held_it_holds_it_until_it_is_a_degree_past_that(way: Direction) -> None:
    obstacles = Obstacles(None)
    obstacles.note(way, 100.0)
    assert not obstacles.free(way, 100.0 - way * (HOLDS_DEG - 0.01))
    assert obstacles.free(way, 100.0 - way * (HOLDS_DEG + 0.01))
    assert obstacles.free(Direction(-way), 100.0)
    obstacles.turned_to(100.0 + way * (HOLDS_DEG - 0.01))
    assert not obstacles.free(way, 100.0)
    obstacles.turned_to(100.0 + way * (HOLDS_DEG + 0.01))
    assert obstacles.free(way, 100.0)


def test_a_place_drifts_with_the_sensor_and_is_left_and_forgotten() -> None:
    obstacles = Obstacles(None)
    obstacles.note(PLUS, 100.0)
    obstacles.drift(5.0)
    assert (obstacles.free(PLUS, 100.0), obstacles.free(PLUS, 105.0)) == (True, False)
    obstacles.left(105.5)
    assert not obstacles.free(PLUS, 105.0)
    obstacles.left(108.0)
    assert obstacles.free(PLUS, 105.0)
    obstacles.note(PLUS, 100.0)
    obstacles.forget(PLUS)
    assert obstacles.free(PLUS, 100.0)
    obstacles.note(PLUS, 100.0)
    obstacles.forget_all()
    assert obstacles.free(PLUS, 100.0)
