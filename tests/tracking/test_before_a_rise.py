"""A program sends where a satellite will rise, once and long before, as Gpredict does: the turn is chosen then."""

from __future__ import annotations

from functools import cache

import pytest

from rotator.exchange.orders import Aim, Leave, Order
from rotator.exchange.sources import Source
from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.passes import Pass, passes
from rotator.orbits.targets import find
from tests.tracking.tracked_box import ELEMENTS, FEBRUARY_S, Box

PC, OTHER = Source("rotctld", 1), Source("rotctld", 2)
SYDNEY = Site(-33.9, 151.2)
NAME = "RS-44"


@cache
def from_25_to_161() -> Pass:
    """A pass of 9 February 2025. Of the two turns on which a rotor of 450 degrees points at 25, only one has room."""
    target = find(NAME, SYDNEY, Catalogue((str(ELEMENTS),)))
    return next(each for each in passes(target, FEBRUARY_S + 86_400.0, FEBRUARY_S + 172_800.0, 30.0) if each.aos_s)


def after(order: Order, before_s: float, *, in_use: bool = True) -> float:
    """The azimuth after one order of a program, so long before the rise; the antenna stood on the upper turn."""
    rise_s = from_25_to_161().aos_s
    assert rise_s is not None
    box = Box(rise_s - before_s - 121.0, SYDNEY, in_use=(NAME,) if in_use else ())
    box.loop.post(OTHER, Aim(385.0, 0.0))
    box.wait(120.0)
    box.loop.post(OTHER, Leave())
    box.loop.post(PC, order)
    box.wait(80.0)
    angle_deg = box.loop.status.azimuth.angle_deg
    assert angle_deg is not None
    assert box.loop.status.recognised == ""
    return angle_deg


def rise_deg() -> float:
    target, rise_s = find(NAME, SYDNEY, Catalogue((str(ELEMENTS),))), from_25_to_161().aos_s
    assert rise_s is not None
    return target.sight(rise_s).azimuth_deg


@pytest.mark.long
@pytest.mark.parametrize("before_s", [100.0, 600.0, 1150.0])
def test_one_order_long_before_the_rise_goes_to_the_turn_of_the_pass(before_s: float) -> None:
    assert after(Aim(round(rise_deg(), 2), 0.0), before_s) == pytest.approx(25.0, abs=4.5)


@pytest.mark.long
@pytest.mark.parametrize(
    ("azimuth_deg", "elevation_deg", "before_s"),
    [
        pytest.param(round(rise_deg()), 0.0, 600.0, id="whole degrees, perhaps a person's"),
        pytest.param(round(rise_deg(), 2) + 1.0, 0.0, 600.0, id="another azimuth"),
        pytest.param(round(rise_deg(), 2), 1.0, 600.0, id="above the horizon"),
        pytest.param(round(rise_deg(), 2), 0.0, 1500.0, id="too long before"),
    ],
)
def test_any_other_order_goes_the_near_way(azimuth_deg: float, elevation_deg: float, before_s: float) -> None:
    assert after(Aim(azimuth_deg, elevation_deg), before_s) == pytest.approx(385.0, abs=5.5)


@pytest.mark.long
def test_a_satellite_that_is_not_in_use_is_looked_for_only_shortly_before_its_rise() -> None:
    order = Aim(round(rise_deg(), 2), 0.0)
    assert after(order, 600.0, in_use=False) == pytest.approx(385.0, abs=4.5)
    assert after(order, 100.0, in_use=False) == pytest.approx(25.0, abs=4.5)
