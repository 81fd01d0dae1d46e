"""Counting the closures of a U-100's cam: the real relay bank, contact driver and counter on a simulated rotor.

Each fault is injected into the rotor by name, never into the driver.
"""

from __future__ import annotations

import dataclasses
import random
import statistics

import pytest

from firmware_sim.parts.motor import MotorSpec
from firmware_sim.rotors.relay_pulse import U100_MOTOR
from hw.buses.gpio import GpioContact
from hw.ports import Axis, Direction, HardwareError
from hw.sensors.pulses import PulseCounter
from tests.hw.sensors.pulse_rig import AZ, CAM, PATH, STANDS_S, PulseRig
from tests.search import examples

PLUS, MINUS = Direction.PLUS, Direction.MINUS
MOVES = examples(2500)


# --- angles


def test_read_late_the_kernel_has_kept_every_moment() -> None:
    rig = PulseRig(100.0)
    until_s = rig.clock() + 60.0
    while rig.clock() < until_s:  # the motor is driven, and nothing reads
        rig.bank.drive(AZ, PLUS if rig.clock() < until_s - 30.0 else MINUS, until_s)
        rig.clock.sleep(0.1)
    rig.clock.sleep(STANDS_S)
    assert rig.counter.read() == pytest.approx(rig.shaft_deg, abs=0.5)
    assert (rig.off_by, rig.counter.trouble) == (0, "")


def test_a_change_counts_from_when_it_happened_not_from_when_it_was_reported() -> None:
    rig = PulseRig(100.0, bounce_s=0.0)
    rig.drive(PLUS, 5.0)
    errors_deg = []
    for _ in range(200):  # the debounce of 20 ms is 0.12° at this speed
        rig.drive(PLUS, 0.01, cycle_s=0.01)
        errors_deg.append(abs(rig.counter.read() - rig.shaft_deg))
    assert statistics.median(errors_deg) < 0.02
    assert max(errors_deg) < 0.13  # until the change is reported, the edge holds the angle back


def test_a_lease_that_runs_out_between_two_readings_is_heard() -> None:
    rig = PulseRig(102.0)
    rig.bank.drive(AZ, PLUS, rig.clock() + 0.3)
    rig.clock.sleep(5.0)
    assert rig.counter.read() == pytest.approx(rig.shaft_deg, abs=0.2)
    assert rig.shaft_deg == pytest.approx(103.8, abs=0.1)
    assert rig.counter.at_rest


def test_it_knows_whether_its_contact_is_closed_and_that_the_next_change_is_ahead() -> None:
    rig = PulseRig(100.8)
    seen: list[bool] = []
    for _ in range(20):
        seen.append(rig.counter.in_closure)
        assert rig.counter.in_closure is rig.counter.closed
        assert rig.counter.ahead == {PLUS, MINUS}
        rig.move(PLUS, 0.25)
    assert seen[0]
    assert 2 < sum(seen) < 8, "a fifth of the cam is closed"


# --- placing


def test_a_debounce_that_would_swallow_closures_is_refused() -> None:
    rig = PulseRig()
    narrow = dataclasses.replace(CAM, closed_deg=0.15)
    with pytest.raises(HardwareError, match="a debounce of 20 ms swallows closures that last 25 ms"):
        PulseCounter(Axis.ELEVATION, contact(rig, 26), rig.tapped, narrow, rig.clock)


# --- the promise


@pytest.mark.parametrize(
    ("seed", "motor", "pace", "play_deg"),
    [
        (1, U100_MOTOR, 1.0, 0.0),
        (2, dataclasses.replace(U100_MOTOR, lag_s=0.14), 0.85, 0.3),
        (3, dataclasses.replace(U100_MOTOR, lag_s=0.05), 1.2, 0.2),
        (4, dataclasses.replace(U100_MOTOR, relay_delay_s=0.005), 1.1, 0.0),
    ],
    ids=["as configured", "slower, coasts longer", "faster, coasts less", "solid-state relays"],
)
@pytest.mark.search
def test_thousands_of_moves_with_coast_bounce_and_reversals(
    seed: int, motor: MotorSpec, pace: float, play_deg: float
) -> None:
    """On each of four rotors that are not quite what the configuration says of them."""
    rig = PulseRig(motor=motor, pace=pace, cam=dataclasses.replace(CAM, play_deg=play_deg), seed=seed)
    chance = random.Random(seed)
    compared = 0
    for _ in range(MOVES):
        direction = chance.choice([PLUS, MINUS])
        if not 40.0 < rig.shaft_deg < 320.0:
            direction = PLUS if rig.shaft_deg < 180.0 else MINUS
        rig.run(direction, chance.choice([chance.uniform(0.02, 0.4), chance.uniform(0.1, 3.0)]), cycle_s=0.2)
        if chance.random() < 0.5:  # else the next order comes while it still coasts
            reading_deg = rig.wait(STANDS_S, cycle_s=0.4)
            assert (rig.off_by, rig.counter.trouble) == (0, "")
            assert reading_deg == pytest.approx(rig.shaft_deg, abs=1.5)
            compared += 1
    assert compared > 0.4 * MOVES


def contact(rig: PulseRig, pin: int) -> GpioContact:
    return GpioContact(rig.rotor.gpio, PATH, pin, consumer="test")
