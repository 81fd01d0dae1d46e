"""Each change of what is tracked, as a value: a request, its flight, a refusal, a stop, an end."""

from __future__ import annotations

from hw.ports import AngleSource, Axis
from rotator.exchange.flight_order import AxisPlan, Fly
from rotator.exchange.orders import (
    Aim,
    GiveBack,
    Home,
    LetGo,
    Mode,
    Order,
    Park,
    Release,
    SetMode,
    Stop,
    Take,
)
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.tracking.next_flight import NextFlight, Now
from rotator.tracking.ports import TRACK
from rotator.tracking.tracked import (
    BEFORE_S,
    FRESH_S,
    JUMPED_S,
    NOTHING,
    TAKES_EFFECT_S,
    Flown,
    Request,
    Tracked,
    ends_tracking,
)
from tests.tables import every_row

UTC_S = 1_739_000_000.0
PERSON = Source("console", 1)


def status(at_s: float, controlled_by: str = "", latched: str = "", *, storm: bool = False) -> Status:
    azimuth, elevation = (AxisStatus(0.0, end_deg, source=AngleSource.MEASURED) for end_deg in (450.0, 180.0))
    return Status(at_s, azimuth, elevation, controlled_by=controlled_by, latched=latched, storm=storm)


def now(at_s: float) -> Now:
    return Now(UTC_S + at_s, at_s)


def flown(name: str, begin_s: float = 0.0, end_s: float = 600.0, ordered_s: float = 0.0) -> Flown:
    plan = AxisPlan(begin_s, (10.0, 11.0), ())
    order = Fly(name, ((begin_s, 10.0, 20.0), (end_s, 11.0, 21.0)), plan, plan)
    return Flown(NextFlight(UTC_S + begin_s, UTC_S + end_s, order), now(ordered_s), ordered_s)


def asked(words: str, before: Tracked | None = None, mover: str = "") -> Tracked:
    return (before or Tracked()).requested(Request(words), mover, follows=True)


def test_a_request_is_planned_then_flown_then_ended() -> None:
    wanted = asked("iss")
    assert (wanted.text(status(0.0)), wanted.plan_is_due(status(0.0), now(0.0))) == ("planning", True)
    flies = wanted.flies(flown("ISS"))
    assert (flies.text(status(0.0)), flies.text(status(TAKES_EFFECT_S))) == ("planning", "tracking")
    assert not flies.plan_is_due(status(10.0), now(10.0))
    assert flies.ends("it is enough").text(status(10.0)) == "ended: it is enough"


def test_a_request_that_cannot_be_planned_gives_way_to_the_tracking_before_it() -> None:
    first = asked("iss").flies(flown("ISS"))
    refused = asked("moon", asked("so-50", first)).cannot_be_planned("it never rises")
    assert (refused.request, refused.text(status(10.0))) == (first.request, "refused: it never rises")
    assert asked("moon", refused).text(status(10.0)) == "planning"
    assert asked("moon").cannot_be_planned("it never rises").text(status(0.0)) == "ended: it never rises"


def test_after_an_end_no_earlier_tracking_comes_back() -> None:
    over = asked("iss").flies(flown("ISS")).requested(NOTHING, "", follows=False)
    assert (over.text(status(10.0)), over.following) == ("off", False)
    assert asked("moon", over).cannot_be_planned("it never rises").text(status(10.0)) == "ended: it never rises"


@every_row(
    ("order", "said"),
    [
        (Stop(), "stopped it"),
        (SetMode(Mode.MANUAL), "has set the mode MANUAL"),
        (LetGo(), "took the torque from the motors"),
        (Take(stops=True), "took the antenna"),
        (Park(storm=True), "parked it"),
    ],
)
def test_these_orders_end_it_and_the_first_is_named(order: Order, said: str) -> None:
    assert ends_tracking(order, status(0.0))
    stopped = asked("iss").stopped(PERSON, order).stopped(Source("page", 2), Stop())
    assert stopped.reason_to_end(status(0.0), now(0.0)) == f"console#1 {said}"
    assert asked("moon", stopped).reason_to_end(status(0.0), now(0.0)) == ""


def test_a_release_ends_it_only_where_it_released_something() -> None:
    """A release after a fault is no end: to go on is what the person says."""
    assert not ends_tracking(Release(), status(0.0))
    assert ends_tracking(Release(), status(0.0, latched="panel"))


@every_row("order", [Aim(10.0, 20.0), Take(stops=False), GiveBack(), Park(), Home(Axis.AZIMUTH)])
def test_all_others_do_not(order: Order) -> None:
    assert not ends_tracking(order, status(0.0, latched="panel"))


@every_row(
    ("seen", "reason"),
    [
        (status(TAKES_EFFECT_S - 0.1, "rotctld#1"), ""),
        (status(TAKES_EFFECT_S, "rotctld#1"), "rotctld#1 moves the antenna"),
        (status(10.0), "the antenna was stopped"),
        (status(10.0, str(TRACK)), "the antenna was stopped"),
        (status(10.0, latched="panel"), "stopped by panel"),
        (status(10.0, latched="page#2", storm=True), "storm park by page#2"),
    ],
)
def test_why_the_antenna_is_lost(seen: Status, reason: str) -> None:
    assert flown("ISS").lost(seen, now(seen.at_s)) == reason
    assert flown("ISS").lost(seen, now(599.0)) == "", "a flight that ends is not lost"


def test_when_a_new_plan_is_due() -> None:
    soon, later_s = flown("ISS", 10.0), BEFORE_S + FRESH_S + 1.0
    assert [soon.is_over(now(at_s)) for at_s in (5.0, 599.9, 600.0)] == [False, False, True]
    assert soon.is_over(Now(UTC_S + 5.0 + 2.0 * JUMPED_S, 5.0)), "the clock has jumped"
    far = flown("ISS", later_s, later_s + 600.0)
    assert [far.is_over(now(at_s)) for at_s in (FRESH_S, FRESH_S + 1.0)] == [False, True]


def test_who_has_taken_the_antenna_since_the_request() -> None:
    wanted = asked("iss", mover="rotctld#1")
    seen = [wanted.taken_by(status(0.0, name)) for name in ("", "rotctld#1", str(TRACK), "page#2")]
    assert seen == ["", "", "", "page#2"]
    assert wanted.flies(flown("ISS")).taken_by(status(9.0, "rotctld#1")) == "rotctld#1"


def test_the_tracker_moves_it_from_its_order_on() -> None:
    idle = Tracked().ordered(10.0)
    assert [idle.moves(status(at_s)) for at_s in (11.9, 12.0)] == [True, False]
    assert idle.moves(status(12.0, str(TRACK)))
    assert (idle.of_plan, idle.ordered(11.0, of_plan=True).of_plan) == (False, True)


def test_new_files_are_waited_for() -> None:
    waits = Tracked().requested(Request("new"), "", follows=True, looks_again=True)
    assert (waits.plan_is_due(status(0.0), now(0.0)), waits.with_new_files().plan_is_due(status(0.0), now(0.0))) == (
        False,
        True,
    )


def test_the_plan_of_many_passes_has_the_antenna_while_nothing_else_is_tracked() -> None:
    assert Tracked().following
    assert not asked("iss").following
    assert asked("iss").ends("over").following
