"""The axes that are to find their end stops: one after the other, for the source that has asked."""

from __future__ import annotations

from typing import cast

import pytest

from hw.ports import Axis
from rotator.control.axis.port import ControlledAxis
from rotator.control.homing_queue import HomingQueue
from rotator.control.refused import Refused
from rotator.exchange.sources import Source

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
CONSOLE, LINK = Source("console"), Source("gs232b", 1)


class HomingAxis:
    """As much of an axis as the queue needs. It homes until a test says that it has arrived."""

    def __init__(self, *, homeable: bool = True) -> None:
        self.homeable = homeable
        self.homing = False

    def home(self) -> None:
        self.homing = True


def queue_of(axes: dict[Axis, HomingAxis]) -> HomingQueue:
    return HomingQueue(cast(dict[Axis, ControlledAxis], axes))


@pytest.fixture
def axes() -> dict[Axis, HomingAxis]:
    return {axis: HomingAxis() for axis in Axis}


def test_one_axis_after_the_other_in_the_order_asked(axes: dict[Axis, HomingAxis]) -> None:
    queue = queue_of(axes)
    assert not queue.due()
    queue.ask(EL, CONSOLE)
    queue.ask(AZ, CONSOLE)
    for axis in (EL, AZ):
        assert queue.due()
        queue.begin()
        assert [each for each in Axis if axes[each].homing] == [axis]
        assert not queue.due(), "the other one waits while it homes"
        assert queue.active
        axes[axis].homing = False
    assert not queue.active
    assert not queue.due()


def test_from_the_order_to_the_end_stop_it_holds_back_every_other_source(axes: dict[Axis, HomingAxis]) -> None:
    queue = queue_of(axes)
    assert not queue.holds_back(LINK)
    queue.ask(AZ, CONSOLE)
    assert (queue.holds_back(LINK), queue.holds_back(CONSOLE)) == (True, False)
    queue.begin()
    assert (queue.holds_back(LINK), queue.holds_back(CONSOLE)) == (True, False)
    axes[AZ].homing = False
    assert not queue.holds_back(LINK)


def test_cleared_the_axes_that_wait_do_not_home_and_the_one_that_homes_goes_on(axes: dict[Axis, HomingAxis]) -> None:
    queue = queue_of(axes)
    queue.ask(AZ, CONSOLE)
    queue.ask(EL, CONSOLE)
    queue.begin()
    queue.clear()
    assert axes[AZ].homing
    assert queue.active
    axes[AZ].homing = False
    assert not queue.active
    assert not queue.due()


def test_an_axis_that_knows_its_angle_is_refused(axes: dict[Axis, HomingAxis]) -> None:
    axes[EL] = HomingAxis(homeable=False)
    queue = queue_of(axes)
    with pytest.raises(Refused, match="elevation knows its angle: it needs no homing"):
        queue.ask(EL, CONSOLE)
    assert not queue.active
