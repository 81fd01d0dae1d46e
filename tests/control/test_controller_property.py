"""Any orders, any readings, in any sequence: the motors are driven only within the rules."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Jog,
    LoadTimed,
    Order,
    Park,
    Release,
    RunTimed,
    Source,
    Speed,
    Stop,
)

LINKS = [Source("gs232b", 1), Source("rotctld", 1), Source("console")]
LONGEST_LEASE_S = 0.5

azimuths = st.floats(0, 540)
elevations = st.floats(-90, 180)
axes = st.sampled_from(Axis)
moves = st.one_of(
    st.builds(Aim, azimuths, st.none() | elevations, st.booleans()),
    st.builds(Jog, axes, st.sampled_from(Direction), st.none() | st.floats(0, 5)),
    st.just(Park()),
    st.builds(
        LoadTimed,
        st.integers(1, 3).map(float),
        st.lists(st.tuples(azimuths, st.none() | elevations), min_size=1, max_size=3).map(tuple),
    ),
    st.just(RunTimed()),
)
others = st.one_of(
    st.builds(Stop, st.sampled_from([tuple(Axis), (Axis.AZIMUTH,), (Axis.ELEVATION,)]), st.booleans()),
    st.just(Release()),
    st.just(ClearTimed()),
    st.builds(Speed, st.integers(1, 4)),
    st.builds(Calibrate, axes, st.booleans()),
)
healthy = st.floats(0.02, 0.98)
raws = healthy | st.sampled_from([None, 0.0, 0.019, 0.02, 0.05, 0.95, 0.98, 1.0, math.nan, math.inf, -math.inf])
steps = st.lists(
    st.tuples(
        st.floats(0.001, 1.0) | st.sampled_from([0.05, 0.05, 10.0]),
        st.lists(st.tuples(st.sampled_from(LINKS), moves | others), max_size=3),
        st.tuples(raws, raws) | st.none(),  # None: the rotor's own pots, following the motors
    ),
    min_size=1,
    max_size=40,
)
missing = st.sampled_from([(), (), ("calibration",), ("direction check",)])
any_day = settings(max_examples=200, deadline=None)
Script = list[tuple[float, list[tuple[Source, Order]], tuple[float | None, float | None] | None]]


def drives(desk: Any, script: Script) -> Any:
    """Play a script; after every step yields the orders it held."""
    for seconds, orders, raw in script:
        desk.instead = {} if raw is None else dict(zip(Axis, raw, strict=True))
        # Orders of several links in one step: all but the last at no distance in time.
        for count, (link, order) in enumerate(orders):
            desk.step(order, by=link, seconds=0.0 if count else seconds)
            yield order
        if not orders:
            desk.step(seconds=seconds)
            yield None


@any_day
@given(script=steps, azimuth=missing, elevation=missing)
def test_nothing_is_driven_against_a_rule(
    new_desk: Any, script: Script, azimuth: tuple[str, ...], elevation: tuple[str, ...]
) -> None:
    desk = new_desk(missing={Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation})
    ordered = latched = False
    for order in drives(desk, script):
        ordered = ordered or isinstance(order, Aim | Jog | Park | LoadTimed)
        match order:
            case Stop(axes, True) if len(axes) == len(Axis):
                latched = True
            case Release():
                latched = False
        assert bool(desk.status.latched) == latched
        for axis, run in desk.runs.items():
            if run.direction is Direction.OFF:
                continue
            assert ordered, "driven before the first order"
            assert not latched, "driven while latched"
            assert desk.status.axis(axis).fault is None, "driven with a fault"
            raw = desk.instead.get(axis, desk.raw(axis))
            assert raw is not None, "driven blind"
            assert 0.02 <= raw <= 0.98, "driven on a reading out of range"
            assert desk.now_s <= run.until_s <= desk.now_s + LONGEST_LEASE_S, "driven on too long a lease"


@pytest.mark.xfail(strict=True, reason="the law's guess at the coast is trusted beyond the limit")
@settings(any_day, phases=(Phase.reuse, Phase.generate))
@given(script=steps)
def test_nothing_is_driven_outward_beyond_its_limit(new_desk: Any, script: Script) -> None:
    desk = new_desk()
    for _ in drives(desk, script):
        for axis, run in desk.runs.items():
            angle_deg, limits = desk.status.axis(axis).angle_deg, desk.range[axis]
            if angle_deg is not None and not limits.min_deg < angle_deg < limits.max_deg:
                outward = Direction.PLUS if angle_deg >= limits.max_deg else Direction.MINUS
                assert run.direction is not outward


@any_day
@given(script=steps)
def test_an_axis_that_lacks_its_calibration_is_driven_by_jogs_alone(new_desk: Any, script: Script) -> None:
    desk = new_desk(missing=dict.fromkeys(Axis, ("calibration", "direction check")))
    pressed_s = dict.fromkeys(Axis, -math.inf)
    for order in drives(desk, script):
        if isinstance(order, Jog):
            pressed_s[order.axis] = desk.now_s
        for axis, run in desk.runs.items():
            assert run.direction is Direction.OFF or run.until_s <= pressed_s[axis] + 2.0 + 1e-9
