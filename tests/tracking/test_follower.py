"""The plan of many passes is flown by the box itself, while no other sender has the antenna."""

from __future__ import annotations

import logging
import re

import pytest

from rotator.assembly.settings import build_mount
from rotator.config.load import parse
from rotator.exchange.orders import Aim, GiveBack, Order, Release, Stop, Take
from rotator.exchange.sources import Source
from rotator.protocols.console_session import tracked
from rotator.protocols.methods import Track
from rotator.protocols.operating import Operating
from rotator.runtime.client import Client
from rotator.tracking.tracker import CLOCK_UNSURE
from rotator.views.words import rise_or_set
from tests.search import some
from tests.tables import every_row
from tests.tracking.tracked_box import FEBRUARY_S, Box, pass_of

FOLLOWS_ISS = """
[[sky.follow]]
name = "iss"
"""
PC, PERSON, PAGE = Source("gs232b", 1), Source("console", 1), Source("page", 1)


@pytest.fixture
def rise() -> Box:
    """The ISS rises in 110 s; the antenna, which is 220° away, sets off in 16 s."""
    found = pass_of("iss")
    assert found.aos_s is not None
    return Box(found.aos_s - 110.0, follow=FOLLOWS_ISS)


@pytest.mark.long
def test_it_sets_off_in_time_and_stands_waiting_15_s_before_the_rise(rise: Box) -> None:
    assert rise.loop.status.controlled_by == "", "not before it has to"
    rise.wait(1.0)
    assert rise.follower.upcoming is not None
    name, rises_utc_s = rise.follower.upcoming
    assert name.startswith("ISS")
    assert rises_utc_s == pytest.approx(rise.utc_s + 109.0, abs=20.0)
    rise.wait(93.0)
    status = rise.loop.status
    assert status.controlled_by == "track"
    assert status.flown is not None
    assert status.flown.name.startswith("ISS")
    assert not status.moving
    rise.wait(60.0)
    assert rise.off_deg("iss") < 5.0


@pytest.mark.long
def test_after_a_start_it_rests_for_ten_minutes_for_a_link_may_have_stopped_the_antenna_before() -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s - 180.0, follow=FOLLOWS_ISS, restarted=True)
    box.rest(590.0)
    assert box.world.antenna() == (10.0, 0.0)
    later = pass_of("iss", after_s=box.utc_s + 120.0)
    assert later.aos_s is not None
    box.set_clock(later.aos_s - box.utc_s - 120.0)
    box.wait(110.0)
    assert box.loop.status.controlled_by == "track"


@pytest.mark.search
@pytest.mark.parametrize(("source", "order"), some([(PERSON, Stop(latch=True)), (PC, Aim(100.0, 10.0))]))
def test_a_sender_that_takes_the_antenna_has_it_for_ten_minutes_and_the_next_pass_is_flown_again(
    rise: Box, source: Source, order: Aim | Stop
) -> None:
    rise.wait(100.0)
    rise.loop.post(source, order)
    rise.wait(10.0)
    rise.loop.post(PERSON, Release())
    rise.wait(60.0)
    assert rise.loop.status.controlled_by != "track"
    rise.set_clock(24 * 3600.0)
    rise.rest(500.0)
    assert rise.loop.status.controlled_by != "track"
    found = pass_of("iss", after_s=rise.utc_s + 120.0)
    assert found.aos_s is not None
    rise.set_clock(found.aos_s - rise.utc_s - 120.0)
    rise.wait(110.0)
    assert rise.loop.status.controlled_by == "track"


def test_a_stop_that_comes_while_it_plans_is_not_undone_by_the_plan(rise: Box) -> None:
    def meanwhile() -> None:
        if rise.utc_s > planned_s:
            rise.loop.post(PC, Stop())
            rise.loop.cycle()

    planned_s = rise.utc_s + 10.0
    rise.planner.meanwhile = meanwhile
    rise.wait(105.0)
    assert rise.loop.status.flown is None
    assert rise.loop.status.controlled_by == ""


def test_while_it_turns_to_a_pass_that_is_on_already_the_displays_count_to_its_setting() -> None:
    """The antenna is 220° away: it is there half a minute later, and the target does not rise then."""
    found = pass_of("iss")
    assert found.aos_s is not None
    assert found.los_s is not None
    box = Box(found.aos_s + 60.0, follow=FOLLOWS_ISS)
    box.wait(5.0)
    status = box.loop.status
    assert status.moving
    assert status.flown is not None
    assert status.at_s - status.flown.begin_s == pytest.approx(box.utc_s - found.aos_s, abs=1.0)
    assert status.flown.end_s - status.at_s == pytest.approx(found.los_s - box.utc_s, abs=1.0)
    assert tracked(status.flown, status.at_s).startswith("ISS, up for ")
    assert rise_or_set(status.flown, status.at_s).startswith("LOS ")


