"""An axis driven against its stop or beyond its limits: two seconds in all, until a person lets it try again."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from tests.drills.judges.mast import STEP_S, Mast


def test_against_a_stop_once_for_two_seconds_in_all() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False  # the current in a motor that stands has a judge of its own
    mast.order("rotctld", "jog", "cw")
    assert mast.run(1.5, coil=1) == []
    mast.run(5.0)
    assert mast.run(1.5, coil=1) == [accusations.BEYOND]


def test_a_contact_that_opens_a_moment_after_its_coil_does_not_end_the_sum_at_a_stop() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False
    mast.order("rotctld", "jog", "cw")
    mast.run(1.5, coil=1)
    mast.run(STEP_S, coil=0, power=1)
    mast.run(5.0)
    assert mast.run(1.5, coil=1) == [accusations.BEYOND]


def test_against_a_stop_again_after_a_person() -> None:
    mast = Mast(at_deg=361.0)
    mast.case.feels = False
    mast.order("rotctld", "jog", "cw")
    mast.run(1.5, coil=1)
    mast.order("rotctld", "stop")
    mast.run(1.0)
    mast.order("rotctld", "jog", "cw")
    assert mast.run(1.5, coil=1) == []


@pytest.mark.parametrize("ends", ["stop", "program"])
def test_against_its_stop_again_and_again_though_no_person_has_let_it_go(ends: str) -> None:
    mast = Mast(at_deg=361.0)
    found: list[str] = []
    for _ in range(8):
        mast.order("rotctld", "jog", "cw")
        found += mast.run(1.0, coil=1)
        if ends == "stop":
            mast.order("gs232b", "stop")
        else:
            mast.orders.forget_all(mast.now_s)
        mast.run(1.0)
    assert accusations.BEYOND in found


def test_a_person_lets_it_go_against_its_stop_again() -> None:
    mast = Mast(at_deg=361.0)
    for _ in range(8):
        mast.order("rotctld", "jog", "cw")
        assert mast.run(1.0, coil=1) == []
        mast.order("console", "resume")
        assert mast.run(1.0) == []


def test_beyond_its_limits_before_the_stop() -> None:
    mast = Mast(at_deg=361.0)
    mast.azimuth.stop_high_deg = 400.0
    mast.order("rotctld", "jog", "cw")
    assert mast.run(4.0, coil=1) == [accusations.BEYOND]


def test_a_person_who_sets_an_axis_up_may_press_it_into_its_stop_again_and_again() -> None:
    mast = Mast(at_deg=361.0, lacking="azimuth")
    mast.case.feels = False
    for _ in range(5):
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1) == []
        mast.run(1.0)


def test_limit_switches_show_the_ends_of_an_axis_that_was_never_set_up() -> None:
    mast = Mast(at_deg=361.0, lacking="azimuth")
    mast.case.feels, mast.case.shown_ends = False, (1,)
    mast.order("console", "jog", "cw", 2.0)
    mast.run(2.0, coil=1)
    mast.run(1.0)
    mast.order("console", "jog", "cw", 2.0)
    assert mast.run(1.0, coil=1) == [accusations.BEYOND]


def test_a_limit_switch_shows_nothing_of_an_axis_that_stands_elsewhere() -> None:
    """Its motor is stalled in mid-range, or it presses on the other stop: each press of a person counts for itself."""
    for at_deg, ends in ((200.0, (1, -1)), (361.0, (-1,))):
        mast = Mast(at_deg=at_deg, lacking="azimuth")
        mast.case.shown_ends = ends
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1, dps=0.0) == []
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(2.0, coil=1, dps=0.0) == []
