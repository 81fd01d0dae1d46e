"""The box tracks a target by itself, from one pass to the next: the whole control loop on simulated chips, and a sky.

Time is simulated: UTC runs beside the loop's clock. The plan is computed in the test's own process.
"""

from __future__ import annotations

import math

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import BOTH, Aim, GiveBack, Jog, Mode, Order, Release, SetMode, Stop
from rotator.exchange.sources import Source
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.targets import find
from rotator.protocols.methods import GoOn
from rotator.protocols.operating import NOTHING_LEFT, Operating
from rotator.runtime.client import Client
from rotator.tracking.tracker import CLOCK_UNSURE
from tests.tracking.tracked_box import BERLIN, ELEMENTS, FEBRUARY_S, Box, pass_of


@pytest.fixture
def rise() -> Box:
    """Three minutes before the ISS rises."""
    begin = pass_of("iss").aos_s
    assert begin is not None
    return Box(begin - 180.0)


@pytest.mark.long
def test_it_waits_where_the_satellite_rises_and_follows_it_to_its_set_and_goes_on_to_the_next(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    assert rise.tracker.state == "planning"
    found = pass_of("iss")
    assert found.aos_s is not None
    assert found.los_s is not None
    rise.wait(found.aos_s - 15.0 - rise.utc_s)
    assert rise.tracker.state == "tracking"
    assert rise.loop.status.flown is not None
    assert rise.loop.status.flown.name.startswith("ISS")
    assert not rise.loop.status.moving, "it stands 15 s before the rise"
    worst_deg = 0.0
    while rise.utc_s < found.los_s - 5.0:
        rise.wait(1.0)
        if rise.utc_s > found.aos_s:
            worst_deg = max(worst_deg, rise.off_deg("iss"))
    assert worst_deg < 5.0

    # Then to the next rise.
    rise.wait(60.0)
    status = rise.loop.status
    assert status.flown is not None
    assert status.flown.begin_s > status.at_s + 3000.0
    assert not status.moving
    rows = rise.planner.plans[-1][1].order.path
    assert abs(math.remainder(rise.world.antenna()[0] - rows[0][1], 360.0)) < 5.0
    assert len(rise.planner.plans) == 2


@pytest.mark.long
def test_a_plan_of_long_ago_is_made_again_before_its_pass(rise: Box) -> None:
    """Newer elements may have come meanwhile, and a person may have turned the antenna by hand."""
    early = Box(rise.utc_s - 600.0)
    assert early.tracker.track("iss") == ""
    early.wait(50.0)
    early.rest(615.0)
    assert len(early.planner.plans) == 2
    now, flight = early.planner.plans[1]
    assert flight.begin_utc_s - now.utc_s == pytest.approx(120.0, abs=1.0)


@pytest.mark.parametrize("hours_to_go", [0.5, 26.0])
def test_a_clock_that_is_set_makes_a_new_plan(rise: Box, hours_to_go: float) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(2.0)
    rise.set_clock(-3600.0 * hours_to_go)
    rise.wait(2.0)
    assert len(rise.planner.plans) == 2
    assert rise.planner.plans[1][1].begin_utc_s > rise.utc_s


PC, PERSON = Source("gs232b", 1), Source("console", 1)


def test_after_a_stop_it_has_ended_at_once_and_not_only_when_its_thread_has_its_turn(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(5.0)
    rise.loop.post(PERSON, Stop(latch=True))
    assert rise.tracker.state == "ended: console#1 stopped it"


@pytest.mark.long
@pytest.mark.parametrize(
    ("source", "order"),
    [
        (PC, Aim(100.0, 10.0)),
        (PERSON, Stop(latch=True)),
        (PC, Stop(BOTH)),
        (PERSON, Jog(Axis.AZIMUTH, Direction.PLUS, 1)),
    ],
)
def test_another_sender_takes_the_antenna_and_keeps_it(rise: Box, source: Source, order: Aim | Stop | Jog) -> None:
    assert rise.tracker.track("iss") == ""
    rise.wait(5.0)
    rise.loop.post(source, order)
    rise.wait(3.0)
    assert rise.tracker.state.startswith("ended: ")
    rise.loop.post(PERSON, Release())
    rise.wait(40.0)
    stood = rise.world.antenna()
    rise.wait(30.0)
    assert rise.world.antenna() == pytest.approx(stood, abs=0.1)
    assert len(rise.planner.plans) == 1


@pytest.mark.parametrize(
    "orders",
    [
        [(PC, Stop(BOTH))],
        [(PERSON, Stop(latch=True)), (PERSON, Release())],
        [(PC, Aim(100.0, 10.0))],
        [(Source("panel"), SetMode(Mode.JOG)), (Source("panel"), SetMode(Mode.AUTO))],
    ],
    ids=["S", "stop and resume", "another sender", "the panel's switch"],
)
def test_what_comes_while_it_plans_is_not_undone_by_the_plan(rise: Box, orders: list[tuple[Source, Order]]) -> None:
    """On a slow computer a plan takes ten seconds."""

    def meanwhile() -> None:
        for source, order in orders:
            rise.loop.post(source, order)
        rise.loop.cycle()

    rise.planner.meanwhile = meanwhile
    assert rise.tracker.track("iss") == ""
    rise.wait(3.0)
    rise.planner.meanwhile = lambda: None
    assert rise.tracker.state.startswith("ended: ")
    assert rise.loop.status.flown is None
    rise.wait(30.0)
    assert rise.loop.status.flown is None


def test_a_stop_at_the_very_end_of_a_pass_is_no_end_of_a_pass(rise: Box) -> None:
    found = pass_of("iss")
    assert found.los_s is not None
    late = Box(found.los_s - 20.0)
    assert late.tracker.track("iss") == ""
    late.wait(19.5)
    late.loop.post(PC, Stop(BOTH))
    late.wait(30.0)
    assert late.loop.status.flown is None
    assert late.tracker.state == "ended: gs232b#1 stopped it"


def broken(box: Box, fault: str = "azimuth-pot-open") -> None:
    """A pot's wire breaks for some seconds."""
    box.wait(5.0)
    box.world.inject(fault)
    box.wait(5.0)
    assert box.loop.status.faults
    box.world.clear(fault)
    box.wait(1.0)


@pytest.mark.parametrize("fault", ["azimuth-pot-open", "elevation-pot-open"])
def test_go_on_after_a_fault_goes_on_with_what_was_tracked(rise: Box, fault: str) -> None:
    assert rise.tracker.track("iss") == ""
    broken(rise, fault)
    rise.loop.post(PERSON, Release())
    rise.wait(5.0)
    assert rise.tracker.state == "tracking"
    assert rise.loop.status.flown is not None
    assert rise.loop.status.azimuth.target_deg is not None
    assert rise.loop.status.elevation.target_deg is not None


def test_a_computer_that_stood_still_on_the_way_to_where_it_rises_goes_on_there_by_itself() -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s - 200.0)
    assert box.tracker.track("iss") == ""
    box.wait(8.0)
    assert box.loop.status.moving
    box.clock.sleep(1.0)
    box.loop.cycle()
    assert {fault.kind for fault in box.loop.status.faults} == {FaultKind.CONTROL_LATE}
    box.wait(60.0)
    azimuth = box.loop.status.azimuth
    assert azimuth.target_deg is not None
    assert azimuth.angle_deg == pytest.approx(azimuth.target_deg, abs=1.0)


def test_go_on_after_a_fault_goes_on_with_the_plan_of_many_passes() -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s + 30.0, follow="[[sky.follow]]\nname = 'iss'\n")
    broken(box)
    box.loop.post(PERSON, Release())
    box.wait(5.0)
    assert box.loop.status.flown is not None
    assert box.loop.status.azimuth.target_deg is not None


