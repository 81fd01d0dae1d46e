"""Every fault of every simulator, by its name, in mid-move of the whole box: what is said, how soon, and the way back.

The way back is checked against the simulated shaft, not against what the box believes. What needs real time is in
`test_bad_luck_in_real_time`; a fault that is missing in `outcomes` fails here.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Confirm, Home, Jog, RelaysChecked, Stop
from tests.rotors.outcomes import FIRMWARE, OUTCOMES, REAL_TIME, Outcome, Remedy, plain
from tests.rotors.rig import AZ, EL, KINDS, PERSON, Box, Kind

NewBox = Callable[..., Box]
UNDER_WAY_DEG = 4.0
WAY_DEG = {AZ: 45.0, EL: 36.0}
WHOLE_WAY_S = 48.0
"""For a motor of 2.7°/s at 0.4 of its speed."""
ASTRAY_S = 15.0
"""In which one of 6°/s would have arrived, if it could."""
NOTICED_S = 5.0
ALIKE = set(FIRMWARE)
ONE_OF_THEM = ("azimuth-over-temperature", "elevation-timing")
MISREAD_DEG = 2.0
"""How wrong a person is who looks at the antenna and says where it points."""


def every_fault() -> list[tuple[Kind, str]]:
    """Of the many that the firmware of a controller reports, and that the box takes alike, one on each axis: the driver
    knows each of them by its number."""
    found = []
    for kind in KINDS:
        box = Box(kind)
        names = [name for name in sorted(box.world.faults) if name not in REAL_TIME.get(kind.profile, {})]
        found += [(kind, name) for name in names if plain(name) not in ALIKE or name in ONE_OF_THEM]
        box.close()
    return found


FAULTS = every_fault()
EVERY_FAULT = pytest.mark.parametrize(("kind", "name"), FAULTS, ids=[f"{kind.profile}-{name}" for kind, name in FAULTS])


def aim(axis: Axis, angle_deg: float) -> Aim:
    return Aim(angle_deg, None) if axis is AZ else Aim(None, angle_deg)


def first_deg(kind: Kind, axis: Axis) -> float:
    return kind.start_deg[list(Axis).index(axis)]


def outcome_of(kind: Kind, name: str) -> Outcome:
    outcomes = OUTCOMES[kind.profile]
    return outcomes[name] if name in outcomes else outcomes[plain(name)]


@EVERY_FAULT
def test_what_is_said_how_soon_and_the_way_back(
    kind: Kind, name: str, new_box: NewBox, caplog: pytest.LogCaptureFixture
) -> None:
    outcome = outcome_of(kind, name)
    axis = EL if name.startswith("elevation") else AZ
    box = new_box(kind)
    strikes_in_mid_move(box, axis, name, before=outcome.before)
    if outcome.fault:
        took_s = box.until(lambda: box.axis(axis).fault is not None, outcome.within_s + 1.0)
        fault = box.axis(axis).fault
        assert fault is not None
        assert fault.name in (outcome.fault, outcome.by_chance)
        assert took_s <= outcome.within_s
        assert_let_go(box, axis, turns_on=outcome.turns_on)
    else:
        assert_goes_on(box, axis, astray=outcome.astray)
    if outcome.notice:
        box.until(lambda: f"{axis.value}: {outcome.notice}" in caplog.text, NOTICED_S)
    box.world.clear(name)
    put_right(box, axis, outcome.remedy)
    box.order(aim(axis, first_deg(kind, axis) - 12.0))
    box.until_it_stands()
    assert box.status.faults == ()
    assert box.boom_deg(axis) == pytest.approx(first_deg(kind, axis) - 12.0, abs=kind.within_deg)
    box.until(lambda: abs((box.axis(axis).angle_deg or 0.0) - box.boom_deg(axis)) <= kind.within_deg, 15.0)


def strikes_in_mid_move(box: Box, axis: Axis, name: str, *, before: bool) -> None:
    box.run(1.0)
    from_deg = first_deg(box.kind, axis)
    if before:
        box.world.inject(name)
    box.order(aim(axis, from_deg + WAY_DEG[axis]))
    if before:
        return
    box.until(lambda: box.shaft_deg(axis) > from_deg + UNDER_WAY_DEG)
    box.world.inject(name)


def assert_let_go(box: Box, axis: Axis, *, turns_on: bool) -> None:
    """The drive is off at once; the shaft stands when it has run down, unless something else turns it."""
    box.run(2 * box.period_s)
    assert box.world.drives() == (0, 0)
    if turns_on:
        return
    box.run(2.0)
    stood_deg = box.shaft_deg(axis)
    box.run(0.5)
    assert box.shaft_deg(axis) == pytest.approx(stood_deg, abs=max(0.01, box.kind.trembles_deg))


def assert_goes_on(box: Box, axis: Axis, *, astray: bool) -> None:
    target_deg = first_deg(box.kind, axis) + WAY_DEG[axis]
    allowed_deg = box.kind.within_deg + box.config.axis(axis).tolerance_deg

    def arrived() -> bool:
        return abs(box.boom_deg(axis) - target_deg) <= allowed_deg

    if astray:
        box.run(ASTRAY_S)
        assert not arrived()
    else:
        box.until(arrived, WHOLE_WAY_S)
        box.run(2.0)
    assert box.status.faults == ()


def put_right(box: Box, axis: Axis, remedy: Remedy) -> None:
    box.run(0.5)
    match remedy:
        case Remedy.ACKNOWLEDGE:
            box.order(Stop())
            box.run(0.5)
        case Remedy.LATER:
            box.run(1.5)
            box.order(Stop())
            box.run(0.5)
        case Remedy.AGAIN:
            box.until_it_stands()
            box.run(3.0)
            box.order(Stop(), Jog(axis, Direction.PLUS, 1.0))
            box.run(6.0)
        case Remedy.CHECK:
            box.until_it_stands()
            box.order(RelaysChecked(axis), by=PERSON)
            box.order(Stop())
            box.run(0.5)
        case Remedy.HOME:
            box.until_it_stands()
            box.order(RelaysChecked(axis), by=PERSON)
            box.order(Stop(), Home(axis), by=PERSON)
            box.run(1.0)
            box.until(lambda: not box.axis(axis).homing)
            box.run(6.0)  # its contact has to be silent for so long before the other relay closes
            box.run(0.5)
        case Remedy.CONFIRM:
            box.order(Confirm(axis, box.boom_deg(axis) + MISREAD_DEG), by=PERSON)
            box.run(0.5)
        case Remedy.TELL:
            box.order(Stop(), Confirm(axis, box.boom_deg(axis)), by=PERSON)
            box.run(0.5)
    assert box.axis(axis).uncalibrated == ""
