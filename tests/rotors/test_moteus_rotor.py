"""A rotor of two moteus controllers as the control loop sees it: its faults in the program's words, and its errands.

The controllers are simulated, mjbots' own library is the codec, and time is simulated.
"""

from __future__ import annotations

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.clock import SimClock
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.moteus.drive import MoteusDrive
from hw.moteus.orders import MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.commands import Steer
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import FaultKind
from rotator.rotors import moteus as rotors_moteus
from rotator.rotors.moteus import MoteusRotor
from tests.interleaved import interleaved

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
SHIFT = Offsets(10.0, -3.0)
CYCLE_S = 0.05


class Bench:
    def __init__(self, start_deg: tuple[float, float] = (100.0, 30.0)) -> None:
        self.clock = SimClock(50.0)
        self.world = SimMoteusRotor(MoteusAxisSpec(1, start_deg[0]), MoteusAxisSpec(2, start_deg[1]), self.clock)
        self.drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2), self.clock)
        sensors = {axis: self.drive.sensor(axis) for axis in Axis}
        serve = MoteusInStep(self.drive, self.world.transport())
        self.rotor = MoteusRotor(self.drive, serve, sensors, SHIFT, lambda axis: frozenset(self.ends.get(axis, ())))
        self.ends: dict[Axis, set[Direction]] = {}
        self.rotor.begin(self.clock.add_alarm)
        self.clock.sleep(0.5)

    def steer(self, axis: Axis, angle_deg: float, seconds: float) -> None:
        for _ in range(round(seconds / CYCLE_S)):
            assert self.rotor.obey(axis, Steer(angle_deg, 0.0, self.clock() + 0.25)) is Direction.OFF, "no relay"
            self.clock.sleep(CYCLE_S)

    def found(self, axis: Axis) -> tuple[FaultKind, bool] | None:
        fault = self.rotor.condition(axis).fault
        return (fault.kind, fault.passing) if fault else None


def faulty() -> Bench:
    bench = Bench()
    bench.world.inject("azimuth-over-temperature")
    bench.clock.sleep(0.5)
    return bench


def test_a_fault_that_ends_while_it_is_read_is_latched_or_not_there() -> None:
    """The sensors' thread reads it while the control thread passes an acknowledgement on."""
    conditions: list[Condition] = []
    for _ in interleaved(
        rotors_moteus,
        faulty,
        lambda bench: conditions.append(bench.rotor.condition(AZ)),
        lambda bench: bench.drive.acknowledge(AZ),
    ):
        pass
    seen = {(each.fault is not None, each.latched) for each in conditions}
    assert seen == {(True, True), (False, False)}


def test_a_controller_that_never_answered_is_silent_until_it_does() -> None:
    clock = SimClock(50.0)
    drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2), clock)
    world = SimMoteusRotor(MoteusAxisSpec(1), MoteusAxisSpec(2), clock)
    rotor = MoteusRotor(drive, MoteusInStep(drive, world.transport()), {}, SHIFT)
    fault = rotor.condition(AZ).fault
    assert fault is not None
    assert (fault.kind, fault.axis, fault.passing) == (FaultKind.CONTROLLER_SILENT, AZ, True)