@pytest.mark.parametrize("orders", [[(PC, Stop(BOTH))], [(PERSON, Stop(latch=True)), (PERSON, Release())]])
def test_a_stop_after_a_fault_ends_the_tracking(rise: Box, orders: list[tuple[Source, Order]]) -> None:
    assert rise.tracker.track("iss") == ""
    broken(rise)
    for source, order in orders:
        rise.loop.post(source, order)
        rise.loop.cycle()
    rise.wait(5.0)
    assert rise.tracker.state == f"ended: {orders[0][0]} stopped it"
    assert rise.loop.status.flown is None


def test_going_on_is_the_same_where_a_fault_has_left_the_tracking_as_it_was(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    broken(rise)
    rise.wait(2.0)
    person = at_the_console(rise)
    assert person.goes_on_with == "", "nothing has ended"
    assert person.do(GoOn()) == ""
    rise.wait(5.0)
    assert rise.loop.status.faults == ()
    assert rise.tracker.state == "tracking"
    assert person.do(GoOn()) == NOTHING_LEFT, "there is no fault"


def at_the_console(box: Box) -> Operating:
    return Operating(Client(box.loop, box.mount, PERSON), box.tracker)


def test_after_a_stop_nothing_goes_on_before_a_person_asks_and_then_the_pass_that_is_up(up: Box) -> None:
    assert up.tracker.track("iss") == ""
    up.wait(30.0)
    person = at_the_console(up)
    assert person.do(GoOn()) == NOTHING_LEFT, "nothing has ended"
    up.loop.post(PERSON, Stop(latch=True))
    up.wait(10.0)
    up.loop.post(PERSON, Release())
    up.wait(10.0)
    assert (up.loop.status.flown, up.tracker.goes_on_with) == (None, "iss")
    up.loop.post(PERSON, Stop(latch=True))
    up.wait(2.0)
    assert person.do(GoOn()) == ""
    up.wait(60.0)
    assert up.tracker.state == "tracking"
    assert up.tracker.goes_on_with == ""
    assert up.loop.status.flown is not None
    assert up.loop.status.flown.begin_s < up.loop.status.at_s, "it is up, and not the next pass"
    assert up.off_deg("iss") < 5.0


def test_after_a_stop_the_plan_goes_on_when_a_person_asks() -> None:
    found = pass_of("iss")
    assert found.aos_s is not None
    box = Box(found.aos_s + 30.0, follow="[[sky.follow]]\nname = 'iss'\n")
    box.wait(5.0)
    box.loop.post(PERSON, Stop(latch=True))
    box.wait(2.0)
    assert box.tracker.goes_on_with == "plan"
    assert at_the_console(box).do(GoOn()) == ""
    box.wait(5.0)
    assert box.loop.status.flown is not None


def test_after_a_fault_a_program_that_took_the_antenna_keeps_it(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    broken(rise)
    rise.loop.post(PERSON, Release())
    rise.loop.post(PC, Aim(100.0, 10.0))
    rise.wait(5.0)
    assert rise.loop.status.flown is None
    assert rise.loop.status.controlled_by == str(PC)


@pytest.mark.long
def test_a_direction_that_the_rotor_cannot_reach_is_refused_and_the_flight_goes_on() -> None:
    begin = pass_of("iss").aos_s
    assert begin is not None
    box = Box(begin - 180.0, follow="[azimuth]\nmax_deg = 250\n")
    assert box.tracker.track("moon") == ""
    box.wait(5.0)
    flown = box.loop.status.flown
    assert flown is not None
    assert "300" in box.tracker.track("300 20")
    box.wait(5.0)
    assert box.tracker.state == "tracking"
    assert box.loop.status.flown == flown


def test_off_stops_the_antenna(rise: Box) -> None:
    assert rise.tracker.track("iss") == ""
    assert rise.wait(20.0, lambda: rise.loop.status.moving)
    rise.tracker.off()
    rise.wait(3.0)
    assert not rise.loop.status.moving
    assert rise.loop.status.flown is None
    assert rise.tracker.state == "off"
    assert not rise.loop.status.latched


@pytest.mark.long
def test_what_is_called_tracked_is_what_the_status_shows(rise: Box) -> None:
    shown = None
    for words, name in (("iss", "ISS"), ("moon", "Moon"), ("iss", "ISS")):
        assert rise.tracker.track(words) == ""
        rise.look()
        assert rise.loop.status.flown is shown
        assert rise.tracker.state == "planning"
        rise.wait(5.0, lambda: rise.tracker.state == "tracking")
        shown = rise.loop.status.flown
        assert shown is not None
        assert shown.name == name


def test_a_direction_is_an_order_like_any(rise: Box) -> None:
    assert rise.tracker.track("100 20") == ""
    rise.wait(60.0)
    assert rise.world.antenna() == pytest.approx((100.0, 20.0), abs=4.0)
    assert rise.tracker.state == "off"


def test_a_target_that_cannot_be_tracked_is_refused_with_the_reason_and_nothing_moves(rise: Box) -> None:
    assert rise.tracker.track("xyzzy").startswith('"xyzzy" is not among the ')
    rise.clock_trusted = False
    assert rise.tracker.track("iss") == CLOCK_UNSURE
    rise.wait(5.0)
    assert not rise.loop.status.moving
    rise.tracker.clock_is_right()
    assert rise.tracker.track("iss") == ""


def test_a_target_that_never_rises_is_refused_with_the_reason(rise: Box) -> None:
    south = Box(rise.utc_s, Site(-85.0, 0.0))
    assert south.tracker.track("cas a") == ""
    south.wait(2.0)
    assert south.tracker.state == "ended: Cas A does not rise within 7 days"


# --- a program sends the directions of a satellite


def sends(box: Box, seconds: int, off_deg: float = 0.0) -> None:
    """Whole degrees, once a second, by a clock that is three seconds ahead."""
    iss = find("iss", BERLIN, Catalogue((str(ELEMENTS),)))
    for _ in range(seconds):
        sight = iss.sight(box.utc_s + 3.0)
        box.loop.post(PC, Aim(round(sight.azimuth_deg + off_deg) % 360.0, max(0.0, round(sight.elevation_deg))))
        box.wait(1.0)


@pytest.fixture
def up(rise: Box) -> Box:
    """The ISS rose half a minute ago."""
    return Box(rise.utc_s + 210.0)


def test_its_satellite_is_named_and_flown_until_its_orders_depart(up: Box) -> None:
    sends(up, 20)
    assert up.loop.status.recognised.startswith("ISS")
    assert up.loop.status.controlled_by == str(PC), "the antenna is the program's still"
    sends(up, 60)
    assert up.loop.status.recognised.startswith("ISS")
    sends(up, 1, off_deg=8.0)
    assert up.loop.status.recognised == ""
    assert up.loop.status.flown is None


def test_when_a_person_has_given_the_antenna_back_the_pass_is_flown_again(up: Box) -> None:
    page = Source("page", 1)
    sends(up, 14)
    up.loop.post(page, Jog(Axis.AZIMUTH, Direction.PLUS, 1))
    sends(up, 20)
    assert up.loop.status.recognised == ""
    up.loop.post(page, GiveBack())
    sends(up, 20)
    assert up.loop.status.recognised.startswith("ISS")
    assert up.loop.status.controlled_by == str(PC)


def test_a_program_that_has_fallen_silent_is_not_flown_for_again(up: Box) -> None:
    sends(up, 14)
    up.wait(25.0)
    assert up.loop.status.recognised == ""
    stood = up.world.antenna()
    up.wait(60.0)
    assert up.world.antenna() == pytest.approx(stood, abs=0.1)


def test_while_the_clock_may_be_wrong_no_satellite_is_flown(up: Box) -> None:
    up.clock_trusted = False
    sends(up, 20)
    assert up.loop.status.recognised == ""
    up.clock_trusted = True
    sends(up, 3)
    assert up.loop.status.recognised.startswith("ISS")


AT_THE_EQUATOR = Site(0.0, 13.0)


@pytest.mark.long
def test_before_a_rise_the_antenna_takes_the_turn_that_the_whole_pass_needs() -> None:
    """SO-50 rises at 8° and sets at 127°: an antenna that comes from 320° would follow it on the upper turn, which
    ends at 90°."""
    satellite = find("so-50", AT_THE_EQUATOR, Catalogue((str(ELEMENTS),)))
    aos_s = FEBRUARY_S + 112_356.0
    box = Box(aos_s - 160.0, AT_THE_EQUATOR)
    box.loop.post(PC, Aim(320.0, 0.0))
    box.wait(60.0)
    assert box.world.antenna()[0] == pytest.approx(320.0, abs=5.0)
    turned_deg = []
    for _ in range(110):
        sight = satellite.sight(box.utc_s + 3.0)
        box.loop.post(PC, Aim(round(sight.azimuth_deg) % 360.0, max(0.0, round(sight.elevation_deg))))
        box.wait(1.0)
        turned_deg.append(box.world.antenna()[0])
        if sight.elevation_deg < -1.0:
            assert not box.loop.status.recognised
    assert max(turned_deg) < 370.0, "it has not gone to the upper turn before"
    assert turned_deg[-1] == pytest.approx(satellite.sight(box.utc_s).azimuth_deg, abs=5.0), "the lower turn"
    assert box.loop.status.recognised == "SO-50"
