"""Where an axis rests, from where it was driven unseen, and what may hold it."""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.standing import BEYOND_DEG, HOLDS_DEG, Obstacles, Rest, RestPlace
from rotator.control.sky.mount import Range

MINUS, _, PLUS = Direction
NOISE_DEG = 0.1


def stood(place: RestPlace, angle_deg: float, at_s: float = 10.0, readings: int = 10) -> float:
    """It is read there, and then found to stand. Returns the drift."""
    for _ in range(readings):
        place.see(angle_deg)
    return place.stand(at_s)


def test_when_it_comes_to_rest_the_readings_of_its_coast_do_not_count() -> None:
    place = RestPlace()
    for angle_deg in (90.0, 95.0, 99.0, 100.0, 100.0, 100.0):
        place.see(angle_deg)
    assert place.stand(10.0) == 0.0
    assert (place.at_deg, place.since_s) == (100.0, 10.0)


def test_it_stands_since_it_first_did_and_a_slow_change_is_a_drift() -> None:
    place = RestPlace()
    stood(place, 100.0, at_s=10.0, readings=20)
    assert stood(place, 100.2, at_s=12.0, readings=20) == pytest.approx(0.2)
    assert (place.at_deg, place.since_s) == (pytest.approx(100.2), 10.0)


def test_driven_or_moved_it_stands_nowhere() -> None:
    for leave in (RestPlace.driven, RestPlace.moved):
        place = RestPlace()
        stood(place, 100.0)
        leave(place)
        assert (place.at_deg, place.since_s) == (None, None)


@pytest.mark.parametrize(("now_deg", "left_deg"), [(100.05, None), (101.0, 100.0)])
def test_a_run_that_was_not_seen_to_turn_it_has_moved_it_where_the_place_differs(
    now_deg: float, left_deg: float | None
) -> None:
    place = RestPlace()
    stood(place, 100.0)
    assert place.left_deg(NOISE_DEG) is None
    place.driven()
    stood(place, now_deg)
    assert place.left_deg(NOISE_DEG) == left_deg
    assert place.left_deg(NOISE_DEG) is None, "from then on it stands here"


def test_a_run_that_was_seen_to_turn_it_asks_no_such_question() -> None:
    place = RestPlace()
    stood(place, 100.0)
    place.left_deg(NOISE_DEG)
    place.driven()
    place.turned()
    stood(place, 120.0)
    assert place.left_deg(NOISE_DEG) is None


def test_where_a_run_held_it_is_where_it_was() -> None:
    place = RestPlace()
    place.held(100.0, 3)
    place.held(130.0, 3)
    stood(place, 101.0)
    assert place.left_deg(NOISE_DEG) == 100.0


def test_two_places_differ_by_four_standard_errors() -> None:
    rest = Rest(100.0, 8)
    assert not rest.differs(Rest(100.199, 8), NOISE_DEG)
    assert rest.differs(Rest(100.201, 8), NOISE_DEG)


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
def test_a_stop_may_hold_it_beyond_its_limit_alone(way: Direction) -> None:
    limit_deg = 450.0 if way is PLUS else 0.0
    obstacles = Obstacles(Range(0.0, 450.0))
    assert obstacles.free(way, limit_deg + way * (BEYOND_DEG - 0.01))
    assert not obstacles.free(way, limit_deg + way * (BEYOND_DEG + 0.01))
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
    obstacles.left(106.0, 2.0)
    assert not obstacles.free(PLUS, 105.0)
    obstacles.left(108.0, 2.0)
    assert obstacles.free(PLUS, 105.0)
    obstacles.note(PLUS, 100.0)
    obstacles.forget(PLUS)
    assert obstacles.free(PLUS, 100.0)
    obstacles.note(PLUS, 100.0)
    obstacles.forget_all()
    assert obstacles.free(PLUS, 100.0)
