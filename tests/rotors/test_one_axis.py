"""Rotors with one axis alone: the other one is not asked for, read, drawn or driven, whatever is ordered.

Judged by the simulated world, where the motor of the axis that is not fitted stands beside, ready to turn.
"""

from __future__ import annotations

import itertools
import random
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.config.mistake import ConfigError
from rotator.exchange.orders import Aim, Calibrate, Confirm, Home, Jog, Nudge, Order, Park, RelaysChecked, Release, Stop
from rotator.protocols.rotctld_caps import dump_caps, dump_state
from rotator.views.lcd import rows
from tests.rotors.rig import AZ, EL, KINDS, PERSON, Box, Kind, configured

ALONE = [pytest.param(kind, axis, id=f"{kind.profile}-{axis.value}") for kind in KINDS for axis in Axis]
STANDS_DEG = {"orbit360": 2.5}
"""By profile, else 0.01: a simulated control box turns to the middle step of a chip that nobody has set."""


def alone(kind: Kind, axis: Axis, **keys: Any) -> Box:
    """This kind with this axis alone. `keys`: of the table of the axis that is not fitted."""
    other = EL if axis is AZ else AZ
    tables: dict[str, Any] = {other.value: {"fitted": False} | keys}
    return Box(kind, **tables)


@pytest.mark.parametrize(("kind", "axis"), ALONE)
def test_it_turns_to_its_target_and_the_other_axis_is_never_driven(kind: Kind, axis: Axis) -> None:
    box = alone(kind, axis)
    assert set(box.rotor.sensors) == {axis}
    other = EL if axis is AZ else AZ
    stood_deg = box.shaft_deg(other)
    box.run(2.0)
    target_deg = box.boom_deg(axis) + (25.0 if kind.profile != "servos" else -25.0)
    # A satellite's direction: what the axis that is not fitted cannot do, it is not asked for.
    box.order(Aim(target_deg, 45.0) if axis is AZ else Aim(123.0, target_deg))
    box.until(lambda: box.axis(axis).moving)
    box.until_it_stands()
    assert box.boom_deg(axis) == pytest.approx(target_deg, abs=kind.within_deg)
    assert box.shaft_deg(other) == pytest.approx(stood_deg, abs=STANDS_DEG.get(kind.profile, 0.01))
    assert box.axis(axis).at_target
    assert not box.status.faults
    assert not box.axis(other).missing
    assert not box.status.stays
    box.close()


@pytest.mark.parametrize(("kind", "axis"), ALONE)
def test_an_order_for_the_axis_that_is_not_fitted_is_refused_in_a_sentence(kind: Kind, axis: Axis) -> None:
    box = alone(kind, axis)
    box.run(1.0)
    other = EL if axis is AZ else AZ
    client = box.client(PERSON)
    for order in (
        Jog(other, Direction.PLUS, 1.0),
        Home(other),
        Confirm(other, 0.0),
        Calibrate(other, high_end=True),
        RelaysChecked(other),
        Nudge(other, 5.0),
    ):
        refused = client.order(order)
        assert refused is not None, order
        assert f"no {other.value}" in refused.reason
    # What stops is no such order.
    assert client.order(Stop((other,))) is None
    box.close()


@pytest.mark.search
@pytest.mark.parametrize("seed", range(10))
def test_whatever_is_ordered_the_axis_that_is_not_fitted_stands(seed: int) -> None:
    chance = random.Random(f"alone {seed}")
    for kind, axis in itertools.product(KINDS, Axis):
        box = alone(kind, axis)
        other = EL if axis is AZ else AZ
        stood_deg = box.shaft_deg(other)
        for _ in range(25):
            box.order(any_order(chance), by=PERSON)
            box.run(chance.choice([0.05, 0.4, 3.0]))
        assert box.shaft_deg(other) == pytest.approx(stood_deg, abs=STANDS_DEG.get(kind.profile, 0.01)), (
            kind.profile,
            axis,
            seed,
        )
        assert box.world.drives()[list(Axis).index(other)] == 0
        assert not [fault for fault in box.status.faults if fault.axis is other]
        box.close()


def any_order(chance: random.Random) -> Order:
    axis, angle_deg = chance.choice(list(Axis)), chance.uniform(-20, 200)
    orders: list[Order] = [
        Aim(chance.uniform(0, 360), chance.uniform(-5, 120)),
        Aim(None, angle_deg),
        Aim(angle_deg, None),
        Jog(axis, chance.choice(list(Direction)), chance.choice([None, 0.5])),
        Home(axis),
        Confirm(axis, angle_deg),
        Nudge(axis, chance.uniform(-10, 10)),
        RelaysChecked(axis),
        Park(),
        Park(storm=True),
        Release(),
        Stop(),
        Stop((axis,)),
    ]
    return chance.choice(orders)


def test_the_display_has_one_angle_a_row_and_rotctld_names_the_type() -> None:
    (pots, *_) = KINDS
    box = alone(pots, AZ)
    box.run(1.0)
    box.order(Aim(235.0, 25.0))
    box.run(0.2)
    assert rows(box.status, 0.0) == ("SAT A:235       ", "SIM A:090       ")
    assert "rot_type=Az\n" in dump_state(box.status).default_text
    assert "Rot type:\t\tAzimuth\n" in dump_caps(box.status).text
    box.close()


def test_what_the_file_says_of_an_axis_that_is_not_fitted_is_ignored() -> None:
    config = configured("g5500", elevation={"fitted": False, "min_deg": 10}, limits={"elevation_low": 16})
    keys = [key for _, key in config.pins()]
    assert not [key for key in keys if "elevation" in key]
    assert [line.name for line in config.off_lines()] == ["azimuth_cw", "azimuth_ccw"]


def test_a_tilted_boom_is_an_offset() -> None:
    box = alone(KINDS[0], AZ, offset_deg=15)
    assert box.status.elevation.points_deg == 15.0
    box.close()


def test_one_axis_must_be_there() -> None:
    with pytest.raises(ConfigError, match="neither axis is fitted"):
        configured("g5500", azimuth={"fitted": False}, elevation={"fitted": False})