@pytest.mark.long
def test_when_a_person_has_given_the_antenna_back_the_plan_goes_on_at_once(rise: Box) -> None:
    rise.wait(100.0)
    rise.loop.post(PAGE, Take())
    rise.wait(20.0)
    assert rise.loop.status.flown is None
    rise.loop.post(PAGE, GiveBack())
    rise.wait(5.0)
    assert rise.loop.status.flown is not None
    assert rise.loop.status.controlled_by == "track"


@pytest.mark.long
def test_where_an_angle_is_not_known_at_its_first_look_it_looks_again_soon() -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    late = Box(found.aos_s - 110.0, follow=FOLLOWS_ISS, read_after_s=5.0)
    late.wait(100.0)
    assert late.loop.status.flown is not None


@pytest.mark.long
@pytest.mark.parametrize("wait_s", [5.0, 100.0])
def test_a_direction_that_a_person_asks_for_is_kept_before_and_during_a_flight(rise: Box, wait_s: float) -> None:
    rise.wait(wait_s)
    assert rise.tracker.track("100 20") == ""
    rise.wait(130.0)
    assert rise.world.antenna() == pytest.approx((100.0, 20.0), abs=4.0)
    assert rise.loop.status.flown is None
    assert "after an order of a person" in rise.tracker.state


def test_a_plan_that_could_not_be_made_is_tried_again_within_the_pass(rise: Box) -> None:
    """The process that plans may lack memory for a moment."""
    failures = ["its process has ended"]

    def meanwhile() -> None:
        if failures:
            raise RuntimeError(failures.pop())

    rise.planner.meanwhile = meanwhile
    rise.follower.plan_again()
    rise.wait(100.0)
    assert not failures
    assert rise.loop.status.flown is not None


def asks(rise: Box, source: Source | None = None) -> str:
    """A person asks for the plan, at the console or on the page. The answer: why not."""
    client = Client(rise.loop, build_mount(parse("", "box")), source or PERSON, clock=rise.clock)
    return Operating(client, rise.tracker, source).do(Track("plan"))


@pytest.mark.long
@pytest.mark.parametrize("words", ["moon", "180 45"])
def test_a_request_for_the_plan_ends_other_tracking_and_the_next_pass_is_flown(rise: Box, words: str) -> None:
    assert rise.tracker.track(words) == ""
    rise.wait(5.0)
    assert rise.loop.status.moving
    assert asks(rise) == ""
    rise.wait(8.0)
    assert rise.loop.status.flown is None
    assert not rise.loop.status.moving
    rise.wait(90.0)
    assert rise.loop.status.flown is not None
    assert rise.loop.status.flown.name.startswith("ISS")


@pytest.mark.long
def test_a_flight_that_no_plan_has_replaced_yet_ends_too(rise: Box) -> None:
    rise.tracker.track("moon")
    rise.wait(5.0)
    rise.tracker.track("so-50")
    assert asks(rise) == ""
    rise.wait(8.0)
    assert rise.loop.status.flown is None
    assert not rise.loop.status.moving


def test_a_second_request_for_the_plan_leaves_its_flight_alone(rise: Box) -> None:
    rise.wait(100.0)
    heard: list[Order] = []
    rise.after_heard = heard.append
    assert asks(rise) == ""
    rise.wait(5.0)
    assert heard == [GiveBack()]
    assert rise.loop.status.flown is not None


@pytest.mark.long
@pytest.mark.parametrize("source", [None, PAGE])
def test_a_request_for_the_plan_ends_its_rest(rise: Box, source: Source | None) -> None:
    rise.loop.post(source or PC, Aim(100.0, 10.0))
    rise.wait(5.0)
    assert asks(rise, source) == ""
    rise.wait(95.0)
    assert rise.loop.status.controlled_by == "track"
    assert rise.loop.status.held_by == ""


def test_while_the_plan_is_not_flown_the_reason_is_told() -> None:
    """Not where the file names no target, or a person tracks nothing."""
    restarted = Box(FEBRUARY_S, follow=FOLLOWS_ISS, restarted=True)
    told = r"rests: the plan rests for (10:00|9:\d\d) min more, after its start"
    assert re.fullmatch(told, restarted.tracker.state)
    box = Box(FEBRUARY_S, follow=FOLLOWS_ISS)
    assert box.tracker.state == "off"
    box.loop.post(PC, Aim(100.0, 10.0))
    box.wait(5.0)
    assert box.tracker.state.startswith("rests: the plan rests for 9:5")
    assert "after an order of gs232b#1" in box.tracker.state
    box.tracker.off()
    assert box.tracker.state == "off"
    assert asks(box) == ""
    box.wait(2.0)
    assert box.tracker.state == "off", "it flies, and waits for the rise"
    box.clock_trusted = False
    box.wait(2.0)
    assert box.tracker.state == f"rests: {CLOCK_UNSURE}"
    assert Box(FEBRUARY_S, restarted=True).tracker.state == "off"


