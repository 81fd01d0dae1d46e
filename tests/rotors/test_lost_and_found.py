"""What only one kind of rotor goes through: a controller that has forgotten its turn, servos and boxes without their
supply."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from firmware_sim.rotors.digipot import SimDigipotRotor
from firmware_sim.rotors.servo import SimServoRotor
from hw.ports import Direction, HardwareError
from rotator.control.commands import Steer
from rotator.exchange.orders import Aim, Confirm, Jog, LetGo, Release, Stop
from tests.rotors.rig import AZ, EL, OF, PERSON, Box, Kind

NewBox = Callable[..., Box]
ISEL, SERVOS, ORBIT360 = OF["isel"], OF["servos"], OF["orbit360"]
PLUS = Direction.PLUS


# --- a controller that was switched off and on


def test_nothing_moves_a_controller_that_has_forgotten_its_turn_but_a_person_s_word(new_box: NewBox) -> None:
    box = new_box(ISEL)
    box.run(1.0)
    assert box.arrives(100.0, 40.0)
    box.world.inject("azimuth-power-cycled")
    box.run(0.2)
    stood_deg = box.shaft_deg(AZ)
    for order in (Aim(60.0, None), Jog(AZ, PLUS), Stop(), Aim(60.0, None)):
        box.order(order)
        box.run(1.0)
    assert box.shaft_deg(AZ) == pytest.approx(stood_deg, abs=0.01)
    box.order(Aim(None, 60.0))
    box.until_it_stands()
    assert box.boom_deg(EL) == pytest.approx(60.0, abs=0.05), "the other axis knows where it is"
    box.order(Confirm(AZ, 103.0), by=PERSON)
    box.run(0.5)
    assert box.axis(AZ).angle_deg == pytest.approx(100.0, abs=0.05), "a person's eye is corrected by the encoder"
    box.order(Stop())
    assert box.arrives(60.0, 30.0)


@pytest.mark.parametrize(
    ("kind", "fault", "name"),
    [
        pytest.param(OF["g5500"], "azimuth-pot-open", "pot open or shorted", id="pot"),
        pytest.param(ISEL, "azimuth-power-cycled", "position unknown", id="turn-forgotten"),
        pytest.param(ISEL, "azimuth-silent", "controller silent", id="controller"),
        pytest.param(SERVOS, "board-unpowered", "servo board", id="board"),
    ],
)
def test_acknowledged_while_its_cause_is_there_it_keeps_its_name(
    kind: Kind, fault: str, name: str, new_box: NewBox
) -> None:
    box = new_box(kind)
    box.run(1.0)
    assert box.arrives(100.0, 40.0)
    box.world.inject(fault)
    box.run(2.0)
    assert [fault.name for fault in box.status.faults if fault.axis is AZ] == [name]
    box.order(Stop())
    box.run(1.0)
    assert [fault.name for fault in box.status.faults if fault.axis is AZ] == [name]
    box.world.clear(fault)


# --- servos


def servo_world(box: Box) -> SimServoRotor:
    assert isinstance(box.world, SimServoRotor)
    return box.world


def test_let_go_they_are_limp_until_a_person_says_so(new_box: NewBox) -> None:
    box = new_box(SERVOS)
    box.run(1.0)
    assert box.arrives(120.0, 60.0)
    box.order(LetGo(), by=PERSON)
    box.run(0.5)
    box.world.inject("azimuth-wind-turns")
    box.run(2.0)
    assert box.shaft_deg(AZ) > 135.0
    box.order(Aim(60.0, 60.0))
    box.run(5.0)
    assert servo_world(box).board.pulse_us(0) is None
    box.world.clear("azimuth-wind-turns")
    box.order(Release(), by=PERSON)
    assert box.arrives(60.0, 60.0)


def test_idle_servos_go_limp_and_wake_without_a_leap(new_box: NewBox) -> None:
    box = new_box(SERVOS, servo={"idle_off_s": 5})
    box.run(1.0)
    assert box.arrives(120.0, 60.0)
    box.order(Stop())
    box.run(8.0)
    assert servo_world(box).board.pulse_us(0) is None
    assert box.arrives(100.0, 80.0)


@pytest.mark.parametrize("kind", [SERVOS, ORBIT360], ids=lambda kind: kind.profile)
def test_what_lies_outside_the_table_is_refused_and_nothing_moves(kind: Kind, new_box: NewBox) -> None:
    """The limits are within it, so that no order leads there: this is the fence behind the fence."""
    box = new_box(kind)
    box.run(1.0)
    assert box.arrives(100.0, 40.0)
    before_deg = box.world.shafts()
    with pytest.raises(HardwareError, match="outside its calibration table"):
        box.rotor.obey(AZ, Steer(400.0, 0.0, box.clock() + 0.4))
    box.left_alone(2.0)
    assert box.world.shafts() == pytest.approx(before_deg, abs=max(0.01, box.kind.trembles_deg))


# --- control boxes


def test_the_boxes_have_no_supply_before_the_first_order(new_box: NewBox) -> None:
    """Their chips begin in the middle: fed, they would turn there."""
    box = new_box(ORBIT360, (40.0, 10.0), digipot=knows((40.0, 10.0)))
    assert isinstance(box.world, SimDigipotRotor)
    box.run(30.0)
    assert not box.world.azimuth.motor.supply
    assert box.world.antenna() == (40.0, 10.0)
    assert box.arrives(80.0, 40.0)
    box.order(LetGo(), by=PERSON)
    box.run(0.5)
    assert not box.world.azimuth.motor.supply
    box.order(Release(), by=PERSON)
    assert box.arrives(40.0, 10.0)


def knows(start_deg: tuple[float, float]) -> dict[str, object]:
    azimuth_deg, elevation_deg = start_deg
    return {
        "azimuth": {"select": 8, "steps": [[0, 0], [360, 256]], "start_deg": azimuth_deg},
        "elevation": {"select": 7, "steps": [[0, 0], [90, 64]], "start_deg": elevation_deg},
    }


def test_a_chip_that_dipped_while_the_rotor_turned_the_other_way_costs_no_more(new_box: NewBox) -> None:
    box = new_box(ORBIT360)
    box.run(1.0)
    box.order(Aim(30.0, None))
    for _ in range(20):
        box.run(0.4)
        box.world.inject("azimuth-chip-dips")
    box.until_it_stands()
    box.run(30.0)
    assert box.boom_deg(AZ) == pytest.approx(30.0, abs=box.kind.within_deg)
