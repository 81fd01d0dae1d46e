"""Current in a motor that stands: two seconds a try and three tries, until a person allows more."""

from __future__ import annotations

from benchmarks.drills import accusations
from tests.drills.judges.mast import Mast


def test_current_in_a_motor_that_stands() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(2.0, coil=1, dps=0.0) == []
    assert mast.run(0.3, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_an_order_after_a_stop_is_another_try_though_the_current_never_ends() -> None:
    mast = Mast()
    for _ in range(3):
        mast.order("rotctld", "aim", 200.0, 0.0)
        assert mast.run(1.9, coil=1, dps=0.0) == []
        mast.order("rotctld", "stop")
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(0.6, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_four_tries_in_ten_minutes() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    for _ in range(3):
        assert mast.run(1.0, coil=1, dps=0.0) == []
        mast.run(60.0)
    assert mast.run(1.0, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]


def test_a_person_may_try_again() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    for _ in range(9):
        assert mast.run(1.0, coil=1, dps=0.0) == []
        mast.run(60.0)
        mast.order("console", "resume")


def test_a_restart_of_the_program_is_no_new_beginning_of_tries() -> None:
    mast = Mast()
    found: list[str] = []
    for _ in range(4):
        mast.order("rotctld", "aim", 300.0, 0.0)
        found += mast.run(1.0, coil=1, dps=0.0)
        mast.orders.forget_all(mast.now_s)
        mast.run(5.0)
    assert found == [accusations.STANDING_CURRENT]


def test_presses_of_an_axis_that_was_never_set_up_count_each_for_itself() -> None:
    mast = Mast(lacking="azimuth")
    for _ in range(9):
        mast.order("console", "jog", "cw", 2.0)
        assert mast.run(1.9, coil=1, dps=0.0) == []
        mast.run(1.0)
    mast.order("console", "jog", "cw", 2.0)
    assert mast.run(2.3, coil=1, dps=0.0) == [accusations.STANDING_CURRENT]