def test_the_reason_why_the_plan_is_not_flown_is_logged() -> None:
    def told(follow: str) -> str:
        return asks(Box(FEBRUARY_S, follow=follow))

    assert told("") == "there is no plan: the file has no [[sky.follow]]"
    assert told('[[sky.follow]]\nname = "isx"').startswith('there is no plan: the first [[sky.follow]]: "isx" is not')
    held, unsure, faulty = (Box(FEBRUARY_S, follow=FOLLOWS_ISS) for _ in range(3))
    held.loop.post(PAGE, Take())
    held.wait(1.0)
    assert asks(held) == "page#1 holds the antenna: the plan is not flown before it is given back"
    assert asks(held, PAGE) == ""
    held.wait(1.0)
    assert asks(held) == ""
    unsure.clock_trusted = False
    assert asks(unsure) == CLOCK_UNSURE
    faulty.world.inject("azimuth-pot-open")
    faulty.wait(5.0)
    assert asks(faulty).startswith("first mend this, and let it go on: ")


def test_while_the_clock_may_be_wrong_nothing_moves(rise: Box) -> None:
    rise.clock_trusted = False
    rise.wait(100.0)
    assert rise.loop.status.controlled_by == ""


@pytest.mark.long
@every_row(
    ("into_s", "by_s"),
    [(-10.0, -86_400.0), (120.0, -600.0), (-10.0, -10.0), (120.0, 10.0), (-10.0, 300.0), (120.0, 3600.0)],
)
def test_where_the_clock_is_set_during_a_flight_the_plan_of_the_new_time_is_flown(into_s: float, by_s: float) -> None:
    """Before the rise and in the pass. Where nothing is up at the new time the antenna stands."""
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s - 40.0, follow=FOLLOWS_ISS)
    box.wait(40.0 + into_s)
    assert box.loop.status.flown is not None
    box.set_clock(by_s)
    box.wait(75.0)
    flown, late_s = box.loop.status.flown, into_s + by_s + 75.0
    if found.aos_s + late_s < (found.los_s or 0.0) and late_s > 0.0:
        assert flown is not None
        assert box.off_deg("iss") < 5.0
    elif flown is None:
        assert not box.loop.status.moving
        assert box.loop.status.controlled_by == ""
    else:
        rises = pass_of("iss", 0.0, box.utc_s - 600.0).aos_s
        assert rises is not None
        assert flown.begin_s - box.clock() == pytest.approx(rises - box.utc_s, abs=2.0)


def test_a_new_order_of_the_targets_is_planned_at_once(rise: Box) -> None:
    plans: list[float] = []
    rise.planner.meanwhile = lambda: plans.append(rise.utc_s)
    rise.wait(10.0)
    assert plans == [], "a plan lasts for a while"
    rise.follower.plan_again()
    rise.wait(2.0)
    assert len(plans) == 1


@pytest.mark.parametrize("clock_s", [0.0, 1.0])
def test_a_pass_of_old_elements_is_flown_with_a_warning_in_the_log_and_on_the_displays(
    clock_s: float, caplog: pytest.LogCaptureFixture
) -> None:
    found = pass_of("iss", after_s=FEBRUARY_S + 200 * 86_400.0)
    assert found.aos_s is not None
    box = Box(found.aos_s - 60.0, follow=FOLLOWS_ISS)
    box.clock_error_s = clock_s
    with caplog.at_level(logging.WARNING):
        assert box.wait(30.0, until=lambda: box.loop.status.flown is not None)
    flown = box.loop.status.flown
    assert flown is not None
    assert flown.beyond_beam
    assert flown.expected_error_deg > 10.0
    assert "BEYOND THE BEAM" in flown.error_text
    assert "more than half of the beam of 20°" in caplog.text


@pytest.mark.long
def test_the_error_to_expect_counts_the_clock(rise: Box) -> None:
    errors_deg = []
    for rise.clock_error_s in (0.0, 30.0):
        rise.tracker.track("so-50")
        rise.wait(3.0, until=lambda: rise.loop.status.flown is not None)
        flown = rise.loop.status.flown
        assert flown is not None
        errors_deg.append(flown.expected_error_deg)
        rise.tracker.off()
        rise.wait(3.0)
    assert errors_deg[1] > errors_deg[0] + 1.0
