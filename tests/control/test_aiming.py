"""What the order in force is: which orders are repeated with the panel's nudges, and which are over."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.orders import Aim, Jog, Nudge, Order, Park, Source, Stop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PANEL = Source("panel")


def targets(desk: Any) -> tuple[float | None, float | None]:
    return desk.status.azimuth.target_deg, desk.status.elevation.target_deg


@pytest.mark.parametrize(
    ("order", "before", "after"),
    [
        (Aim(200.0, 40.0), (200.0, 40.0), (203.0, 38.0)),
        (Aim(200.0, None), (200.0, None), (203.0, None)),
        (Aim(None, 40.0), (None, 40.0), (None, 38.0)),
    ],
)
def test_a_nudge_shifts_the_target_of_the_order_in_force(
    desk: Any, order: Order, before: tuple[float | None, ...], after: tuple[float | None, ...]
) -> None:
    desk.step(order)
    assert targets(desk) == pytest.approx(before)
    desk.step(Nudge(AZ, 3.0), Nudge(EL, -2.0), by=PANEL)
    assert targets(desk) == pytest.approx(after)


@pytest.mark.parametrize("over", [Stop(), Jog(AZ, Direction.PLUS, 0.1), Park(), Aim(10.0, 10.0, engaged=False)])
def test_what_ends_an_order_is_not_undone_by_a_nudge(desk: Any, over: Order) -> None:
    desk.step(Aim(200.0, 40.0))
    desk.step(over)
    desk.run(30.0)
    stood = targets(desk)
    desk.step(Nudge(AZ, 3.0), by=PANEL)
    assert targets(desk) == stood
    assert targets(desk)[0] != 203.0
