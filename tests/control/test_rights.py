"""Who may do what in which state: every cell of the table, tried on a controller and judged by what the motors do.

A twin that is not given the order shows what goes on without it.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.control.commands import Place
from rotator.control.rights import TABLE, Deed, Effect, State
from rotator.exchange.faults import Missing
from rotator.exchange.motor import Trust
from rotator.exchange.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    Home,
    Jog,
    LetGo,
    LoadTimed,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    RunTimed,
    SetMode,
    Speed,
    Stop,
    Take,
)
from rotator.exchange.sources import Source
from tests.tables import every_row

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
LINK, OTHER = Source("gs232b", 1), Source("rotctld", 1)
CONSOLE, PERSON, PANEL = Source("console", 1), Source("console", 2), Source("panel")
REVERSED_S = 9.0
"""Before a motor is reversed its contact is silent for as long as it may be between two pulses of a slow motor."""
PARKED, FARTHER = (60.0, 20.0), (300.0, 90.0)
NUDGED_DEG = 7.0
HAVE_TARGETS = (State.TRACKING, State.TIMED, State.FAULT)
"""A nudge shifts what was ordered; where an idle antenna parks was not."""
AIMED, JOGGED = Aim(200.0, 30.0), Jog(EL, MINUS)


def tracking(desk: Any) -> None:
    desk.step(Aim(*FARTHER), by=OTHER)


def jogging(desk: Any) -> None:
    desk.step(Jog(AZ, PLUS), Jog(EL, PLUS), by=OTHER)


def timed(desk: Any) -> None:
    desk.step(LoadTimed(2.0, (FARTHER, (310.0, 95.0), (320.0, 100.0))), RunTimed(), by=OTHER)


def idle_park(desk: Any) -> None:
    desk.step(Aim(145.0, 30.0), by=OTHER)
    desk.run(15.6)
    assert desk.status.azimuth.target_deg == PARKED[0]


def homing(desk: Any) -> None:
    desk.step(Home(AZ), by=CONSOLE)


def silenced(desk: Any) -> None:
    for _ in range(6):
        desk.step(Aim(*FARTHER), by=LINK)
        desk.run(0.5)
    desk.step(Stop(), by=OTHER)
    desk.run(1.0)


def held(desk: Any) -> None:
    desk.step(Take(), by=Source("page", 1))
    desk.run(1.0)


def calibrating(desk: Any) -> None:
    """The azimuth is treated as never set up. The elevation stands, for no program may turn it."""
    desk.step(Aim(*FARTHER), by=OTHER)
    assert desk.run(1.0) == set()


def storm(desk: Any) -> None:
    desk.step(Park(storm=True), by=CONSOLE)


def stopped(desk: Any) -> None:
    desk.step(Aim(*FARTHER), by=OTHER)
    desk.step(Stop(latch=True), by=CONSOLE)


def switched(mode: Mode) -> Callable[[Any], None]:
    def switch(desk: Any) -> None:
        desk.step(Aim(*FARTHER), by=OTHER)
        desk.step(SetMode(mode), by=PANEL)

    return switch


def own_jog(desk: Any) -> None:
    desk.step(Aim(*FARTHER), by=OTHER)
    desk.step(SetMode(Mode.JOG), by=PERSON)


def fault(desk: Any) -> None:
    desk.step(Aim(*FARTHER), by=OTHER)
    desk.instead = {AZ: None}
    desk.run(0.5)
    desk.instead = {}
    desk.run(0.5)
    assert desk.status.azimuth.fault is not None
    assert desk.driven == {AZ: OFF, EL: PLUS}


SET_UP: dict[State, Callable[[Any], None]] = {
    State.TRACKING: tracking,
    State.JOGGING: jogging,
    State.TIMED: timed,
    State.IDLE_PARK: idle_park,
    State.HOMING: homing,
    State.SILENCED: silenced,
    State.HELD: held,
    State.CALIBRATING: calibrating,
    State.STORM: storm,
    State.STOPPED: stopped,
    State.AT_PARK: switched(Mode.PARK),
    State.AT_MANUAL: switched(Mode.MANUAL),
    State.AT_JOG: switched(Mode.JOG),
    State.OWN_JOG: own_jog,
    State.FAULT: fault,
}
ORDERS: dict[Deed, tuple[Source, Order]] = {
    Deed.AIM: (LINK, AIMED),
    Deed.JOG: (LINK, JOGGED),
    Deed.PARK: (LINK, Park()),
    Deed.S: (LINK, Stop()),
    Deed.STOP: (PERSON, Stop(latch=True)),
    Deed.RESUME: (PERSON, Release()),
    Deed.STORM: (PERSON, Park(storm=True)),
    Deed.HOME: (PERSON, Home(EL)),
    Deed.CONFIRM: (PERSON, Confirm(EL, 12.0)),
    Deed.MODE: (PANEL, SetMode(Mode.AUTO)),
    Deed.TAKE: (PERSON, Take()),
    Deed.LET_GO: (PERSON, LetGo()),
    Deed.NUDGE: (PANEL, Nudge(EL, NUDGED_DEG)),
    Deed.SPEED: (LINK, Speed(2)),
    Deed.CHECKED: (PERSON, RelaysChecked(AZ)),
    Deed.CLEAR: (LINK, ClearTimed()),
}


_MADE: dict[State, bytes] = {}


def in_state(new_desk: Any, state: State) -> Any:
    """A desk in this state: a copy of the first one."""
    if state not in _MADE:
        attended = state is State.CALIBRATING
        more: dict[str, Any] = {"missing": {AZ: (Missing.LIMITS,)} if attended else {}, "attended": attended}
        desk = new_desk(counted=True, at=(150.0, 35.0), park=PARKED, park_after_s=12.0, **more)
        desk.step()
        SET_UP[state](desk)
        desk.run(1.0)
        desk.controller.errands.clear()
        _MADE[state] = pickle.dumps(desk)
    return pickle.loads(_MADE[state])


def targets(desk: Any) -> tuple[float | None, float | None]:
    return desk.status.azimuth.target_deg, desk.status.elevation.target_deg


def goes_on(desk: Any, seconds: float) -> list[Any]:
    seen = []
    for _ in range(round(seconds / 0.05)):
        desk.step()
        seen.append((dict(desk.driven), targets(desk), desk.status.azimuth.homing, desk.status.elevation.homing))
    return seen


def shifted(seen: list[Any], by_deg: float) -> list[Any]:
    """The same with each target of the elevation so much higher."""
    return [
        (driven, (azimuth_deg, None if elevation_deg is None else elevation_deg + by_deg), *homes)
        for driven, (azimuth_deg, elevation_deg), *homes in seen
    ]


def did_its_own(desk: Any, deed: Deed, state: State) -> bool:
    """Whether the order itself took effect, beside what became of the rest."""
    status, errands = desk.status, desk.controller.errands
    stands = state in (State.FAULT, State.CALIBRATING)  # then the azimuth has no target
    goes_to = (None, targets(desk)[1]) if stands else targets(desk)
    match deed:
        case Deed.AIM:
            return goes_to == (None if stands else AIMED.azimuth_deg, AIMED.elevation_deg)
        case Deed.JOG:
            return status.elevation.target_deg is None and desk.driven[EL] is MINUS
        case Deed.PARK | Deed.STORM:
            return goes_to == (None if stands else PARKED[0], PARKED[1]) and bool(status.storm) == (deed is Deed.STORM)
        case Deed.S:
            return not status.faults
        case Deed.STOP:
            return str(status.latched) == str(PERSON)
        case Deed.RESUME:
            return status.latched == "" and not status.faults
        case Deed.HOME:
            return bool(status.elevation.homing)
        case Deed.CONFIRM:
            return Place(EL, 12.0) in errands
        case Deed.MODE:
            return status.mode is Mode.AUTO
        case Deed.TAKE:
            return str(status.held_by) == str(PERSON)
        case Deed.NUDGE:
            return True  # the target shows it: `shifted`
        case Deed.SPEED:
            return bool(status.speed_level == 2)
        case Deed.CHECKED:
            return bool(status.azimuth.trusts == (Trust.OPEN, Trust.OPEN))
        case Deed.CLEAR:
            return bool(status.timed_points == 0)
        case Deed.LET_GO:
            return LetGo() in errands and bool(status.latched)


@every_row("deed", Deed)
@every_row("state", State)
def test_each_cell(new_desk: Any, state: State, deed: Deed) -> None:
    effect = TABLE[state][deed]
    desk, twin = in_state(new_desk, state), in_state(new_desk, state)
    source, order = ORDERS[deed]
    if state is State.OWN_JOG:
        source = PERSON
    if state in (State.AT_PARK, State.AT_MANUAL, State.AT_JOG) and deed is Deed.MODE:
        assert desk.status.mode is not Mode.AUTO
    desk.step(order, by=source)
    twin.step()
    if deed in (Deed.JOG, Deed.HOME):
        desk.run(3.0)  # a motor rests before it is reversed
        twin.run(3.0)
        rest_s = desk.now_s + REVERSED_S
        while effect is not Effect.NONE and not did_its_own(desk, deed, state) and desk.now_s < rest_s:
            desk.step()
            twin.step()
    own = did_its_own(desk, deed, state)
    axes = (EL,) if deed is Deed.CONFIRM else tuple(Axis)
    match effect:
        case Effect.NONE:
            assert not own
            assert desk.status.latched == twin.status.latched
            assert goes_on(desk, 3.0) == goes_on(twin, 3.0)
            assert any(str(source) in notice for notice in desk.status.notices), "and it is said"
        case Effect.BESIDE:
            assert own
            by_deg = NUDGED_DEG if deed is Deed.NUDGE and state in HAVE_TARGETS else 0.0
            assert goes_on(desk, 3.0) == shifted(goes_on(twin, 3.0), by_deg)
        case Effect.STOPS:
            assert own
            desk.run(1.0)
            for _ in range(60):
                desk.step()
                assert all(desk.driven[axis] is OFF and targets(desk)[axis is EL] is None for axis in axes)
                assert not any(desk.status.axis(axis).homing for axis in axes)
        case Effect.ACTS:
            assert own
            desk.run(1.0)
            assert did_its_own(desk, deed, state), "and it stays so"


@every_row("state", State)
def test_a_nudge_is_kept_for_the_orders_to_come(new_desk: Any, state: State) -> None:
    """In every state; only the mode switch forgets it."""
    desk = in_state(new_desk, state)
    desk.step(Nudge(EL, NUDGED_DEG), Stop(latch=True), Release(), by=PANEL)
    desk.step(SetMode(Mode.AUTO), Nudge(EL, NUDGED_DEG), by=PANEL) if desk.status.mode is not Mode.AUTO else None
    desk.step(Aim(70.0, 40.0), by=CONSOLE)
    assert targets(desk)[1] == 40.0 + NUDGED_DEG


def test_every_state_and_order_has_its_cell() -> None:
    assert set(TABLE) == set(State) == set(SET_UP)
    assert set(ORDERS) == set(Deed)
    assert all(set(row) == set(Deed) for row in TABLE.values())


# --- a calibration over a link: after it every angle means another place


HOLDING = [
    *(State.SILENCED, State.HELD, State.CALIBRATING, State.STORM),
    *(State.STOPPED, State.AT_PARK, State.AT_MANUAL, State.AT_JOG),
]


@every_row("state", HOLDING)
def test_what_holds_the_antenna_back_from_a_link_holds_its_calibration_too(new_desk: Any, state: State) -> None:
    desk = new_desk(at=(5.0, 35.0), park=PARKED, attended=state is State.CALIBRATING)
    desk.step()
    SET_UP[state](desk)
    desk.step(Stop(), by=OTHER)
    desk.run(3.0)
    before = desk.status.azimuth.calibration
    desk.step(Calibrate(AZ, high_end=False), by=LINK)
    assert desk.status.azimuth.calibration == before
    assert any(str(LINK) in notice for notice in desk.status.notices), "and it is said"


def test_after_resume_the_link_calibrates_again(new_desk: Any) -> None:
    desk = new_desk(at=(5.0, 35.0))
    desk.step(Stop(latch=True), by=CONSOLE)
    desk.step(Calibrate(AZ, high_end=False), by=LINK)
    assert desk.status.azimuth.angle_deg == pytest.approx(5.0)
    desk.step(Release(), by=CONSOLE)
    desk.step(Calibrate(AZ, high_end=False), by=LINK)
    desk.step()
    assert desk.status.azimuth.angle_deg == pytest.approx(0.0)


# --- what the display says is true


@pytest.mark.parametrize("order", [Stop(), Stop((AZ,)), Stop((EL,)), SetMode(Mode.PARK)], ids=str)
def test_a_storm_park_that_was_stopped_is_not_said_to_go_on(new_desk: Any, order: Stop | SetMode) -> None:
    desk = in_state(new_desk, State.STORM)
    desk.step(order, by=PANEL)
    assert desk.status.latched == "panel, in a storm park"
    assert not desk.status.storm
    desk.run(1.0)
    stood = dict(desk.angle_deg)
    desk.step(Aim(*FARTHER), by=LINK)
    desk.run(5.0)
    for axis in Axis:
        assert desk.angle_deg[axis] == pytest.approx(stood[axis], abs=0.05), "a person has to release it"


def test_a_second_park_does_not_open_another_s_stop(new_desk: Any) -> None:
    desk = in_state(new_desk, State.STOPPED)
    for person in (PERSON, CONSOLE, Source("terminal")):
        desk.step(Park(storm=True), by=person)
        assert desk.run(2.0) == set()
    assert desk.status.latched == "console#1"
    desk.step(Release(), by=CONSOLE)
    desk.step(Park(storm=True), by=PERSON)
    assert desk.run(REVERSED_S)


def test_at_park_the_switch_obeys_no_console(new_desk: Any) -> None:
    desk = in_state(new_desk, State.AT_PARK)
    desk.step(Park(storm=True), Home(AZ), Confirm(AZ, 3.0), by=PERSON)
    assert desk.run(5.0) == set()
    assert desk.status.latched == ""


@pytest.mark.parametrize("mode", [Mode.MANUAL, Mode.JOG])
def test_the_person_at_the_panel_moves_it_in_manual_and_jog(new_desk: Any, mode: Mode) -> None:
    desk = in_state(new_desk, State.AT_MANUAL if mode is Mode.MANUAL else State.AT_JOG)
    desk.step(JOGGED, by=PANEL)
    desk.run(REVERSED_S)
    assert desk.driven[EL] is MINUS
