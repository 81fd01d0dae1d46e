"""An axis driven away from its target: excused at an end of the range where the target is expected across it."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from tests.drills.judges.mast import Mast


def test_a_right_move_is_no_violation() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(16.0, coil=1) == []
    mast.order("rotctld", "stop")
    assert mast.run(0.2, coil=1) == []
    assert mast.run(60.0) == []


def test_away_from_the_target() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(2.0, coil=-1)
    assert mast.run(2.5, coil=-1) == [accusations.AWAY]


def test_towards_the_other_turn_of_the_target_is_not_away() -> None:
    mast = Mast(top_deg=450.0)
    mast.order("rotctld", "aim", 20.0, 0.0)
    assert mast.run(10.0, coil=1) == []


@pytest.mark.parametrize(("wavered", "found"), [(0, [accusations.AWAY]), (1, [])])
def test_to_the_end_of_the_range_where_a_target_beyond_it_is_waited_for(wavered: int, found: list[str]) -> None:
    mast = Mast(at_deg=300.0)
    for azimuth_deg in (350.0, 20.0) * (1 + wavered):
        mast.order("rotctld", "aim", azimuth_deg, 0.0)
    assert mast.run(4.0, coil=1) == found


def test_another_target_is_not_waited_for() -> None:
    mast = Mast(at_deg=300.0)
    for azimuth_deg in (350.0, 20.0, 350.0, 200.0):
        mast.order("rotctld", "aim", azimuth_deg, 0.0)
    assert mast.run(4.0, coil=1) == [accusations.AWAY]


def test_a_target_that_wavers_across_the_end_is_waited_for_there_after_its_first_swing() -> None:
    for before_deg, found in (((), [accusations.AWAY]), ((346.0, 5.0), []), ((200.0, 5.0), [accusations.AWAY])):
        mast = Mast(at_deg=60.0)
        for azimuth_deg in (5.0, *before_deg, 346.0):
            mast.order("rotctld", "aim", azimuth_deg, 0.0)
        assert mast.run(4.0, coil=-1) == found


def test_a_target_that_moves_across_the_end_is_followed_to_that_end_and_one_that_jumps_is_not() -> None:
    for steps_deg, found in (([340.0, 345.0, 350.0, 355.0, 2.0], []), ([300.0, 20.0, 20.0], [accusations.AWAY])):
        mast = Mast(at_deg=200.0)
        for azimuth_deg in steps_deg:
            mast.order("rotctld", "aim", azimuth_deg, 0.0)
            assert mast.run(1.0, coil=1) == []
        assert mast.run(3.0, coil=1) == found
