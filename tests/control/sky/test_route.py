"""The way through the rest of a pass: which turn of the overlap, and whether over the top."""

from __future__ import annotations

import pytest

from rotator.control.sky.mount import Mount, Range
from rotator.control.sky.route import STEP_S, Speeds, Way, best_way
from tests.tables import every_row

G5500 = Mount(Range(0.0, 450.0), Range(0.0, 180.0))
NO_OVERLAP = Mount(Range(0.0, 360.0), Range(0.0, 180.0), flip=True)
SPEEDS = Speeds(6.0, 2.7)


def through(first_deg: float, dps: float, looks: int, elevation_deg: float = 20.0) -> list[tuple[float, float]]:
    return [((first_deg + dps * STEP_S * look) % 360.0, elevation_deg) for look in range(looks)]


def way(mount: Mount, directions: list[tuple[float, float]], present: Way, *, may_flip: bool = False) -> Way:
    return best_way(mount, directions, present, SPEEDS, may_flip=may_flip)


def test_a_pass_within_the_range_stays_on_its_turn() -> None:
    present = Way(50.0, flipped=False)
    assert way(G5500, through(50.0, 1.0, 40), present) == present


def test_a_pass_that_will_leave_the_range_begins_on_the_other_turn() -> None:
    """Clockwise from 80° on the overlap's turn, 440° on the scale: the end of the scale is 10° away."""
    assert way(G5500, through(80.0, 1.0, 40), Way(440.0, flipped=False)) == Way(80.0, flipped=False)


def test_counter_clockwise_through_the_north_from_the_low_turn_it_takes_the_overlap() -> None:
    assert way(G5500, through(20.0, -1.0, 40), Way(20.0, flipped=False)) == Way(380.0, flipped=False)


def test_when_the_pass_is_nearly_over_no_change_is_worth_it() -> None:
    present = Way(440.0, flipped=False)
    assert way(G5500, through(80.0, 1.0, 4), present) == present


def test_a_change_is_not_made_before_its_best_moment() -> None:
    """The target stands high first, where a change costs nothing later: the change can wait."""
    low_later = [(80.0, 20.0)] * 20 + through(80.0, 1.0, 40)
    assert way(G5500, low_later, Way(440.0, flipped=False)) in (Way(440.0, flipped=False), Way(80.0, flipped=False))
    while_it_stands = [(80.0, 20.0)] * 100
    assert way(G5500, while_it_stands, Way(440.0, flipped=False)) == Way(440.0, flipped=False)


@pytest.mark.parametrize("may_flip", [False, True])
def test_over_the_top_only_where_it_may(may_flip: bool) -> None:
    """Through north on a rotor that ends there: half a turn and over the top is nearer than a whole turn."""
    directions = through(340.0, 1.0, 40, elevation_deg=70.0)
    found = way(NO_OVERLAP, directions, Way(340.0, flipped=False), may_flip=may_flip)
    assert found.flipped is may_flip


def test_a_mount_that_must_not_go_over_the_top_never_does() -> None:
    mount = Mount(Range(0.0, 360.0), Range(0.0, 180.0), flip=False)
    found = way(mount, through(340.0, 1.0, 40, elevation_deg=70.0), Way(340.0, flipped=False), may_flip=True)
    assert not found.flipped


def test_what_is_below_the_horizon_is_not_lost() -> None:
    """Elevation rests at its minimum there: that is as well as it can be."""
    present = Way(100.0, flipped=False)
    assert way(NO_OVERLAP, [(100.0, -30.0)] * 60, present, may_flip=True) == present


def test_without_a_path_ahead_everything_stays() -> None:
    present = Way(440.0, flipped=False)
    assert way(G5500, [(80.0, 20.0)], present) == present


@pytest.mark.parametrize(("elevation_dps", "flipped"), [(2.7, True), (2.0, False)])
def test_of_two_changes_the_one_that_takes_less_time_is_made(elevation_dps: float, flipped: bool) -> None:
    """Through north at 20° of elevation: a whole turn takes 60 s; over the top 140° of elevation take 52 s, or 70."""
    speeds = Speeds(6.0, elevation_dps)
    found = best_way(NO_OVERLAP, through(361.0, 1.0, 30), Way(361.0, flipped=False), speeds, may_flip=True)
    assert found == (Way(181.0, flipped=True) if flipped else Way(1.0, flipped=False))


@every_row("before_deg", [-4.0, -1.0, 1.0, 4.0, 20.0, 60.0])
def test_a_change_to_a_way_that_does_not_reach_the_target_yet_waits_for_the_end_of_the_range(before_deg: float) -> None:
    """Begun earlier it would save nothing, and the target may turn back."""
    first_deg = 360.0 - before_deg
    present = Way(first_deg, flipped=False)
    changes = way(NO_OVERLAP, through(first_deg, 1.0, 40), present) != present
    assert changes is (before_deg < 0.0)
