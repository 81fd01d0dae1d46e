"""The plan of many passes: each is reached in time, none is flown at once with another, and reasons are true."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from rotator.control.sky.mount import Mount, Range, Sector
from rotator.control.sky.route import STEP_S, Speeds
from rotator.control.sky.sectors import box_at, kept
from rotator.control.sky.ways import best_route
from rotator.orbits.celestial import Body
from rotator.tracking.next_flight import target_path
from rotator.tracking.planned import Flight, Followed, PlannedPass
from rotator.tracking.schedule import schedule
from tests.tables import every_row
from tests.tracking.arcs import (
    AZIMUTH_DPS,
    BERLIN,
    CELL_S,
    ELEVATION_DPS,
    EPOCH_S,
    FULL,
    OVER,
    SINGLE,
    Arc,
    antenna,
    follow,
    places_at_end,
    round_s,
    satellites,
    seconds_between,
    travel_s,
)

DAY_S, HOUR_S = 86_400.0, 3600.0
HORIZON = ((0.0, 5.0), (90.0, 12.0), (180.0, 3.0), (270.0, 8.0))
CHIMNEY = Sector("the chimney", Range(100, 130), Range(0, 40), 2.0)
WALLED = Mount(Range(0, 450), Range(0, 180), horizon=HORIZON, sectors=(CHIMNEY,))
TARGETS = {each.name: each for each in satellites(12)}
MOUNTS = {"450": FULL, "360": SINGLE, "360 over the top": OVER, "with a chimney": WALLED}


def flights(plan: tuple[PlannedPass, ...]) -> list[tuple[PlannedPass, Flight]]:
    return sorted(((each, each.flight) for each in plan if each.flight), key=lambda pair: pair[1].begin_s)


def only(plan: tuple[PlannedPass, ...]) -> tuple[PlannedPass, Flight]:
    (found,) = flights(plan)
    return found


@pytest.fixture(scope="module", params=sorted(MOUNTS))
def planned(request: pytest.FixtureRequest) -> tuple[Mount, tuple[PlannedPass, ...]]:
    """A day of six satellites of different priority."""
    mount = MOUNTS[request.param]
    followed = [Followed(each, 1.0 + number % 3, 8.0) for number, each in enumerate(satellites(6))]
    return mount, schedule(followed, antenna(mount), EPOCH_S, EPOCH_S + DAY_S)


@pytest.mark.long
def test_the_antenna_stands_waiting_15_s_before_each_flight(planned: tuple[Mount, tuple[PlannedPass, ...]]) -> None:
    """At the motors' speed; from where the flight before left it, as the target itself tells."""
    mount, plan = planned
    assert len(flights(plan)) > 15
    free_s, stands = EPOCH_S, [(0.0, 0.0)]
    for each, flight in flights(plan):
        assert free_s <= flight.set_off_s <= flight.begin_s - 15.0
        shortest_s = min(travel_s(place, flight.wait_deg) for place in stands)
        assert flight.set_off_s + shortest_s <= flight.begin_s - 15.0 + 0.01
        free_s, stands = flight.end_s, places_at_end(each, TARGETS[each.name], mount)


def test_the_way_round_the_chimney_is_counted() -> None:
    """On a chart of cells; the antenna may be half a cell nearer at each end, and at each corner."""
    followed = [Followed(each, 1.0 + number % 3) for number, each in enumerate(satellites(12))]
    plan = schedule(followed, antenna(WALLED), EPOCH_S, EPOCH_S + 12 * HOUR_S)
    rounded = 0
    for (before, first), (_, second) in pairwise(flights(plan)):
        (stands, *others) = places_at_end(before, TARGETS[before.name], WALLED)
        swept = box_at(stands).stretched(second.wait_deg)
        if others or second.begin_s - first.end_s > 150.0 or not kept(CHIMNEY).box.meets(swept):
            continue
        around_s = round_s(WALLED, stands, second.wait_deg)
        rounded += around_s > travel_s(stands, second.wait_deg) + 1.0
        assert second.set_off_s + around_s <= second.begin_s - 15.0 + 3 * CELL_S
    assert rounded > 0


