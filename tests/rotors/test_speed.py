"""A box whose azimuth has a speed input, from the order to the motor, in simulated time.

The motor begins and ends slowly, X1 to X4 are its highest speed, and an output that fails stops it by its own name.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from hw.ports import AngleSource, Direction
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import Aim, Jog, Speed, Stop
from tests.rotors.rig import AZ, PERSON, Box, Kind

G5500 = Kind("g5500", AngleSource.MEASURED, (90.0, 30.0), 1.0, 1.3)
FULL_DPS, LOWEST_DPS = 6.0, 2.0
OUTPUTS: dict[str, dict[str, Any]] = {"mcp4725": {"output": "mcp4725"}, "pwm": {"output": "pwm", "pwm": 18}}


def paced(output: str = "mcp4725", **more: Any) -> Box:
    speed = OUTPUTS[output] | {"lowest_dps": LOWEST_DPS, "slow_start_s": 1.0, "slow_down_s": 2.0}
    box = Box(G5500, azimuth={"speed": speed, "speed_dps": FULL_DPS} | more)
    box.run(3.0)
    return box


@pytest.fixture
def box() -> Iterator[Box]:
    box = paced()
    yield box
    box.close()


def throttle(box: Box) -> float:
    """What the simulated motor's speed input lets it turn at, as a share of full speed."""
    assert isinstance(box.world, SimRelayPotRotor)
    return box.world.azimuth.motor.throttle


def speeds_dps(box: Box, seconds: float) -> list[float]:
    """Of the shaft, over each 0.2 s, as long as the relay is closed."""
    found = []
    for _ in range(round(seconds / 0.2)):
        before_deg = box.shaft_deg(AZ)
        box.run(0.2)
        if box.world.drives()[0]:
            found.append(abs(box.shaft_deg(AZ) - before_deg) / 0.2)
    return found


@pytest.mark.parametrize("output", OUTPUTS)
def test_it_starts_slowly_and_slows_down_before_its_target(output: str) -> None:
    box = paced(output)
    box.order(Aim(150.0, 30.0))
    found = speeds_dps(box, 20.0)
    assert max(found[:2]) < LOWEST_DPS + 0.7
    assert max(found) == pytest.approx(FULL_DPS, abs=0.3)
    assert found[-1] == pytest.approx(LOWEST_DPS, abs=0.4)
    assert abs(box.boom_deg(AZ) - 150.0) <= 0.6
    assert box.axis(AZ).fault is None
    box.close()


def test_it_slows_down_before_a_limit_and_ends_there(box: Box) -> None:
    box.order(Jog(AZ, Direction.MINUS, None), by=PERSON)
    found = speeds_dps(box, 25.0)
    assert found[-1] == pytest.approx(LOWEST_DPS, abs=0.4)
    assert abs(box.boom_deg(AZ)) <= 0.7
    assert box.axis(AZ).fault is None


def test_after_a_stop_its_input_is_at_the_lowest_again(box: Box) -> None:
    box.order(Aim(300.0, 30.0))
    box.run(5.0)
    box.order(Stop(), by=PERSON)
    box.run(0.2)
    assert box.world.drives()[0] == 0
    assert throttle(box) == pytest.approx(LOWEST_DPS / FULL_DPS)


def test_a_program_that_hangs_leaves_it_at_the_lowest_as_soon_as_it_is_back(box: Box) -> None:
    box.order(Aim(300.0, 30.0))
    box.run(5.0)
    box.left_alone(2.0)
    assert box.world.drives()[0] == 0
    box.run(0.1)
    box.close()
    assert throttle(box) == pytest.approx(LOWEST_DPS / FULL_DPS)


def test_a_motor_that_stands_is_seen_at_the_lowest_speed_too(box: Box) -> None:
    box.world.inject("azimuth-motor-stalled")
    box.order(Speed(1), Aim(300.0, 30.0))
    box.until(lambda: box.axis(AZ).fault is not None, 10.0)
    fault = box.axis(AZ).fault
    assert fault is not None
    assert fault.kind is FaultKind.STANDS_STILL


def test_a_welded_relay_is_seen_though_the_motor_then_turns_slowly(box: Box) -> None:
    box.order(Aim(300.0, 30.0))
    box.run(6.0)
    box.world.inject("azimuth-relay-welded-cw")
    box.order(Stop(), by=PERSON)
    box.until(lambda: box.axis(AZ).fault is not None, 6.0)
    fault = box.axis(AZ).fault
    assert fault is not None
    assert fault.kind in (FaultKind.RELAY_WELDED, FaultKind.TURNS_BY_ITSELF)


@pytest.mark.parametrize("true_dps", [4.5, 7.5])
def test_it_learns_the_full_speed(true_dps: float) -> None:
    box = paced()
    box.close()
    speed = OUTPUTS["mcp4725"] | {"lowest_dps": LOWEST_DPS}
    sim = {"azimuth": {"speed_dps": true_dps}}
    box = Box(G5500, azimuth={"speed": speed, "speed_dps": FULL_DPS}, sim=sim)
    box.run(3.0)
    for target_deg in (200.0, 60.0, 220.0, 100.0, 240.0, 120.0):
        assert box.arrives(target_deg, 30.0), target_deg
    learnt = box.axis(AZ).learnt
    assert learnt is not None
    assert [motor.speed_dps for motor in learnt] == pytest.approx([true_dps, true_dps], rel=0.1)
    assert box.axis(AZ).fault is None
    box.close()
