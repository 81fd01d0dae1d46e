"""An order that was taken and moves nothing: `rotator where`, the console and the page say why, for each reason."""

from __future__ import annotations

from typing import Any

import pytest

from hw.ports import Axis
from rotator.control.sky.mount import Range, Sector
from rotator.exchange.faults import Missing
from rotator.exchange.orders import Aim, Mode, Order, SetMode, Stop, Take
from rotator.exchange.sources import Source
from rotator.protocols.console_session import report
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
LINK, PANEL, PAGE = Source("gs232b", 1), Source("panel"), Source("page", 1)
CHIMNEY = Sector("chimney", Range(150.0, 200.0), Range(0.0, 90.0), 2.0)

REASONS: dict[str, tuple[dict[str, Any], tuple[tuple[Source, Order], ...], Aim, str]] = {
    "six degrees at 60°": (
        {"at": (100.0, 60.0)},
        (),
        Aim(106.0, 60.0),
        "note: azimuth: within tolerance: 6.0° from its target, 3.0° on the sky; it turns from 8.0° on",
    ),
    "three degrees of an axis": (
        {"at": (100.0, 60.0), "on_sky": False},
        (),
        Aim(103.0, 60.0),
        "note: azimuth: within tolerance: 3.0° from its target, 1.5° on the sky; it turns from 4.0° on",
    ),
    "three degrees up": (
        {"at": (100.0, 60.0)},
        (),
        Aim(100.0, 63.0),
        "note: elevation: within tolerance: 3.0° from its target; it turns from 4.0° on",
    ),
    "below the horizon": (
        {"at": (100.0, 0.0)},
        (),
        Aim(100.0, -10.0),
        "note: elevation: -10.0° is below its range or the horizon: it stays at 0.0°",
    ),
    "stopped": ({}, ((PANEL, Stop(latch=True)),), Aim(200.0, 40.0), "stopped by: the panel"),
    "parked by the panel": ({}, ((PANEL, SetMode(Mode.PARK)),), Aim(200.0, 40.0), "panel: PARK"),
    "held by a person": ({}, ((PAGE, Take()),), Aim(200.0, 40.0), "held by: the page"),
    "not set up": (
        {"missing": dict.fromkeys(Axis, (Missing.DIRECTION_CHECK,))},
        (),
        Aim(200.0, 40.0),
        "missing: azimuth needs",
    ),
    "a sector": ({"at": (147.0, 40.0), "sectors": (CHIMNEY,)}, (), Aim(175.0, 40.0), "note: azimuth: the target is in"),
}


@every_row("reason", REASONS)
def test_the_reason_is_told(new_desk: Any, reason: str) -> None:
    keys, before, aim, told = REASONS[reason]
    desk = new_desk(**keys)
    desk.run(1.0)
    for source, order in before:
        desk.step(order, by=source)
    stood_deg = dict(desk.angle_deg)
    desk.step(aim, by=LINK)
    desk.run(3.0)
    assert desk.angle_deg == pytest.approx(stood_deg, abs=1.0)
    lines = report(desk.status)
    assert [line for line in lines if line.startswith(told)], lines


def test_where_it_points_nothing_is_said(desk: Any) -> None:
    desk.step(Aim(150.0, 30.0), by=LINK)
    assert desk.status.stays == ()
    desk.run(20.0)
    assert desk.status.stays == ()
