"""The plan of many passes is flown by the box itself, while no other sender has the antenna."""

from __future__ import annotations

import pytest

from rotator.orders import Aim, Release, Source, Stop
from tests.tracking.tracked_box import Box, pass_of

FOLLOWS_ISS = """
[[sky.follow]]
name = "iss"
"""
PC, PERSON = Source("gs232b", 1), Source("console", 1)


@pytest.fixture
def rise() -> Box:
    """Three minutes before the ISS rises."""
    found = pass_of("iss")
    assert found.aos_s is not None
    return Box(found.aos_s - 180.0, follow=FOLLOWS_ISS)


def test_it_sets_off_in_time_and_stands_waiting_15_s_before_the_rise(rise: Box) -> None:
    assert rise.loop.status.controlled_by == "", "not before it has to"
    rise.wait(164.0)
    status = rise.loop.status
    assert status.controlled_by == "track"
    assert status.flown is not None
    assert status.flown.name.startswith("ISS")
    assert not status.moving
    rise.wait(60.0)
    assert rise.off_deg("iss") < 5.0


@pytest.mark.parametrize(("source", "order"), [(PC, Aim(100.0, 10.0)), (PERSON, Stop(latch=True))])
def test_who_takes_the_antenna_has_it_for_ten_minutes_and_the_next_pass_is_flown_again(
    rise: Box, source: Source, order: Aim | Stop
) -> None:
    rise.wait(170.0)
    rise.loop.post(source, order)
    rise.wait(10.0)
    rise.loop.post(PERSON, Release())
    rise.wait(60.0)
    assert rise.loop.status.controlled_by != "track"
    rise.set_clock(24 * 3600.0)
    rise.wait(500.0)
    assert rise.loop.status.controlled_by != "track"
    found = pass_of("iss", after_s=rise.utc_s + 120.0)
    assert found.aos_s is not None
    rise.set_clock(found.aos_s - rise.utc_s - 120.0)
    rise.wait(110.0)
    assert rise.loop.status.controlled_by == "track"


def test_a_stop_that_comes_while_it_plans_is_not_undone_by_the_plan(rise: Box) -> None:
    def meanwhile() -> None:
        if rise.utc_s > set_off_s:
            rise.loop.post(PC, Stop())
            rise.loop.cycle()

    set_off_s = rise.utc_s + 60.0
    rise.planner.meanwhile = meanwhile
    rise.wait(175.0)
    assert rise.loop.status.flown is None
    assert rise.loop.status.controlled_by == ""


def test_off_ends_it_and_plan_begins_it_again(rise: Box) -> None:
    rise.wait(170.0)
    rise.tracker.off()
    rise.wait(30.0)
    assert rise.loop.status.flown is None
    assert rise.tracker.track("plan") == ""
    rise.wait(5.0)
    assert rise.loop.status.flown is not None


def test_a_target_that_a_person_names_comes_before_the_plan(rise: Box) -> None:
    assert rise.tracker.track("moon") == ""
    rise.wait(175.0)
    assert rise.loop.status.flown is not None
    assert rise.loop.status.flown.name == "Moon"


def test_while_the_clock_may_be_wrong_nothing_moves(rise: Box) -> None:
    rise.clock_trusted = False
    rise.wait(170.0)
    assert rise.loop.status.controlled_by == ""