def test_it_waits_where_the_target_will_be(planned: tuple[Mount, tuple[PlannedPass, ...]]) -> None:
    mount, plan = planned
    for each, flight in flights(plan):
        sight = TARGETS[each.name].sight(flight.begin_s)
        azimuth_deg, elevation_deg = flight.wait_deg
        assert mount.azimuth.holds(azimuth_deg)
        assert mount.elevation.holds(elevation_deg)
        at_limit = azimuth_deg in (mount.azimuth.min_deg, mount.azimuth.max_deg)
        points_deg = azimuth_deg + 180.0 * flight.over_the_top
        assert at_limit or math.remainder(points_deg - sight.azimuth_deg, 360.0) == pytest.approx(0.0, abs=1e-6)
        height_deg = 180.0 - elevation_deg if flight.over_the_top else elevation_deg
        lowest_deg = max(sight.elevation_deg, mount.horizon_deg(points_deg))
        assert height_deg == pytest.approx(lowest_deg, abs=0.01)
        assert mount.inside_deg(azimuth_deg, elevation_deg) == 0.0


def test_every_pass_is_listed_once_in_order(planned: tuple[Mount, tuple[PlannedPass, ...]]) -> None:
    mount, plan = planned
    told = [(each.name, each.found.aos_s) for each in plan]
    assert len(set(told)) == len(told)
    aos_s = [each.found.aos_s or 0.0 for each in plan]
    assert aos_s == sorted(aos_s)
    assert all(each.reason for each in plan if each.flight is None)
    for each, flight in flights(plan):
        assert each.found.aos_s is not None
        assert each.found.los_s is not None
        moments = seconds_between(max(each.found.aos_s, EPOCH_S), each.found.los_s, 5.0)
        missed = [at_s for at_s in moments if not flight.begin_s <= at_s <= flight.end_s]
        assert each.reason or sum(in_sight(mount, each.name, at_s) for at_s in missed) < 3


def in_sight(mount: Mount, name: str, at_s: float) -> bool:
    """Above the trees, and not beside the chimney."""
    sight = TARGETS[name].sight(at_s)
    beside = CHIMNEY.azimuth.widened(8.0).holds(sight.azimuth_deg) and mount.sectors != ()
    return sight.elevation_deg > mount.horizon_deg(sight.azimuth_deg) and not beside


@pytest.mark.long
def test_a_flight_is_planned_on_the_turn_that_the_plan_of_many_has_chosen(
    planned: tuple[Mount, tuple[PlannedPass, ...]],
) -> None:
    """The steps of a flight are planned when it is due: they begin where the antenna was sent to wait."""
    mount, plan = planned
    for each, flight in flights(plan)[::5]:
        path = target_path(TARGETS[each.name], flight.begin_s, flight.end_s, 1.0)
        directions, early_s = path.directions(path.begin_s, STEP_S), flight.begin_s - flight.set_off_s
        speeds = Speeds(AZIMUTH_DPS, ELEVATION_DPS)
        route = best_route(mount, directions, (100.0, 0.0), early_s, speeds, begin_on=flight.begin_on)
        assert route.legs[0].flown.azimuths_deg[0] == pytest.approx(flight.wait_deg[0])
        assert route.legs[0].flown.way.flipped is flight.over_the_top


@pytest.mark.parametrize("mount", [FULL, OVER], ids=["450", "360 over the top"])
def test_nothing_is_lost_in_unwinding_where_the_rotor_reaches_everything(mount: Mount) -> None:
    through_north = Arc("north", EPOCH_S + 600, 700, 300.0, 110.0, 40.0)
    _, flight = only(schedule(follow(through_north), antenna(mount), EPOCH_S, EPOCH_S + HOUR_S))
    assert flight.lost_s == 0.0
    assert flight.over_the_top is (mount is OVER)


