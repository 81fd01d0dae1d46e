"""A stop and a flight in one moment, on two threads, in every order: the antenna stands afterwards.

The other thread gets its turn inside `ControlLoop.post`: before and after the box's listeners hear of the order.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rotator.exchange.orders import BOTH, Aim, Mode, Order, SetMode, Stop
from rotator.exchange.sources import TRACKER, Source
from tests.tracking.tracked_box import Box, pass_of

PC, PANEL = Source("gs232b", 1), Source("panel")
FOLLOWS_ISS = '[[sky.follow]]\nname = "iss"\n'

Turn = Callable[[Box], None]


def acts_and_plans(box: Box) -> None:
    """The control thread takes what is in its inbox, then the tracking thread ends its plan."""
    box.loop.cycle()
    box.look()


TURNS = pytest.mark.parametrize("turn", [acts_and_plans, Box.look])
MOMENTS = pytest.mark.parametrize("moment", ["before_heard", "after_heard"])
STOPS = pytest.mark.parametrize(("source", "order"), [(PC, Stop(BOTH)), (PANEL, SetMode(Mode.AUTO))])


def up(follow: str = "") -> Box:
    """A minute after the ISS has risen: a plan that is ready is flown at once."""
    begin = pass_of("iss").aos_s
    assert begin is not None
    return Box(begin + 60.0, follow=follow, looks=False)


def give(box: Box, source: Source, order: Order, moment: str, turn: Turn) -> None:
    def once(_order: Order) -> None:
        setattr(box, moment, lambda _order: None)
        turn(box)

    setattr(box, moment, once)
    box.loop.post(source, order)


def assert_stands(box: Box) -> None:
    box.wait(3.0)
    stood = box.world.antenna()
    box.wait(5.0)
    assert box.loop.status.flown is None
    assert box.world.antenna() == pytest.approx(stood, abs=0.1)


@pytest.mark.long
@TURNS
@MOMENTS
@STOPS
def test_a_stop_while_the_plan_of_a_target_ends(source: Source, order: Order, moment: str, turn: Turn) -> None:
    box = up()
    assert box.tracker.track("iss") == ""
    give(box, source, order, moment, turn)
    assert_stands(box)
    assert box.tracker.state.startswith("ended: ")


@TURNS
@MOMENTS
def test_a_stop_while_the_plan_of_many_passes_ends(moment: str, turn: Turn) -> None:
    box = up(FOLLOWS_ISS)
    give(box, PC, Stop(BOTH), moment, turn)
    assert_stands(box)


def test_off_before_the_control_thread_has_taken_the_flight() -> None:
    box = up()
    assert box.tracker.track("iss") == ""
    box.look()
    assert box.loop.status.flown is None
    box.tracker.off()
    assert_stands(box)
    assert box.tracker.state == "off"


def test_off_before_the_control_thread_has_taken_the_direction() -> None:
    box = up()
    assert box.tracker.track("200 30") == ""
    box.tracker.off()
    assert_stands(box)


def test_off_while_the_plan_of_many_passes_has_just_been_flown() -> None:
    box = up(FOLLOWS_ISS)
    box.look()
    box.tracker.off()
    assert_stands(box)


def test_off_stops_no_antenna_that_another_sender_moves() -> None:
    box = up()
    assert box.tracker.track("iss") == ""
    box.wait(3.0)
    box.loop.post(PC, Aim(200.0, 30.0))
    box.wait(1.0)
    box.tracker.off()
    assert box.wait(60.0, lambda: box.world.antenna() == pytest.approx((200.0, 30.0), abs=5.0))


def test_a_listener_that_fails_loses_no_stop() -> None:
    box = up()
    box.loop.post(PC, Aim(200.0, 30.0))
    box.wait(3.0)
    assert box.loop.status.moving

    def fails(_order: Order) -> None:
        raise RuntimeError("a listener has failed")

    box.before_heard = fails
    with pytest.raises(RuntimeError, match="a listener has failed"):
        box.loop.post(PC, Stop(BOTH))
    box.before_heard = lambda _order: None
    assert_stands(box)
    assert box.loop.status.controlled_by != TRACKER
