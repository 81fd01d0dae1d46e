"""A relay of one axis was found closed: with a master relay, nothing feeds its motor by way of the other axis."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.assembly.settings import build_controller
from rotator.config.load import parse
from rotator.control.axis.readings import Reading
from rotator.control.commands import Feed, Run
from rotator.control.controller import Controller
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import ALL_OPEN, Trust, Trusts
from rotator.exchange.orders import Aim, Jog, Order, Park, RelaysChecked, Release
from rotator.exchange.sources import Source
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PERSON, CYCLE_S = Source("console", 1), 0.05
MASTER = "[relays]\nmaster = 21\n"
FOUND: tuple[Trusts, ...] = ((Trust.WELDED, Trust.OPEN), (Trust.OPEN, Trust.WELDED))
ORDERS: dict[str, Callable[[Axis], Order]] = {
    "aim": lambda _axis: Aim(100.0, 30.0),
    "jog": lambda axis: Jog(axis, Direction.PLUS, 5.0),
    "jog back": lambda axis: Jog(axis, Direction.MINUS, 5.0),
    "park": lambda _axis: Park(),
    "storm park": lambda _axis: Park(storm=True),
}


class Desk:
    def __init__(self, found: Axis, trusts: Trusts, *, master: bool = True) -> None:
        both = {axis: trusts if axis is found else ALL_OPEN for axis in Axis}
        self.controller: Controller = build_controller(parse(MASTER if master else "", "test"), {}, trusts=both)
        self.now_s = 0.0
        self.fed: dict[Axis, bool] = dict.fromkeys(Axis, False)
        self.run(5.0)

    def run(self, seconds: float, *orders: Order) -> None:
        """Each axis stands at the middle of its range."""
        self.fed = dict.fromkeys(Axis, False)
        for _ in range(round(seconds / CYCLE_S)):
            self.now_s += CYCLE_S
            readings = {axis: Reading(self.now_s, 0.5) for axis in Axis}
            commands = self.controller.step(self.now_s, readings, [(PERSON, order) for order in orders])
            orders = ()
            for axis, command in commands.items():
                runs = isinstance(command, Run) and command.direction is not Direction.OFF
                self.fed[axis] = self.fed[axis] or runs or isinstance(command, Feed)
            self.controller.note_driven(self.now_s, dict.fromkeys(Axis, Direction.OFF))

    def fault(self, axis: Axis) -> Any:
        return self.controller.status(self.now_s).axis(axis).fault


def other(axis: Axis) -> Axis:
    return EL if axis is AZ else AZ


@pytest.mark.long
@every_row("trusts", FOUND)
@every_row("found", Axis)
@every_row("name", ORDERS)
def test_no_order_feeds_the_other_axis_and_it_is_said_why(name: str, found: Axis, trusts: Trusts) -> None:
    desk = Desk(found, trusts)
    for _ in range(3):
        desk.run(5.0, ORDERS[name](other(found)))
        assert not desk.fed[other(found)]
        fault = desk.fault(other(found))
        assert fault.kind is FaultKind.RELAY_WELDED
        assert f"relays-checked {found.value}" in str(fault)
        desk.run(1.0, Release())


@pytest.mark.parametrize("found", Axis)
def test_after_a_person_has_looked_at_the_relay_the_other_axis_turns_again_at_the_next_order(found: Axis) -> None:
    desk = Desk(found, FOUND[0])
    desk.run(5.0, ORDERS["jog"](other(found)))
    desk.run(5.0, RelaysChecked(found), Release())
    assert not desk.fed[other(found)], "nothing moves without an order"
    desk.run(5.0, ORDERS["jog"](other(found)))
    assert desk.fed[other(found)]


@pytest.mark.parametrize("found", Axis)
def test_its_own_axis_may_be_jogged_in_the_direction_of_the_weld(found: Axis) -> None:
    desk = Desk(found, FOUND[0])
    desk.run(5.0, Jog(found, Direction.PLUS, 2.0))
    assert desk.fed[found]


@every_row("trusts", [ALL_OPEN, (Trust.DOUBTED, Trust.OPEN), (Trust.UNSEEN, Trust.UNSEEN)])
@every_row("found", Axis)
def test_a_doubt_alone_keeps_the_other_axis_from_nothing(found: Axis, trusts: Trusts) -> None:
    desk = Desk(found, trusts)
    desk.run(5.0, ORDERS["jog"](other(found)))
    assert desk.fed[other(found)]


@pytest.mark.parametrize("found", Axis)
def test_without_a_master_the_supply_is_on_anyway(found: Axis) -> None:
    desk = Desk(found, FOUND[0], master=False)
    desk.run(5.0, ORDERS["jog"](other(found)))
    assert desk.fed[other(found)]