def test_without_the_overlap_an_unwind_costs_its_seconds() -> None:
    """A turn takes 60 s; and before it the antenna waits at the end of its range."""
    through_north = Arc("north", EPOCH_S + 600, 700, 300.0, 110.0, 40.0)
    _, flight = only(schedule(follow(through_north), antenna(SINGLE), EPOCH_S, EPOCH_S + HOUR_S))
    assert 30 < flight.lost_s < 75


def test_the_unwind_is_between_two_passes() -> None:
    """The first ends at 430°, in the overlap; the second, clockwise from 100°, needs the first turn."""
    one, two = (
        Arc("one", EPOCH_S + 600, 600, 330.0, 100.0, 40.0),
        Arc("two", EPOCH_S + 1400, 600, 100.0, 140.0, 40.0),
    )
    plan = schedule(follow(one, two), antenna(FULL), EPOCH_S, EPOCH_S + HOUR_S)
    (_, first), (_, second) = flights(plan)
    assert (round(first.wait_deg[0]), round(second.wait_deg[0])) == (330, 100)
    assert (first.lost_s, second.lost_s) == (0.0, 0.0)
    assert second.set_off_s >= first.end_s


def test_the_turn_is_chosen_so_that_the_next_pass_is_reached() -> None:
    """From 10° both turns hold the first pass; only from the second one there is time for the next, at 430°."""
    one = Arc("one", EPOCH_S + 600, 600, 10.0, 60.0, 40.0)
    two = Arc("two", EPOCH_S + 1240, 600, 60.0, -120.0, 40.0)
    plan = schedule(follow(one, two), antenna(FULL), EPOCH_S, EPOCH_S + HOUR_S)
    (_, first), (_, second) = flights(plan)
    assert (round(first.wait_deg[0]), round(second.wait_deg[0])) == (370, 420)
    assert second.begin_s == pytest.approx(two.aos_s, abs=0.01)


def test_where_two_are_up_at_once_the_higher_priority_is_flown_whole() -> None:
    low, high = Arc("low", EPOCH_S + 600, 600, 90, 90, 50), Arc("high", EPOCH_S + 700, 600, 200, 90, 30)
    plan = schedule([Followed(low, 1), Followed(high, 3)], antenna(FULL), EPOCH_S, EPOCH_S + HOUR_S)
    assert [(each.name, each.flight is not None, each.reason) for each in plan] == [
        ("low", False, "high has the higher priority"),
        ("high", True, ""),
    ]


def test_a_short_overlap_costs_the_end_of_one_or_the_beginning_of_the_other() -> None:
    """They are up at once for two minutes, and the turn takes 60 s."""
    one, two = Arc("one", EPOCH_S + 600, 600, 0, 90, 50), Arc("two", EPOCH_S + 1080, 600, 450, 60, 50)
    plan = schedule(follow(one, two), antenna(SINGLE), EPOCH_S, EPOCH_S + HOUR_S)
    (before, first), (after, second) = flights(plan)
    assert "ends early: for two" in before.reason or "begins late: after one" in after.reason
    assert first.end_s - first.begin_s + second.end_s - second.begin_s > 1200 - 120 - 15 - 20


@every_row(
    ("followed", "reason"),
    [
        (Followed(Arc("low", EPOCH_S + 600, 600, 90, 90, 12), 1, 20), "culminates at 12°, below the 20° asked"),
        (Followed(Arc("low", EPOCH_S + 600, 600, 90, 90, 19.8), 1, 20), "culminates at 19.80°, below the 20° asked"),
        (Followed(Arc("low", EPOCH_S + 600, 600, 60, 60, 4)), "all of it is behind the horizon of trees and roofs"),
        (Followed(Arc("behind", EPOCH_S + 600, 600, 108, 10, 30)), "the rotor does not reach it"),
        (
            Followed(Arc("going", EPOCH_S - 597, 600, 108, 10, 30)),
            "the rest of it is behind the horizon of trees and roofs",
        ),
    ],
)
def test_why_a_pass_is_left_out(followed: Followed, reason: str) -> None:
    (each,) = schedule([followed], antenna(WALLED), EPOCH_S, EPOCH_S + HOUR_S)
    assert (each.flight, each.reason) == (None, reason)


