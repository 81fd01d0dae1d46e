"""Moves of a drive that did not bring the axis nearer, and a target that moves away from an axis that stands."""

from __future__ import annotations

import pytest

from rotator.control.axis.vain_runs import LeftBehind, VainMoves

COMING_DEG = 0.5


def moved(vain: VainMoves, begun_s: float, lasts_s: float, nearer_deg: tuple[float, ...] = (0.0,)) -> None:
    """One move: how much nearer it has come, in all, look by look; then its drive holds."""
    vain.see(begun_s, nearer_deg[0], COMING_DEG, begins=True)
    for each_deg in nearer_deg:
        vain.see(begun_s + lasts_s, each_deg, COMING_DEG, begins=False)
    vain.hold()


def test_each_move_that_brings_it_no_nearer_counts_once() -> None:
    vain = VainMoves()
    assert (vain.count, vain.any) == (0, False)
    for count in range(1, 4):
        moved(vain, 10.0 * count, 2.0)
        vain.hold()
        assert (vain.count, vain.any) == (count, True)


def test_the_present_move_is_one_that_has_not_brought_it_nearer_yet() -> None:
    vain = VainMoves()
    vain.see(5.0, 0.0, COMING_DEG, begins=True)
    assert (vain.count, vain.any) == (0, True)
    vain.see(5.5, 0.5, COMING_DEG, begins=False)
    assert not vain.any


@pytest.mark.parametrize(("lasts_s", "count"), [(0.3, 0), (0.4, 1)])
def test_a_move_in_which_the_motor_may_not_have_started_does_not_count(lasts_s: float, count: int) -> None:
    vain = VainMoves()
    moved(vain, 0.0, lasts_s)
    assert (vain.count, vain.any) == (count, count > 0)


@pytest.mark.parametrize(
    ("nearer_deg", "count"), [((3.0, 3.4), 3), ((3.0, 3.5), 0), ((3.0, 2.0, 2.4), 3), ((3.0, 2.0, 2.5), 0)]
)
def test_coming_nearer_than_the_worst_of_this_move_forgets_those_in_vain(
    nearer_deg: tuple[float, ...], count: int
) -> None:
    """The wind may have turned it away first."""
    vain = VainMoves()
    moved(vain, 0.0, 2.0)
    moved(vain, 10.0, 2.0)
    moved(vain, 20.0, 2.0, nearer_deg)
    assert vain.count == count


def test_a_move_that_came_nearer_is_not_in_vain_also_if_the_axis_goes_away_again() -> None:
    vain = VainMoves()
    moved(vain, 0.0, 9.0, (0.0, 0.6, 0.6, 0.0))
    assert (vain.count, vain.any) == (0, False)


def test_a_fault_has_counted_them() -> None:
    vain = VainMoves()
    moved(vain, 0.0, 2.0)
    vain.see(10.0, 0.0, COMING_DEG, begins=True)
    vain.struck()
    assert (vain.count, vain.any) == (0, False)
    vain.hold()
    assert vain.count == 0


# --- left behind


def seconds(left: LeftBehind, sent_s: float, target_deg: float, place_deg: float = 100.0) -> float:
    return left.seconds(sent_s, target_deg, place_deg, moved_deg=0.3, apart_deg=2.0)


def test_it_is_left_behind_once_the_target_is_far_from_where_it_was_and_the_axis_has_not_moved() -> None:
    left = LeftBehind()
    assert [seconds(left, at_s, 100.0 + at_s) for at_s in (0.0, 1.0, 1.9)] == [0.0, 0.0, 0.0]
    assert [seconds(left, at_s, 100.0 + at_s) for at_s in (2.0, 2.5, 4.0)] == [0.0, 0.5, 2.0]


def test_a_target_that_swings_to_and_fro_is_as_far_apart_as_its_ends() -> None:
    left = LeftBehind()
    for at_s, target_deg in ((0.0, 100.0), (1.0, 101.2), (2.0, 99.1), (3.0, 100.0)):
        found = seconds(left, at_s, target_deg)
    assert found == 1.0


@pytest.mark.parametrize(("turned_deg", "behind_s"), [(0.2, 8.0), (-0.2, 8.0), (0.4, 0.0), (-0.4, 0.0)])
def test_an_axis_that_moves_begins_anew(turned_deg: float, behind_s: float) -> None:
    left = LeftBehind()
    seconds(left, 0.0, 100.0)
    seconds(left, 2.0, 102.0)
    assert seconds(left, 10.0, 104.0, 100.0 + turned_deg) == behind_s


def test_sent_to_another_place_it_begins_anew() -> None:
    left = LeftBehind()
    seconds(left, 0.0, 100.0)
    seconds(left, 2.0, 105.0)
    left.begin()
    assert seconds(left, 9.0, 105.0) == 0.0
    assert seconds(left, 19.0, 106.0) == 0.0
