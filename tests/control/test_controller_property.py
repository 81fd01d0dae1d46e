"""Any orders, any readings, in any sequence: the motors are driven only within the rules."""

from __future__ import annotations

import math
from typing import Any, get_args

from hypothesis import example, given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.control.axis.goals import LONGEST_WAIT_S, UNCALIBRATED_JOG_S
from rotator.control.commands import Place
from rotator.exchange.faults import Missing
from rotator.exchange.flight_order import AxisPlan, Fly, Step, TakeTurn
from rotator.exchange.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    GiveBack,
    Home,
    Jog,
    Leave,
    LetGo,
    LoadTimed,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    Remark,
    RunTimed,
    SetMode,
    Speed,
    Stop,
    Take,
    Unheeded,
)
from rotator.exchange.sources import CONSOLE, Source
from tests.search import examples

LINKS = [Source("gs232b", 1), Source("rotctld", 1), Source("console")]
LONGEST_LEASE_S = 0.5
PARKED_DEG = 0.0
"""The desk's park position, on both axes."""

azimuths = st.floats(0, 540)
elevations = st.floats(-90, 180)
axes = st.sampled_from(Axis)
moments_s = st.lists(st.floats(0, 200), min_size=2, max_size=4, unique=True).map(sorted)
# A plan of any angles: what is beyond the limits must not be gone to, however it was made.
axis_plans = st.builds(
    AxisPlan,
    st.floats(0, 200),
    st.lists(st.floats(-90, 540), min_size=1, max_size=6).map(tuple),
    st.lists(st.builds(Step, st.floats(0, 200), st.floats(-90, 540)), max_size=4).map(
        lambda steps: tuple(sorted(steps, key=lambda step: step.leave_s))
    ),
)
paths = moments_s.flatmap(
    lambda rising_s: st.tuples(*(st.tuples(st.just(at_s), azimuths, elevations) for at_s in rising_s))
)
moves = st.one_of(
    st.builds(Fly, st.just("SO-50"), paths, axis_plans, axis_plans),
    st.builds(Aim, azimuths, st.none() | elevations, st.booleans()),
    st.builds(Jog, axes, st.sampled_from(Direction), st.none() | st.floats(0, 5)),
    st.just(Park()),
    st.builds(Home, axes),
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
    st.just(Park(storm=True)),
    st.builds(SetMode, st.sampled_from(Mode)),
    st.builds(Nudge, axes, st.floats(-45, 45)),
    st.builds(Confirm, axes, st.floats(-360, 720)),
    st.just(LetGo()),
    st.builds(Remark, axes, st.sampled_from(["", "its wire is broken"])),
    st.just(Leave()),
    st.builds(RelaysChecked, axes),
    st.builds(Take),
    st.builds(GiveBack),
    st.builds(Unheeded, st.just(Park()) | st.builds(Aim, azimuths, elevations)),
    st.builds(TakeTurn, st.floats(-90, 540), st.booleans(), st.floats(0, 200)),
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
missing = st.sampled_from([(), (), (Missing.CALIBRATION,), (Missing.DIRECTION_CHECK,)])
any_day = settings(max_examples=examples(200), deadline=None)


def test_every_order_there_is_takes_part() -> None:
    """A new order that is missing here would never be tried."""
    drawn = set()

    @settings(max_examples=500, deadline=None, database=None)
    @given(moves | others)
    def draw(order: Order) -> None:
        drawn.add(type(order))

    draw()
    assert drawn == set(get_args(Order))


Script = list[tuple[float, list[tuple[Source, Order]], tuple[float | None, float | None] | None]]


def drives(desk: Any, script: Script) -> Any:
    """Play a script; after every step yields its order, and who gave it."""
    for seconds, orders, raw in script:
        desk.instead = {} if raw is None else dict(zip(Axis, raw, strict=True))
        # Orders of several links in one step: all but the last at no distance in time.
        for count, (link, order) in enumerate(orders):
            desk.step(order, by=link, seconds=0.0 if count else seconds)
            yield link, order
        if not orders:
            desk.step(seconds=seconds)
            yield LINKS[0], None


class Rules:
    """What the orders so far allow, as a person would say it."""

    def __init__(self) -> None:
        self.ordered = self.latched = self.storm = False
        self._mode, self._panel = Mode.AUTO, LINKS[0]
        self._held_by: Source | None = None
        self._good: dict[Axis, tuple[float, Direction]] = {}
        """When each axis was last driven on a good reading, and which way."""

    def note(self, source: Source, order: Order | None) -> None:
        self.ordered = self.ordered or isinstance(order, Aim | Fly | Jog | Park | LoadTimed | Home)
        match order:
            case Stop(axes, True) if len(axes) == len(Axis):
                self.latched, self.storm = True, False
            case LetGo():
                self.latched, self.storm = True, False
            case Stop():
                self.storm = False
            case SetMode(mode):
                self._mode, self._panel, self._held_by, self.storm = mode, source, None, False
            case Take() if not self.storm:
                self._mode = self._mode if source == self._panel else Mode.AUTO
                self._held_by = source
            case GiveBack() if self._held_by in (None, source) or source.is_person:
                self._mode, self._held_by = Mode.AUTO, None
            case Park(storm=True) if self._may_park(source):
                self.latched = self.storm = True
            case Release():
                self.latched = self.storm = False

    def _may_park(self, source: Source) -> bool:
        """A storm park opens neither another's stop nor the panel's switch. All at the console are one person."""
        own = source == self._panel or source.link == CONSOLE == self._panel.link
        return (self.storm or not self.latched) and (self._mode is Mode.AUTO or (own and self._mode is Mode.MANUAL))

    def check_driven(self, desk: Any) -> None:
        for axis, run in desk.runs.items():
            if run.direction is Direction.OFF:
                continue
            assert self.ordered, "driven before the first order"
            assert self.storm or not self.latched, "driven while latched"
            assert not self.storm or desk.status.axis(axis).target_deg == PARKED_DEG, "driven elsewhere in a storm"
            assert desk.status.axis(axis).fault is None, "driven with a fault"

    def check(self, desk: Any) -> None:
        assert bool(desk.status.latched) == self.latched
        self.check_driven(desk)
        for axis, run in desk.runs.items():
            if run.direction is Direction.OFF:
                continue
            raw = desk.instead.get(axis, desk.raw(axis))
            if raw is not None and 0.02 <= raw <= 0.98:
                self._good[axis] = desk.now_s, run.direction
            good_s, running = self._good.get(axis, (-math.inf, None))
            assert run.until_s <= good_s + LONGEST_LEASE_S, "driven long after the last good reading"
            assert run.direction is running, "started on a bad reading"
            assert desk.now_s <= run.until_s <= desk.now_s + LONGEST_LEASE_S, "driven on too long a lease"


@any_day
@given(script=steps, azimuth=missing, elevation=missing)
def test_nothing_is_driven_against_a_rule(
    new_desk: Any, script: Script, azimuth: tuple[Missing, ...], elevation: tuple[Missing, ...]
) -> None:
    desk = new_desk(missing={Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation})
    rules = Rules()
    for source, order in drives(desk, script):
        rules.note(source, order)
        rules.check(desk)


people = st.sampled_from([Source("console", 1), Source("console", 2), LINKS[0]])
homes = st.builds(Home, axes)
storm = st.just(Park(storm=True))
visits = st.lists(st.tuples(people, homes | storm | moves | others, st.sampled_from([0.0, 0.2, 1.0, 6.0])), max_size=12)


@settings(max_examples=examples(100), deadline=None)
@given(visits=visits, lost=st.booleans())
def test_homing_ends_only_by_an_order_a_stop_found_or_a_fault(
    new_desk: Any, visits: list[tuple[Source, Order, float]], *, lost: bool
) -> None:
    desk = new_desk(counted=True, at=(30.0, 20.0), park_after_s=3.0)
    desk.lost = dict.fromkeys(Axis, "not done yet" if lost else "")
    rules = Rules()
    for person, order, then_s in visits:
        desk.step(order, by=person)
        rules.note(person, order)
        for _ in range(1 + round(then_s / 0.05)):
            homing = [axis for axis in Axis if desk.status.axis(axis).homing]
            assert not (rules.latched and homing), "homes while a person holds the antenna"
            assert bool(desk.status.latched) == rules.latched
            rules.check_driven(desk)
            desk.controller.errands.clear()
            desk.step()
            for axis in homing:
                found = any(isinstance(errand, Place) and errand.axis is axis for errand in desk.controller.errands)
                ended = not desk.status.axis(axis).homing
                assert not ended or found or desk.status.axis(axis).fault, "homing ended by itself"


@any_day
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
@example(
    lacks=Missing.LIMITS,
    script=[
        (0.0, Jog(Axis.AZIMUTH, Direction.MINUS, None)),
        (2.5, Jog(Axis.AZIMUTH, Direction.PLUS, None)),
    ],
)
@given(
    lacks=st.sampled_from([Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK]),
    script=st.lists(st.tuples(st.sampled_from([0.0, 0.05, 0.5, 2.5]), st.none() | moves), min_size=1, max_size=20),
)
def test_an_axis_that_lacks_anything_is_driven_by_jogs_alone(
    new_desk: Any, lacks: Missing, script: list[tuple[float, Order | None]]
) -> None:
    """The time of a press begins when its relay closes: before a reversal the axis is first seen to stand."""
    desk = new_desk(missing=dict.fromkeys(Axis, (lacks,)))
    pressed = dict.fromkeys(Axis, (-math.inf, Direction.OFF))
    closed_s = dict.fromkeys(Axis, math.inf)
    desk.step()
    for wait_s, order in script:
        desk.step(*([order] if order else []))
        if isinstance(order, Jog):
            pressed[order.axis] = desk.now_s, order.direction
        for _ in range(1 + round(wait_s / 0.05)):
            for axis, run in desk.runs.items():
                if run.direction is Direction.OFF:
                    closed_s[axis] = math.inf
                    continue
                closed_s[axis] = min(closed_s[axis], desk.now_s)
                pressed_s, direction = pressed[axis]
                assert run.direction is direction, "driven another way than the latest press"
                assert closed_s[axis] <= pressed_s + LONGEST_WAIT_S, "driven long after the press"
                assert run.until_s <= closed_s[axis] + UNCALIBRATED_JOG_S + 1e-9, "driven for longer than a press"
            desk.step()


@any_day
@given(
    start=st.tuples(st.floats(0, 360), st.floats(-10, 180)),
    rate_dps=st.tuples(st.floats(-4, 4), st.floats(-2, 2)),
    interval_s=st.sampled_from([0.5, 1.0, 2.0, 4.9]),
    ragged_s=st.lists(st.floats(0, 0.4), min_size=4, max_size=60),
)
def test_a_stream_of_orders_is_followed_within_the_rules(
    new_desk: Any, start: tuple[float, float], rate_dps: tuple[float, float], interval_s: float, ragged_s: list[float]
) -> None:
    desk = new_desk()
    desk.step()
    for late_s in ragged_s:
        wait_s = interval_s + late_s
        passed_s = desk.now_s + wait_s - 1000.0
        desk.run(wait_s)
        azimuth_deg, elevation_deg = (at + rate * passed_s for at, rate in zip(start, rate_dps, strict=True))
        desk.step(Aim(float(round(azimuth_deg) % 360), float(round(min(max(elevation_deg, -10), 180)))))
        for axis, run in desk.runs.items():
            status, limits = desk.status.axis(axis), desk.range[axis]
            assert limits.holds(status.target_deg), "sent beyond its range"
            assert limits.min_deg - 1.5 <= desk.angle_deg[axis] <= limits.max_deg + 1.5
            assert run.direction is Direction.OFF or desk.now_s <= run.until_s <= desk.now_s + LONGEST_LEASE_S
