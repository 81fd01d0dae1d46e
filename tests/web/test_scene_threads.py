"""Two orders at the same moment, in two threads: the page counts each stop, and each flight has its own key."""

from __future__ import annotations

import pytest

from hw.ports import AngleSource
from rotator.exchange.flight_order import AxisPlan, Fly
from rotator.exchange.orders import Order, Stop
from rotator.exchange.status import AxisStatus, Status
from rotator.web import scene
from rotator.web.scene import Scene
from tests.interleaved import interleaved

STATUS = Status(
    0.0, AxisStatus(0.0, 360.0, source=AngleSource.MEASURED), AxisStatus(0.0, 180.0, source=AngleSource.MEASURED)
)
STOP = Stop(latch=True)


def new() -> Scene:
    return Scene(lambda: STATUS, list, [], lambda _number: "", lambda: "off", utc=lambda: 0.0, clock_is_known=bool)


def fly(name: str) -> Fly:
    plan = AxisPlan(0.0, (10.0, 11.0), ())
    return Fly(name, ((0.0, 10.0, 20.0), (1.0, 11.0, 21.0)), plan, plan)


@pytest.mark.parametrize(("first", "second"), [(STOP, STOP), (STOP, fly("A")), (fly("A"), STOP), (fly("A"), fly("B"))])
def test_at_whichever_instruction_the_other_order_comes_both_count(first: Order, second: Order) -> None:
    orders = (first, second)
    stops, flights = orders.count(STOP), [order for order in orders if isinstance(order, Fly)]
    for place, seen in interleaved(scene, new, lambda s: s.note_order(first), lambda s: s.note_order(second)):
        assert seen.stops == stops, place
        if flights:
            seen.note_order(fly("A"))
            assert seen.path()["key"] == f"{len(flights) + 1} A", place
