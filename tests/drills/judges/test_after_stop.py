"""An axis that moves after its stop, after the end of its press or lease, or by a welded relay beside a master."""

from __future__ import annotations

import pytest

from benchmarks.drills import accusations
from tests.drills.judges.mast import Mast


@pytest.mark.parametrize("who", ["rotctld", "console"])
def test_driven_after_a_stop(who: str) -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.run(1.0, coil=1)
    mast.order(who, "stop")
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_no_order_counts_while_a_person_holds_it() -> None:
    mast = Mast()
    mast.order("console", "stop")
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_driven_longer_than_the_last_lease() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.judges.unattended_s = mast.now_s
    assert mast.run(0.9, coil=1) == []
    assert mast.run(0.2, coil=1) == [accusations.AFTER_STOP]


def test_a_press_of_an_axis_that_was_never_set_up_turns_it_two_seconds_in_all_also_when_it_begins_late() -> None:
    mast = Mast(lacking="azimuth")
    mast.order("console", "jog", "cw", 5.0)
    mast.run(3.0)
    assert mast.run(2.3, coil=1) == []
    assert mast.run(0.5, coil=1) == [accusations.AFTER_STOP]


def test_the_panels_jog_switch_is_let_go() -> None:
    mast = Mast()
    mast.order("panel", "mode", "jog")
    mast.run(2.0)
    mast.order("panel", "jog", "cw", 1.0)
    assert mast.run(1.3, coil=1) == []
    assert mast.run(0.5, coil=1) == [accusations.AFTER_STOP]


def test_the_stop_button_stays_in_force_when_it_is_let_go() -> None:
    mast = Mast()
    mast.order("rotctld", "aim", 200.0, 0.0)
    mast.order("panel", "stop", "press")
    mast.run(1.0)
    mast.order("panel", "stop", "release")
    mast.order("rotctld", "aim", 200.0, 0.0)
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_a_turn_of_the_mode_switch_releases_a_stop() -> None:
    mast = Mast()
    mast.order("console", "stop")
    mast.order("panel", "mode", "manual")
    mast.run(2.0)
    mast.order("panel", "knob", "azimuth", 0.5)
    assert mast.run(2.0, coil=1) == []


def test_a_turn_of_the_mode_switch_while_the_stop_button_is_pressed_releases_nothing() -> None:
    mast = Mast()
    mast.order("panel", "stop", "press")
    mast.order("panel", "mode", "manual")
    mast.run(2.0)
    mast.order("panel", "stop", "release")
    mast.order("panel", "knob", "azimuth", 0.5)
    assert mast.run(0.6, coil=1) == [accusations.AFTER_STOP]


def test_a_welded_relay_with_a_master_and_without() -> None:
    assert Mast(master=True).run(2.5, coil=0, power=1) == [accusations.AFTER_STOP]
    assert Mast(master=False).run(60.0, coil=0, power=1) == []


def test_a_welded_motor_has_its_time_again_when_its_supply_comes_back() -> None:
    mast = Mast(master=True)
    for _ in range(3):
        assert mast.run(1.9, coil=0, power=1) == []
        mast.run(10.0)
    assert mast.run(2.5, coil=0, power=1) == [accusations.AFTER_STOP]
