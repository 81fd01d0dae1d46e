"""A box whose azimuth has a wedge brake, from the order to the wedge, in simulated time: what the brake feels, what a
brake that fails is called, and what a rock does.

The world judges: no motor fed against its brake, no wedge that falls on a shaft that turns.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from hw.ports import AngleSource, Direction
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Aim, Home, Jog, Release, Stop
from tests.rotors.rig import AZ, OF, PERSON, Box, Kind

BRAKE_PIN, ENGAGE_S = 26, 2.0
BRAKE = {"line": BRAKE_PIN, "release_s": 0.5, "engage_s": ENGAGE_S}
KINDS = (
    Kind("g5500", AngleSource.MEASURED, (90.0, 30.0), 1.0, 1.3),
    Kind("u100", AngleSource.COUNTED, (90.0, 70.0), 1.0, 1.0, short_deg=2.0),
)
EACH = pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.profile)
COASTS_S = 0.85


def braked(kind: Kind = KINDS[0], **keys: Any) -> Box:
    return Box(kind, azimuth={"brake": BRAKE | keys})


@pytest.fixture
def rocking() -> Iterator[Box]:
    box = braked(rock=True)
    box.run(2.0)
    yield box
    box.close()


def released(box: Box) -> bool:
    return box.world.gpio.level(BRAKE_PIN)


def drives(box: Box, seconds: float) -> list[int]:
    """The directions of azimuth's coils in this time, each once."""
    seen = [box.world.drives()[0]]
    for _ in range(round(seconds / box.period_s)):
        box.run(box.period_s)
        if (now := box.world.drives()[0]) != seen[-1]:
            seen.append(now)
    return seen


def settled(box: Box) -> None:
    """A pot shows enough of its noise for the box to know it."""
    box.run(3.0)


@EACH
def test_an_order_is_carried_out_with_the_brake_off_and_on_again(kind: Kind) -> None:
    box = braked(kind)
    settled(box)
    assert not released(box)
    box.order(Aim(130.0, kind.start_deg[1]))
    box.run(0.1)
    assert released(box)
    assert box.world.drives()[0] == 0
    box.until(lambda: box.world.drives()[0] == 1, 0.5)
    box.until(lambda: box.world.drives()[0] == 0)
    box.until(lambda: not released(box), COASTS_S + ENGAGE_S + 1.0)
    box.run(1.0)
    assert abs(box.boom_deg(AZ) - 130.0) <= kind.within_deg
    assert box.axis(AZ).fault is None
    assert box.world.brake_harm == (0.0, 0)


@EACH
def test_a_stop_opens_the_motor_at_once_and_the_brake_engages_after_rest(kind: Kind) -> None:
    box = braked(kind)
    settled(box)
    box.order(Aim(200.0, kind.start_deg[1]))
    box.run(4.0)
    box.order(Stop(), by=PERSON)
    box.loop.act()
    assert box.world.drives()[0] == 0
    box.run(COASTS_S + ENGAGE_S - 1.0)
    assert released(box)
    box.run(2.0)
    assert not released(box)
    assert box.world.brake_harm == (0.0, 0)


@EACH
def test_a_brake_that_does_not_release_is_a_fault_of_its_own_name(kind: Kind) -> None:
    box = braked(kind)
    settled(box)
    box.world.inject("azimuth-brake-stuck")
    box.order(Aim(200.0, kind.start_deg[1]))
    box.until(lambda: box.axis(AZ).fault is not None, 30.0)
    fault = box.axis(AZ).fault
    assert fault is not None
    assert fault.kind is FaultKind.BRAKE_HELD
    assert "azimuth: brake did not release: its motor r" in str(fault)
    assert box.world.drives()[0] == 0
    box.world.clear("azimuth-brake-stuck")
    if kind.source is AngleSource.COUNTED:
        return  # it has to be homed: its contact has not shown that its relay opened
    box.order(Release(), by=PERSON)
    box.loop.post(PERSON, Jog(AZ, Direction.PLUS, 3.0))
    box.run(3.0)
    assert box.boom_deg(AZ) > kind.start_deg[0] + 4.0
    assert box.axis(AZ).fault is None


def test_a_press_lasts_as_long_as_without_a_brake() -> None:
    turned = []
    for box in (braked(), Box(KINDS[0])):
        settled(box)
        box.order(Jog(AZ, Direction.PLUS, 2.0), by=PERSON)
        box.run(6.0)
        turned.append(box.boom_deg(AZ))
    assert turned[0] == pytest.approx(turned[1], abs=0.5)


# --- rock


def test_a_wedge_that_sticks_is_rocked_once_and_the_antenna_arrives(rocking: Box) -> None:
    rocking.world.inject("azimuth-wedge-sticks")
    rocking.order(Aim(130.0, 30.0))
    assert drives(rocking, 6.0) == [0, 1, 0, -1, 0, 1]
    rocking.until_it_stands()
    assert rocking.axis(AZ).fault is None
    assert abs(rocking.boom_deg(AZ) - 130.0) <= 1.0
    assert rocking.world.shorted_s == 0.0
    assert rocking.world.brake_harm == (0.0, 0)


def test_a_wedge_that_a_rock_does_not_free_is_a_fault(rocking: Box) -> None:
    rocking.world.inject("azimuth-brake-stuck")
    rocking.order(Aim(130.0, 30.0))
    assert drives(rocking, 20.0) == [0, 1, 0, -1, 0, 1, 0]
    fault = rocking.axis(AZ).fault
    assert fault is not None
    assert fault.kind is FaultKind.BRAKE_HELD
    assert "wedge" in str(fault)
    assert rocking.world.shorted_s == 0.0


def test_a_stop_ends_a_rock(rocking: Box) -> None:
    rocking.world.inject("azimuth-brake-stuck")
    rocking.order(Aim(130.0, 30.0))
    rocking.until(lambda: rocking.world.drives()[0] == -1, 20.0)
    rocking.order(Stop(), by=PERSON)
    rocking.loop.act()
    assert drives(rocking, 5.0) == [0]


def test_without_the_key_nothing_is_rocked() -> None:
    box = braked()
    settled(box)
    box.world.inject("azimuth-wedge-sticks")
    box.order(Aim(130.0, 30.0))
    assert drives(box, 20.0) == [0, 1, 0]


def test_a_jog_is_never_rocked(rocking: Box) -> None:
    rocking.world.inject("azimuth-wedge-sticks")
    rocking.order(Jog(AZ, Direction.PLUS, 10.0), by=PERSON)
    assert -1 not in drives(rocking, 12.0)


def test_a_counted_axis_with_a_brake_finds_its_end_stop() -> None:
    box = braked(OF["u100"])
    settled(box)
    box.order(Home(AZ), by=PERSON)
    box.until(lambda: not box.axis(AZ).homing and box.axis(AZ).fault is None and box.boom_deg(AZ) < 5.0, 60.0)
    assert box.axis(AZ).angle_deg == pytest.approx(box.boom_deg(AZ), abs=1.0)
    assert box.world.brake_harm == (0.0, 0)
