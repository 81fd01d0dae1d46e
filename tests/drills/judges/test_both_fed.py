"""Both directions of a motor fed at once: a weld excuses it only where nothing could show the weld."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from tests.drills.judges.mast import STEP_S, Mast


def test_both_directions_fed() -> None:
    mast = Mast()
    mast.azimuth.shorted_s = 0.001
    assert mast.run(STEP_S) == [accusations.BOTH_FED]


def test_a_relay_that_welds_at_a_stop_in_a_calibration_is_left_to_the_person_who_watches() -> None:
    for at_deg, found in ((362.0, []), (300.0, [accusations.BOTH_FED])):
        mast = Mast(at_deg=at_deg, lacking="azimuth", master=True)
        mast.azimuth.welded, mast.azimuth.shorted_s = True, 0.001
        assert mast.run(STEP_S) == found


def test_opposite_relays_that_meet_at_a_stop_are_excused_only_by_a_weld() -> None:
    for welded, found in ((True, []), (False, [accusations.BOTH_FED])):
        mast = Mast(at_deg=362.0, lacking="azimuth")
        mast.azimuth.welded, mast.azimuth.shorted_s = welded, 0.1
        assert mast.run(STEP_S) == found


@pytest.mark.parametrize(("ran_on_s", "excused"), [(0.5, True), (1.0, False)])
def test_what_holds_a_welded_axis_within_its_coast_cannot_be_told_from_a_coast(ran_on_s: float, excused: bool) -> None:
    mast = Mast()
    mast.case.misplaced = True
    mast.azimuth.welded = True
    mast.order("gs232b", "aim", 300.0, 0.0)
    mast.run(2.0, coil=1)
    mast.order("gs232b", "stop")
    mast.run(ran_on_s, coil=0, power=1)
    mast.azimuth.stop_high_deg = mast.azimuth.shaft_deg
    mast.run(2.0, coil=0, power=1, dps=0.0)
    mast.order("gs232b", "aim", 10.0, 0.0)
    mast.run(STEP_S, coil=-1, power=1, dps=0.0)
    mast.azimuth.shorted_s = 0.02
    assert (accusations.BOTH_FED in mast.run(STEP_S, coil=-1, power=0)) is not excused
