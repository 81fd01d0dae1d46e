"""A goal of one axis: converted angle by angle, and without its path."""

from __future__ import annotations

from rotator.control.sky.goal import EVEN, AimGoal
from rotator.control.sky.plan import OFFSETS_S, Path

STANDS = AimGoal(100.0, 4.0)
MOVES = AimGoal(100.0, 0.3, Path(50.0, [100.0 + offset_s for offset_s in OFFSETS_S], EVEN))


def test_each_of_its_angles_is_converted_and_nothing_else() -> None:
    assert STANDS.mapped(lambda angle_deg: angle_deg + 3.0) == AimGoal(103.0, 4.0)
    shifted = MOVES.mapped(lambda angle_deg: 2.0 * angle_deg)
    assert (shifted.target_deg, shifted.tolerance_deg) == (200.0, 0.3)
    assert shifted.path == Path(50.0, [2.0 * (100.0 + offset_s) for offset_s in OFFSETS_S], EVEN)


def test_standing_it_keeps_its_target_and_has_no_path() -> None:
    assert STANDS.standing() is STANDS
    assert MOVES.standing() == AimGoal(100.0, 0.3)


def test_all_angles_of_a_path_count_alike() -> None:
    assert set(EVEN) == {1.0}
    assert len(EVEN) == len(OFFSETS_S)
