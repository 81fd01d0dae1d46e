"""The idle park, judged by what the drives do: its four bad cases by hand, and a search over orders and losses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.faults import FaultKind, Missing
from rotator.exchange.orders import (
    Aim,
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
    Release,
    RunTimed,
    SetMode,
    Stop,
    Take,
)
from rotator.exchange.sources import Source
from tests.search import examples

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
LINK, CONSOLE, PANEL, BROWSER = Source("gs232b", 1), Source("console"), Source("panel"), Source("page", 1)
AFTER_S = 8.0
PARKED = {AZ: 20.0, EL: 10.0}


@pytest.fixture
def mast(new_desk: Any) -> Any:
    desk = new_desk(at=(100.0, 30.0), park=tuple(PARKED.values()), park_after_s=AFTER_S)
    desk.step()
    return desk


def parks(desk: Any) -> bool:
    return any(desk.status.axis(axis).target_deg == PARKED[axis] for axis in Axis)


# --- the four cases


@pytest.mark.long
@pytest.mark.parametrize("order", [Aim(300.0, 30.0), Jog(AZ, PLUS), Jog(AZ, PLUS, 30.0)], ids=str)
def test_a_motion_that_takes_longer_than_the_idle_time_is_carried_out_first(mast: Any, order: Order) -> None:
    mast.step(order)
    turned_s = mast.now_s
    while not mast.at_rest():
        assert not parks(mast)
        turned_s = mast.now_s
        mast.step()
    assert mast.angle_deg[AZ] > 275.0
    while not parks(mast):
        mast.step()
    assert mast.now_s - turned_s >= AFTER_S
    mast.run(90.0)
    assert {axis: round(mast.angle_deg[axis]) for axis in Axis} == pytest.approx(PARKED, abs=4)


def test_a_timed_list_is_visited_to_its_last_point(mast: Any) -> None:
    mast.step(LoadTimed(AFTER_S * 2, ((110.0, 30.0), (130.0, 30.0), (200.0, 30.0))), RunTimed())
    seen_deg = []
    while not parks(mast):
        seen_deg.append(mast.angle_deg[AZ])
        mast.step()
    assert max(seen_deg) == pytest.approx(200.0, abs=4.0)


def test_a_nudge_that_moves_the_antenna_begins_the_idle_time_anew(mast: Any) -> None:
    mast.step(Aim(100.0, 30.0))
    mast.run(AFTER_S - 0.5)
    mast.step(Nudge(AZ, 10.0), by=PANEL)
    mast.run(AFTER_S - 0.5)
    assert not parks(mast)
    assert mast.angle_deg[AZ] == pytest.approx(110.0, abs=4.0)
    mast.run(5.0)
    assert parks(mast)


def test_a_nudge_without_a_target_moves_nothing_and_does_not_park_it(mast: Any) -> None:
    mast.step(Nudge(AZ, 10.0), by=PANEL)
    assert mast.run(AFTER_S * 3) == set()


@pytest.mark.parametrize(("sender", "lost"), [(LINK, "links"), (CONSOLE, "links"), (BROWSER, "page")], ids=str)
def test_what_was_halted_because_its_sender_was_lost_does_not_park(mast: Any, sender: Source, lost: str) -> None:
    mast.step(Aim(300.0, 30.0), by=sender)
    mast.run(3.0)
    mast.controller.links_lost() if lost == "links" else mast.controller.page_lost()
    mast.step()
    assert mast.run(AFTER_S * 3) == set()
    mast.step(Aim(150.0, 30.0), by=sender)
    mast.run(30.0)
    assert parks(mast), "an order begins the idle time again"


@pytest.mark.long
@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG], ids=str)
@pytest.mark.parametrize("person", [PANEL, CONSOLE, BROWSER], ids=str)
def test_in_a_mode_of_a_person_it_does_not_park_nor_when_that_ends(mast: Any, person: Source, mode: Mode) -> None:
    mast.step(SetMode(mode), by=person)
    mast.step(Jog(AZ, PLUS, 2.0), by=person)
    mast.run(4.0)
    assert mast.angle_deg[AZ] > 105.0
    assert mast.run(AFTER_S * 3) == set()
    mast.step(GiveBack(), by=person)
    assert mast.run(AFTER_S * 3) == set()


@pytest.mark.parametrize("missing", [(), (Missing.CALIBRATION,)], ids=str)
def test_beside_a_person_who_calibrates_an_axis_none_parks(new_desk: Any, missing: tuple[Missing, ...]) -> None:
    desk = new_desk(at=(100.0, 30.0), park=(20.0, 10.0), park_after_s=AFTER_S, attended=True, missing={AZ: missing})
    desk.step()
    desk.step(Jog(AZ, PLUS, 1.0), by=Source("calibrate"))
    assert desk.run(3.0) == {(AZ, PLUS)}
    assert desk.run(AFTER_S * 3) == set()


@pytest.mark.parametrize("release", [Release(), Stop((EL,)), Take(), SetMode(Mode.AUTO)], ids=str)
def test_after_a_release_or_a_stop_it_does_not_park(mast: Any, release: Order) -> None:
    mast.step(Aim(110.0, 30.0))
    mast.run(5.0)
    mast.step(release, by=CONSOLE)
    assert mast.run(AFTER_S * 3) == set()


def test_a_fault_that_was_not_acknowledged_keeps_the_other_axis_from_parking(mast: Any) -> None:
    mast.step(Aim(110.0, 30.0))
    mast.run(3.0)
    mast.instead[AZ] = None
    assert mast.run(AFTER_S * 3) == set()
    assert mast.status.azimuth.fault


def test_an_unreachable_order_does_not_begin_it(new_desk: Any) -> None:
    desk = new_desk(azimuth=(0.0, 350.0), at=(100.0, 30.0), park=(20.0, 10.0), park_after_s=AFTER_S)
    desk.step(Aim(110.0, 90.0))
    desk.run(1.0)
    desk.step(Stop((AZ,)))
    desk.step(Aim(355.0, 90.0))
    assert desk.controller.troubles
    desk.run(AFTER_S * 5)
    assert desk.at_rest()
    assert not parks(desk)


# --- a search


@dataclass
class Judge:
    """What a person beside the mast would allow, from the orders alone and from what the drives did."""

    may_park: bool = False
    """An order that moves the antenna came after the last stop, fault, loss or release."""
    ordered_park: bool = False
    """A person or a program has ordered to park."""
    ordered_s: float = -math.inf
    driven_s: float = -math.inf
    list_s: float = -math.inf
    """When the timed list visits its last point, if it runs on."""
    loaded: tuple[float, int] = (0.0, 0)

    def note(self, desk: Any, order: Order) -> None:
        match order:
            case Stop() | LetGo() | Release() | SetMode() | Take():
                self.may_park, self.list_s = False, -math.inf
                self.ordered_park = self.ordered_park and (desk.status.storm or isinstance(order, Release | Stop))
            case Park():
                self.ordered_park = True
            case LoadTimed(interval_s, points):
                self.loaded = interval_s, len(points)
                self._moves(desk, order)
            case Aim() | Jog() | Home() | RunTimed() | Nudge():
                self._moves(desk, order)

    def _moves(self, desk: Any, order: Order) -> None:
        self.may_park, self.list_s = True, -math.inf
        # A fault that stands ends the list at its first point.
        if desk.status.timed_point and isinstance(order, RunTimed) and not desk.status.faults:
            interval_s, count = self.loaded
            if desk.status.timed_point < count:  # at its last point it has ended, perhaps long before this order
                self.list_s = desk.now_s + (count - desk.status.timed_point - 1) * interval_s

    def lost(self, desk: Any, what: str) -> None:
        link = desk.status.controlled_by.partition("#")[0]
        if (what == "page") is (link == "page") and link != "panel":
            self.may_park, self.list_s = False, -math.inf

    def look(self, desk: Any, before: Any) -> None:
        """After each cycle. `before`: the status of the one before."""
        now = desk.status
        begins = [axis for axis in Axis if now.axis(axis).target_deg == PARKED[axis] != before.axis(axis).target_deg]
        for axis in Axis:
            fault = now.axis(axis).fault
            # The park itself may ask for a relay whose opposite was not seen to open: that fault comes after it.
            of_this_park = fault and fault.kind is FaultKind.RELAY_UNSEEN and axis in begins
            if fault and not before.axis(axis).fault and not of_this_park:
                self.may_park = False
        if begins and not self.ordered_park:
            assert self.may_park, "parks without a new order"
            assert before.mode is Mode.AUTO, "parks in a mode of a person"
            assert desk.now_s - self.driven_s >= AFTER_S - 0.06, "parks too soon after a motor ran"
            assert desk.now_s >= self.list_s + AFTER_S - 0.06, "parks before the list has ended"
            assert not any(before.axis(axis).homing for axis in Axis), "parks while an axis homes"
            self.may_park = False
        if not desk.at_rest():
            self.driven_s = desk.now_s


axes = st.sampled_from(Axis)
sources = st.sampled_from([LINK, LINK, CONSOLE, PANEL, BROWSER])
waits_s = st.sampled_from([0.0, 0.1, 1.0, 4.0, AFTER_S - 0.5, AFTER_S + 2.0, 25.0])
moves = st.one_of(
    st.builds(Aim, st.floats(60, 400), st.floats(20, 120)),
    st.builds(Aim, st.floats(60, 400), st.none()),
    st.builds(Jog, axes, st.sampled_from(Direction), st.none() | st.floats(0.5, 20)),
    st.builds(
        LoadTimed,
        st.sampled_from([2.0, AFTER_S + 3.0]),
        st.lists(st.tuples(st.floats(60, 400), st.floats(20, 120)), min_size=2, max_size=3).map(tuple),
    ),
    st.just(RunTimed()),
    st.builds(Nudge, axes, st.floats(-20, 20)),
)
ends = st.one_of(
    st.builds(Stop, st.sampled_from([tuple(Axis), (AZ,), (EL,)]), st.booleans()),
    st.sampled_from([Release(), LetGo(), Take(), GiveBack(), Leave(), *map(SetMode, Mode), Confirm(AZ, 100.0)]),
)
losses = st.sampled_from(["links", "page", "fault"])
scripts = st.lists(st.tuples(sources, moves | moves | ends | losses, waits_s), min_size=1, max_size=10)


def play(desk: Any, script: list[tuple[Source, Order | str, float]]) -> None:
    judge = Judge()
    for source, what, then_s in script:
        before = desk.status
        match what:
            case "fault":
                desk.instead[AZ] = None
                desk.step()
            case "links":
                judge.lost(desk, what)
                desk.controller.links_lost()
                desk.step()
            case "page":
                judge.lost(desk, what)
                desk.controller.page_lost()
                desk.step()
            case str():
                raise AssertionError(f"no such loss: {what}")
            case order:
                desk.step(order, by=source)
                judge.note(desk, order)
        judge.look(desk, before)
        for count in range(round(then_s / 0.05)):
            before = desk.status
            if count * 0.05 > 3.0:
                desk.instead.clear()
            desk.step()
            judge.look(desk, before)
        desk.instead.clear()
    # Whatever was before: a new order, and then nothing, lets it park.
    desk.step(Stop(), Release(), GiveBack(), SetMode(Mode.AUTO), by=CONSOLE)
    desk.step(Aim(200.0, 40.0), by=CONSOLE)
    for _ in range(round(60.0 + AFTER_S)):
        desk.run(1.0)
        if parks(desk):
            break
    if not desk.status.faults:
        assert parks(desk), "does not park"


@pytest.mark.long
@settings(max_examples=examples(60), deadline=None)
@given(script=scripts, counted=st.booleans())
@example(script=[(LINK, Aim(300.0, 30.0), 25.0)], counted=False)
@example(script=[(LINK, Aim(100.0, 30.0), 7.5), (PANEL, Nudge(AZ, 20.0), 4.0)], counted=False)
@example(script=[(LINK, Aim(300.0, 30.0), 4.0), (LINK, "links", 25.0)], counted=False)
@example(
    script=[(LINK, LoadTimed(AFTER_S + 3.0, ((110.0, 30.0), (200.0, 30.0))), 0.0), (LINK, RunTimed(), 25.0)],
    counted=False,
)
@example(script=[(LINK, Aim(60.0, 20.0), 0.0), (LINK, Jog(EL, MINUS, None), 25.0)], counted=True)
@example(
    script=[
        (LINK, LoadTimed(2.0, ((60.0, 20.0), (87.0, 20.0))), 7.5),
        (LINK, RunTimed(), 7.5),
        (LINK, Aim(87.0, 20.0), 7.5),
        (LINK, RunTimed(), 4.0),
    ],
    counted=False,
)
def test_it_parks_only_after_a_new_order_and_when_all_has_come_to_rest(
    new_desk: Any, script: list[tuple[Source, Order | str, float]], *, counted: bool
) -> None:
    desk = new_desk(counted=counted, at=(100.0, 30.0), park=tuple(PARKED.values()), park_after_s=AFTER_S)
    desk.step()
    play(desk, script)


def test_while_a_relay_waits_no_idle_time_runs(new_desk: Any) -> None:
    """Before a motor is reversed its contact has to be silent for some seconds: the order is still carried out."""
    desk = new_desk(counted=True, at=(100.0, 30.0), park=tuple(PARKED.values()), park_after_s=0.1)
    desk.step(Aim(300.0, 30.0), by=LINK)
    desk.run(4.0)
    desk.step(Aim(40.0, 30.0), by=LINK)
    waited = 0
    while abs(desk.status.azimuth.angle_deg - 40.0) > 6.0:
        waited += desk.status.azimuth.waiting
        assert desk.status.azimuth.target_deg == 40.0
        desk.step()
    assert waited * 0.05 > 1.0