@pytest.mark.parametrize(
    ("rivals", "reason"),
    [
        ([Arc("a", EPOCH_S + 600, 700, 0, 90, 80)], "a rises higher, to 80°"),
        ([Arc("a", EPOCH_S + 600, 1400, 0, 90, 30)], "a is up for longer"),
        (
            [Arc("a", EPOCH_S + 500, 500, 180, 30, 70), Arc("b", EPOCH_S + 1030, 500, 210, 30, 70)],
            "a and b are worth more together",
        ),
    ],
)
def test_what_is_worth_more_is_named(rivals: list[Arc], reason: str) -> None:
    loser = Arc("loser", EPOCH_S + 700, 600, 200, 90, 30)
    plan = schedule(follow(loser, *rivals), antenna(FULL), EPOCH_S, EPOCH_S + HOUR_S)
    assert {each.name: each.reason for each in plan if not each.flight} == {"loser": reason}


def test_a_pass_that_is_on_when_the_plan_is_made_is_joined_at_once() -> None:
    on = Arc("on", EPOCH_S - 200, 600, 90, 90, 50)
    here_deg = on.sight(EPOCH_S).azimuth_deg, on.sight(EPOCH_S).elevation_deg
    _, there = only(schedule(follow(on), antenna(FULL, here_deg), EPOCH_S, EPOCH_S + HOUR_S))
    assert (there.set_off_s, there.begin_s) == (EPOCH_S, EPOCH_S)
    each, far = only(schedule(follow(on), antenna(FULL, (400.0, 0.0)), EPOCH_S, EPOCH_S + HOUR_S))
    assert 280 / 6 - 10 < far.begin_s - EPOCH_S < 280 / 6 + 10
    assert each.reason == "begins late: the antenna has to turn there first"


def test_the_moon_is_followed_in_the_gaps_between_satellites() -> None:
    moon = Followed(Body("moon", BERLIN), 0.1)
    plan = schedule([moon, *follow(*satellites(3))], antenna(FULL), EPOCH_S, EPOCH_S + DAY_S)
    parts = [flight for each, flight in flights(plan) if each.name == "Moon"]
    assert len(parts) > 3
    assert all(part.end_s - part.begin_s > 300 for part in parts)
    assert sum(each.name != "Moon" for each, _ in flights(plan)) > 10


def test_a_plan_of_three_days_leaves_what_stays_up_as_often_as_a_plan_of_one() -> None:
    """The calendar has three days, and one is flown."""
    always = Arc("always up", EPOCH_S - 30 * DAY_S, 60 * DAY_S, 150.0, 0.1, 30.0)
    followed = [Followed(satellites(1)[0], 2.0, 8.0), Followed(always)]
    day, days = (schedule(followed, antenna(FULL), EPOCH_S, EPOCH_S + count * DAY_S) for count in (1, 3))
    of_day = [round(each.found.tca_s) for each, _ in flights(day) if each.name != always.name]
    assert of_day
    assert of_day == [round(each.found.tca_s) for each, _ in flights(days) if each.name != always.name][: len(of_day)]


def test_no_flight_leads_past_a_mast_that_no_elevation_clears() -> None:
    mast = Mount(Range(0, 360), Range(0, 90), sectors=(Sector("the mast", Range(170, 190), Range(0, 90), 0.0),))
    east, west = Arc("east", EPOCH_S + 600, 600, 20, 100, 40), Arc("west", EPOCH_S + 1500, 600, 340, -100, 40)
    past = Arc("past", EPOCH_S + 2500, 600, 90, 180, 40)
    plan = schedule(follow(east, west, past), antenna(mast), EPOCH_S, EPOCH_S + HOUR_S)
    (_, first), (last, second) = flights(plan)
    assert round(first.wait_deg[0]) == 20
    assert last.name == "past"
    assert past.sight(second.end_s).azimuth_deg < 170
    assert {each.name for each in plan if not each.flight} == {"west"}


def test_nothing_followed_nothing_planned() -> None:
    assert schedule([], antenna(FULL), EPOCH_S, EPOCH_S + DAY_S) == ()
