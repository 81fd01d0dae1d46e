"""A rotor of two moteus controllers as the control loop sees it: its faults in the program's words, and its errands.

The controllers are simulated, mjbots' own library is the codec, and time is simulated.
"""

from __future__ import annotations

import threading
import time

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.clock import SimClock
from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor
from hw.moteus.bus import MOTEUS_THREAD, MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.library import SerialPort
from hw.moteus.orders import MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import Axis, Direction
from rotator.control.axis.readings import Condition
from rotator.control.commands import HOLD, Acknowledge, Place, Steer
from rotator.control.sky.offsets import Offsets
from rotator.exchange.faults import FaultKind
from rotator.exchange.orders import LetGo
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


def test_a_rotor_in_order_has_nothing_to_say() -> None:
    bench = Bench()
    for axis in Axis:
        condition = bench.rotor.condition(axis)
        assert condition.fault is None
        assert condition.notice is None
        assert not condition.latched
        assert condition.ends == frozenset()


@pytest.mark.parametrize(("axis", "own_deg"), [(AZ, 80.0), (EL, 50.0)])
def test_it_goes_to_an_angle_less_its_own_offset(axis: Axis, own_deg: float) -> None:
    bench = Bench()
    bench.steer(axis, own_deg + SHIFT.deg(axis), 8.0)
    stands_deg = dict(zip(Axis, bench.world.antenna(), strict=True))
    assert stands_deg[axis] == pytest.approx(own_deg, abs=0.1)


def test_hold_ends_its_motion() -> None:
    bench = Bench()
    bench.steer(AZ, 200.0, 1.0)
    assert bench.rotor.obey(AZ, HOLD) is Direction.OFF
    bench.clock.sleep(4.0)
    stood_deg = bench.world.antenna()[0]
    assert 100.0 < stood_deg < 180.0
    bench.clock.sleep(2.0)
    assert bench.world.antenna()[0] == pytest.approx(stood_deg, abs=0.01)


@pytest.mark.parametrize("axis", list(Axis))
def test_a_controller_with_a_fault_is_latched_until_it_is_acknowledged(axis: Axis) -> None:
    bench = Bench()
    bench.world.inject(f"{axis.value}-over-temperature")
    bench.clock.sleep(0.5)
    assert bench.found(axis) == (FaultKind.CONTROLLER_FAULT, False)
    assert bench.rotor.condition(axis).latched
    other = EL if axis is AZ else AZ
    assert bench.found(other) is None
    assert not bench.rotor.condition(other).latched
    bench.world.clear(f"{axis.value}-over-temperature")
    bench.rotor.run(Acknowledge(other))
    bench.clock.sleep(1.0)
    assert bench.found(axis) == (FaultKind.CONTROLLER_FAULT, False), "another axis was acknowledged"
    bench.rotor.run(Acknowledge(axis))
    bench.clock.sleep(1.0)
    assert bench.found(axis) is None


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


def test_a_short_silence_passes_and_a_long_one_needs_a_person() -> None:
    bench = Bench()
    bench.world.inject("azimuth-silent")
    bench.clock.sleep(0.5)
    assert bench.found(AZ) == (FaultKind.CONTROLLER_SILENT, True)
    assert bench.found(EL) is None
    bench.clock.sleep(60.0)
    assert bench.found(AZ) == (FaultKind.CONTROLLER_SILENT, False)


def test_after_its_power_was_cut_its_position_is_unknown_until_a_person_says_it() -> None:
    bench = Bench()
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(1.0)
    assert bench.found(AZ) == (FaultKind.POSITION_UNKNOWN, True)
    bench.rotor.run(Place(AZ, 100.0 + SHIFT.azimuth_deg))
    bench.clock.sleep(1.0)
    assert bench.found(AZ) is None
    assert bench.rotor.sensors[AZ].read() == pytest.approx(100.0, abs=1.0), "less the offset"


def test_a_limit_in_the_controller_is_a_notice() -> None:
    bench = Bench((0.0, 0.0))
    bench.world.inject("azimuth-factory-bounds")
    bench.steer(AZ, 90.0, 3.0)
    notice = bench.rotor.condition(AZ).notice
    assert notice is not None
    assert notice.text
    assert notice.lcd
    assert bench.rotor.condition(EL).notice is None


def test_what_the_limit_switches_forbid_is_told() -> None:
    bench = Bench()
    bench.ends[EL] = {Direction.MINUS}
    assert bench.rotor.condition(EL).ends == {Direction.MINUS}
    assert bench.rotor.condition(AZ).ends == frozenset()


@pytest.mark.parametrize("end", ["off", "close"])
def test_off_holds_and_closing_does_too(end: str) -> None:
    bench = Bench()
    bench.steer(AZ, 200.0, 1.0)
    assert bench.drive.due_s() is not None, "a command that will expire"
    {"off": bench.rotor.off, "close": bench.rotor.close}[end]()
    assert bench.drive.due_s() is None
    bench.clock.sleep(4.0)
    stood_deg = bench.world.antenna()[0]
    bench.clock.sleep(2.0)
    assert bench.world.antenna()[0] == pytest.approx(stood_deg, abs=0.01)


def test_in_simulated_time_there_is_no_thread_to_start() -> None:
    before = threading.active_count()
    Bench().rotor.start()
    assert threading.active_count() == before


def test_in_real_time_it_starts_the_bus_and_ends_it() -> None:
    drive = MoteusDrive(MoteusSpec(1), MoteusSpec(2), time.monotonic)
    rotor = MoteusRotor(drive, MoteusBus(drive, SerialPort("/dev/no-such-adapter")), {}, SHIFT)
    alarms: list[object] = []
    rotor.begin(lambda due_s, _ring: alarms.append(due_s))
    assert alarms == [], "a thread needs no simulated clock"
    rotor.start()
    assert MOTEUS_THREAD in [thread.name for thread in threading.enumerate()]
    rotor.close()
    assert MOTEUS_THREAD not in [thread.name for thread in threading.enumerate()]


def test_only_let_go_takes_the_torque_away() -> None:
    bench = Bench()
    bench.steer(AZ, 110.0, 1.0)
    bench.rotor.run(LetGo())
    bench.clock.sleep(1.0)
    assert bench.drive.at_rest
    assert {bench.world.controller(axis.value).motor.mode.name for axis in Axis} == {"STOPPED"}
