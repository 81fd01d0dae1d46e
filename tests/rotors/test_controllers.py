"""A box in front of each controller that it speaks to, in simulated time: goes there, stops, and says what is wrong."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from firmware_sim.rotors.controller import SimControllerRotor
from hw.ports import Axis, Direction
from rotator.config.kinds.controller import LANGUAGES
from rotator.exchange.orders import Aim, Jog, Stop
from tests.rotors.rig import AZ, EL, KINDS, PERSON, Box

CONTROLLER = next(kind for kind in KINDS if kind.profile == "controller")
TOLD_S = 2.0


def behind(protocol: str, **keys: Any) -> Box:
    """One for both axes, or one for each where it turns one."""
    table = {"protocol": protocol, **keys}
    if LANGUAGES[protocol].azimuth_only:  # type: ignore[index]
        table["elevation"] = {"protocol": protocol}
    box = Box(CONTROLLER, controller=table)
    box.run(2.0)
    return box


@pytest.fixture(params=LANGUAGES)
def box(request: pytest.FixtureRequest) -> Iterator[Box]:
    box = behind(request.param)
    yield box
    box.close()


@pytest.fixture
def gs232() -> Iterator[Box]:
    box = behind("gs232b")
    yield box
    box.close()


def world(box: Box) -> SimControllerRotor:
    assert isinstance(box.world, SimControllerRotor)
    return box.world


def test_it_goes_there_stops_at_once_and_follows_a_jog(box: Box) -> None:
    assert box.status.faults == ()
    assert box.arrives(200.0, 60.0)
    box.order(Aim(20.0, 10.0))
    box.run(3.0)
    box.order(Stop())
    box.run(0.1)
    stopped_deg = box.world.shafts()
    box.until_it_stands()
    for was_deg, is_deg in zip(stopped_deg, box.world.shafts(), strict=True):
        assert abs(is_deg - was_deg) <= CONTROLLER.run_on_deg
    box.order(Jog(AZ, Direction.PLUS, held=True), by=PERSON)
    began_deg = box.shaft_deg(AZ)
    box.run(6.0)
    assert box.shaft_deg(AZ) - began_deg > 25.0, "without a pause between its targets"
    box.order(Stop())
    box.until_it_stands()
    assert box.status.faults == ()


def test_one_controller_for_each_axis_and_each_in_its_own_protocol() -> None:
    keys = {"azimuth": {"protocol": "rotctld"}, "elevation": {"protocol": "easycomm2"}}
    box = Box(CONTROLLER, controller=keys)
    box.run(1.0)
    assert box.arrives(200.0, 60.0)
    assert [len(line.moves_s) for line in world(box).lines] == [1, 1]
    box.close()


def told_in_s(box: Box, axis: Axis, words: str) -> float:
    def said() -> bool:
        status = box.axis(axis)
        fault = [status.fault.name] if status.fault else []
        return any(text.startswith(words) for text in [*fault, *(notice.text for notice in status.notices)])

    return box.until(said, 5.0)


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("controller-deaf", "controller silent"),
        ("controller-unplugged", "controller silent"),
        ("controller-garbled", "controller not understood"),
        ("azimuth-jumps", "its readings jumped"),
        ("azimuth-knob-turned", "it is turned at its controller's own controls"),
    ],
)
def test_what_goes_wrong_at_rest_is_told_by_its_name_and_stops_nothing_for_good(
    gs232: Box, fault: str, words: str
) -> None:
    gs232.world.inject(fault)
    assert told_in_s(gs232, AZ, words) <= TOLD_S
    gs232.run(3.0)
    gs232.world.clear(fault)
    gs232.run(3.0)
    assert gs232.status.faults == ()
    assert world(gs232).lines[0].stops == 0, "followed, not fought"
    assert gs232.arrives(150.0, 45.0)


def test_going_on_after_a_stop_is_told_by_its_name(gs232: Box) -> None:
    gs232.order(Aim(250.0, 90.0))
    gs232.run(3.0)
    gs232.world.inject("controller-ignores-stop")
    gs232.order(Stop())
    for axis in (AZ, EL):
        began_s = gs232.clock()
        told_in_s(gs232, axis, "controller does not stop")
        assert gs232.clock() - began_s <= TOLD_S
    gs232.world.clear("controller-ignores-stop")
    gs232.run(2.0)
    gs232.order(Stop())
    assert gs232.arrives(150.0, 45.0), "its stop was said again until it was heard"


def test_a_stop_goes_to_the_controller_also_when_a_hand_turns_it(gs232: Box) -> None:
    gs232.world.inject("azimuth-knob-turned")
    gs232.run(2.0)
    gs232.order(Stop())
    gs232.run(0.1)
    assert world(gs232).lines[0].stops == 1


@pytest.mark.parametrize("every_s", [1.0, 3.0])
def test_a_motor_that_stands_is_told_in_time_however_seldom_its_controller_bears_a_target(every_s: float) -> None:
    box = behind("gs232b", target_every_s=every_s)
    box.order(Aim(250.0, 90.0))
    box.run(3.0)
    box.world.inject("azimuth-motor-stalled")
    assert told_in_s(box, AZ, "axis does not follow") <= TOLD_S + 0.2
    box.close()


@pytest.mark.parametrize("speed_dps", [1.5, 6.0])
def test_a_controller_that_bears_a_target_every_three_seconds_turns_back_and_on_without_a_fault(
    speed_dps: float,
) -> None:
    motor: dict[str, Any] = {"azimuth": {"speed_dps": speed_dps}}
    box = Box(CONTROLLER, controller={"protocol": "gs232b", "target_every_s": 3.0}, sim=motor, **motor)
    box.run(2.0)
    for target_deg in (250.0, 20.0, 30.0, 250.0, 60.0):
        box.order(Aim(target_deg, 30.0))
        box.run(4.3)
        assert box.status.faults == ()
    assert box.arrives(100.0, 30.0)
    box.run(5.0)
    # The elevation's target goes out at once, and the azimuth has to wait for three seconds.
    box.order(Aim(None, 60.0))
    box.run(0.3)
    box.order(Aim(200.0, 60.0))
    box.run(6.0)
    assert box.status.faults == ()
    assert box.boom_deg(AZ) > 101.0
    box.close()
