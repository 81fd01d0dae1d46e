"""Two moteus controllers in simulated time: the drive, and mjbots' own library as the codec, on simulated controllers.

The rotor is the ISEL build: azimuth one revolution a turn, elevation upside down, 0° at -0.25 and 90° at -0.5.
"""

from __future__ import annotations

import contextlib
import math
from itertools import pairwise

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.clock import SimClock
from firmware_sim.moteus.motor import Mode, MoteusSettings
from firmware_sim.rotors.moteus import FAULT_CODES, MoteusAxisSpec, SimMoteusRotor
from hw.drives.relays import LONGEST_LEASE_S
from hw.moteus.axis import ERRAND_S, STALE_S
from hw.moteus.drive import MoteusDrive
from hw.moteus.faults import FAULTS
from hw.moteus.orders import WATCHDOG_S, MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import AngleSource, Axis, HardwareError

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
AZIMUTH = MoteusSpec(can_id=1)
ELEVATION = MoteusSpec(can_id=2, rev_per_turn=-1.0, zero_rev=-0.25)
CYCLE_S = 0.05
"""The control loop's."""


class Bench:
    def __init__(
        self,
        start_deg: tuple[float, float] = (0.0, 0.0),
        *,
        geared: bool = True,
        rotor_turns: float = 50,
        output_encoder: bool = False,
        range_deg: tuple[float, float] = (0.0, 450.0),
    ):
        self.clock = SimClock(100.0)
        settings = MoteusSettings(rotor_turns=rotor_turns, timeout_mode=Mode.POSITION, output_encoder=output_encoder)
        self.world = SimMoteusRotor(
            MoteusAxisSpec(1, start_deg[0], settings=settings),
            MoteusAxisSpec(
                2, start_deg[1], rev_per_turn=-1.0, zero_rev=-0.25, settings=MoteusSettings(rotor_turns=rotor_turns)
            ),
            self.clock,
        )
        self.specs = MoteusSpec(can_id=1, geared=geared, min_deg=range_deg[0], max_deg=range_deg[1]), ELEVATION
        self.start_program()

    def start_program(self) -> None:
        self.drive = MoteusDrive(*self.specs, self.clock)
        self.alive = True
        wire = MoteusInStep(self.drive, self.world.transport())
        drive = self.drive
        self.clock.add_alarm(lambda: wire.due_s() if self.drive is drive and self.alive else None, wire.serve)
        self.clock.sleep(0.1)

    def follow(self, axis: Axis, angle_deg: float, seconds: float, rate_dps: float = 0.0) -> None:
        """Aim as the control loop does: at an angle that moves on, renewed every cycle."""
        for at in range(round(seconds / CYCLE_S)):
            self.drive.aim(axis, angle_deg + rate_dps * at * CYCLE_S, rate_dps, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def follow_if_it_may(self, axis: Axis, angle_deg: float, seconds: float) -> None:
        """Aim all that time, refused or not."""
        for _ in range(round(seconds / CYCLE_S)):
            with contextlib.suppress(HardwareError):
                self.drive.aim(axis, angle_deg, 0.0, self.clock() + 0.25)
            self.clock.sleep(CYCLE_S)

    def antenna(self, axis: Axis) -> float:
        return self.world.antenna()[list(Axis).index(axis)]

    def mode(self, axis: Axis) -> Mode:
        motor = self.world.controller(axis.value).motor
        motor.advance()
        return motor.mode


# --- angles


@pytest.mark.parametrize(
    ("spec", "angle_deg", "position_rev"),
    [
        (AZIMUTH, 0.0, 0.0),
        (AZIMUTH, 123.456, 123.456 / 360),  # the original rounded to 0.36°
        (AZIMUTH, 450.0, 1.25),
        (ELEVATION, 0.0, -0.25),
        (ELEVATION, 90.0, -0.5),
        (ELEVATION, 180.0, -0.75),
        (MoteusSpec(1, rev_per_turn=80.0, zero_rev=3.0), 90.0, 23.0),
    ],
)
def test_degrees_are_revolutions(spec: MoteusSpec, angle_deg: float, position_rev: float) -> None:
    assert spec.revolutions(angle_deg) == pytest.approx(position_rev, abs=1e-12)
    assert spec.degrees(position_rev) == pytest.approx(angle_deg, abs=1e-9)


@pytest.mark.parametrize("axis", list(Axis))
def test_it_goes_there_and_tells_so(axis: Axis) -> None:
    bench = Bench(start_deg=(200.0, 10.0))
    assert bench.drive.sensor(axis).read() == pytest.approx([200.0, 10.0][list(Axis).index(axis)], abs=1e-4)
    bench.follow(axis, 47.3, 10.0)
    assert bench.antenna(axis) == pytest.approx(47.3, abs=1e-3)
    assert bench.drive.sensor(axis).read() == pytest.approx(47.3, abs=1e-3)
    assert bench.drive.sensor(axis).source is AngleSource.MEASURED


# --- motion


@pytest.mark.parametrize("axis", list(Axis))
def test_a_ramp_of_3_dps_is_followed_within_a_twentieth_of_a_degree(axis: Axis) -> None:
    bench = Bench()
    bench.follow(axis, 10.0, 3.0)
    start_s, worst_deg = bench.clock(), 0.0
    for at in range(400):
        aim_deg = 10.0 + 3.0 * (bench.clock() - start_s)
        bench.drive.aim(axis, aim_deg, 3.0, bench.clock() + 0.25)
        bench.clock.sleep(CYCLE_S)
        if at > 40:
            worst_deg = max(worst_deg, abs(bench.antenna(axis) - (10.0 + 3.0 * (bench.clock() - start_s))))
    print(f"{axis.value}: worst error on a 3°/s ramp {worst_deg:.5f}°")  # noqa: T201 - pytest -rP shows it
    assert worst_deg < 0.05


def test_a_step_keeps_to_30_dps_and_20_dps2() -> None:
    bench = Bench()
    angles_deg = []
    for _ in range(120):
        bench.follow(AZ, 90.0, CYCLE_S)
        angles_deg.append(bench.antenna(AZ))
    speeds_dps = [(b - a) / CYCLE_S for a, b in pairwise(angles_deg)]
    gains_dps2 = [(b - a) / CYCLE_S for a, b in pairwise(speeds_dps)]
    assert max(speeds_dps) == pytest.approx(30.0, abs=0.1)
    assert max(abs(gain) for gain in gains_dps2) < 21.0
    assert max(angles_deg) < 90.02
    assert angles_deg[-1] == pytest.approx(90.0, abs=1e-3)


def test_an_aim_without_renewal_ends_in_a_hold() -> None:
    bench = Bench()
    bench.follow(AZ, 0.0, 5.0, rate_dps=10.0)
    at_deg = bench.antenna(AZ)
    bench.clock.sleep(5.0)
    coasted_deg = bench.antenna(AZ) - at_deg
    assert 0.2 * 10 < coasted_deg < 0.3 * 10 + 10**2 / (2 * 20)  # the rest of its lease, then 20°/s²
    assert (bench.mode(AZ), bench.drive.faults()) == (Mode.POSITION, {}), "held under torque, its watchdog fed"
    assert bench.drive.due_s() is None


def test_no_lease_is_longer_than_the_longest() -> None:
    bench = Bench()
    bench.drive.aim(AZ, 10.0, 0.0, math.inf)
    assert bench.drive.due_s() == bench.clock() + LONGEST_LEASE_S


@pytest.mark.parametrize("how", ["hold", "off", "aim that has ended"])
def test_a_stop_decelerates_and_holds(how: str) -> None:
    bench = Bench()
    bench.follow(AZ, 300.0, 3.0)
    at_deg = bench.antenna(AZ)
    match how:
        case "hold":
            bench.drive.hold(AZ)
        case "off":
            bench.drive.off()
        case _:
            bench.drive.aim(AZ, 300.0, 0.0, bench.clock())
    bench.clock.sleep(10.0)
    assert bench.antenna(AZ) - at_deg == pytest.approx(30**2 / (2 * 20), abs=0.7)
    assert bench.mode(AZ) is Mode.POSITION


def test_nothing_gets_torque_before_it_is_aimed() -> None:
    bench = Bench()
    bench.drive.hold(AZ)
    bench.drive.off()
    bench.follow(EL, 5.0, 2.0)
    assert (bench.mode(AZ), bench.mode(EL)) == (Mode.STOPPED, Mode.POSITION)


def test_release_lets_go_until_the_next_aim() -> None:
    bench = Bench()
    bench.follow(AZ, 5.0, 2.0)
    bench.follow(EL, 5.0, 2.0)
    bench.drive.release()
    bench.clock.sleep(0.1)
    bench.drive.off()
    bench.clock.sleep(1.0)
    assert (bench.mode(AZ), bench.mode(EL)) == (Mode.STOPPED, Mode.STOPPED)
    bench.follow(AZ, 7.0, 2.0)
    assert bench.antenna(AZ) == pytest.approx(7.0, abs=1e-3)
    assert bench.mode(EL) is Mode.STOPPED


@pytest.mark.parametrize(("angle_deg", "rate_dps"), [(math.nan, 0.0), (math.inf, 0.0), (10.0, math.nan)])
def test_nowhere_is_not_taken_for_a_speed(angle_deg: float, rate_dps: float) -> None:
    bench = Bench()
    with pytest.raises(HardwareError, match="nowhere to aim at"):
        bench.drive.aim(AZ, angle_deg, rate_dps, bench.clock() + 0.2)


# --- faults


@pytest.mark.parametrize("name", sorted(FAULT_CODES))
@pytest.mark.parametrize("axis", list(Axis))
def test_each_fault_stops_its_axis_and_says_what_to_do(axis: Axis, name: str) -> None:
    bench = Bench()
    other = EL if axis is AZ else AZ
    bench.follow(axis, 60.0, 1.0)
    bench.world.inject(f"{axis.value}-{name}")
    at_deg = bench.antenna(axis)
    bench.clock.sleep(0.2)
    told = bench.drive.faults()
    fault = FAULTS[FAULT_CODES[name]]
    assert list(told) == [axis]
    assert told[axis].startswith("moteus ")
    assert fault.name in told[axis]
    assert fault.remedy in told[axis]
    with pytest.raises(HardwareError, match=r"then acknowledge it"):
        bench.follow(axis, 60.0, 0.2)
    bench.follow(other, 20.0, 3.0)
    assert bench.antenna(axis) == at_deg
    assert bench.antenna(other) == pytest.approx(20.0, abs=1e-3)


def test_after_an_acknowledgement_it_obeys_again() -> None:
    bench = Bench()
    bench.follow(AZ, 60.0, 1.0)
    bench.world.inject("azimuth-over-temperature")
    bench.clock.sleep(0.2)
    bench.drive.acknowledge(AZ)
    bench.clock.sleep(0.2)
    assert bench.drive.faults() == {}
    bench.follow(AZ, 60.0, 5.0)
    assert bench.antenna(AZ) == pytest.approx(60.0, abs=1e-3)


def test_a_fault_that_is_still_there_comes_back() -> None:
    bench = Bench(start_deg=(90.0, 0.0))
    bench.world.inject("azimuth-factory-bounds")
    bench.drive.aim(AZ, 95.0, 0.0, bench.clock() + 0.25)
    for _ in range(2):
        bench.clock.sleep(0.2)
        assert "started outside its position bounds (39)" in bench.drive.faults()[AZ]
        bench.drive.acknowledge(AZ)
        assert bench.drive.faults() == {}


def test_a_controller_held_back_by_its_bounds_says_so_and_is_not_at_fault() -> None:
    bench = Bench()
    bench.world.inject("azimuth-factory-bounds")
    bench.follow(AZ, 20.0, 3.0)
    assert bench.antenna(AZ) == pytest.approx(3.6, abs=1e-3)
    assert "position bounds" in bench.drive.limits()[AZ].name
    assert bench.drive.faults() == {}


def test_silence_is_an_error_and_the_other_axis_goes_on() -> None:
    bench = Bench()
    bench.follow(AZ, 60.0, 1.0)
    bench.world.inject("azimuth-silent")
    bench.clock.sleep(STALE_S + 0.1)
    with pytest.raises(HardwareError, match=r"^moteus 1 does not answer: check its supply"):
        bench.drive.sensor(AZ).read()
    with pytest.raises(HardwareError, match="does not answer"):
        bench.drive.aim(AZ, 60.0, 0.0, bench.clock() + 0.2)
    bench.follow(EL, 20.0, 3.0)
    assert bench.antenna(EL) == pytest.approx(20.0, abs=1e-3)


def test_the_watchdog_stops_it_when_the_program_dies_and_a_person_wakes_it() -> None:
    bench = Bench()
    bench.follow(AZ, 300.0, 3.0)
    bench.alive = False
    bench.clock.sleep(WATCHDOG_S + 2.0)
    at_deg = bench.antenna(AZ)
    assert bench.mode(AZ) is Mode.TIMEOUT
    bench.alive = True
    bench.clock.sleep(0.5)
    assert "heard nothing for 0.5 s and stopped by itself" in bench.drive.faults()[AZ]
    with pytest.raises(HardwareError, match="acknowledge"):
        bench.follow(AZ, 300.0, 0.2)
    assert bench.antenna(AZ) == at_deg
    bench.drive.acknowledge(AZ)
    bench.clock.sleep(0.1)
    bench.follow(AZ, at_deg + 5.0, 3.0)
    assert bench.antenna(AZ) == pytest.approx(at_deg + 5.0, abs=1e-3)


def test_what_an_earlier_run_left_timed_out_waits_for_the_first_aim() -> None:
    bench = Bench()
    bench.follow(AZ, 10.0, 2.0)
    bench.alive = False
    bench.clock.sleep(2.0)
    bench.start_program()
    bench.clock.sleep(1.0)
    assert (bench.mode(AZ), bench.drive.faults()) == (Mode.TIMEOUT, {})
    bench.follow(AZ, 12.0, 2.0)
    assert bench.antenna(AZ) == pytest.approx(12.0, abs=1e-3)


# --- where am I?


def test_behind_a_gear_a_new_supply_means_an_unknown_position() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    assert bench.drive.position_known(AZ)
    bench.follow(AZ, 124.0, 1.0)
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(0.2)
    assert not bench.drive.position_known(AZ)
    for ask in (bench.drive.sensor(AZ).read, lambda: bench.follow(AZ, 120.0, 0.1)):
        with pytest.raises(HardwareError, match="does not know which way the antenna points"):
            ask()
    # The operator estimates: some 3° off, and less than half a turn of the rotor, which is 7.2° of antenna.
    bench.drive.confirm(AZ, 127.0)
    bench.clock.sleep(0.5)
    assert bench.drive.position_known(AZ)
    assert bench.drive.sensor(AZ).read() == pytest.approx(124.0, abs=0.01)
    bench.follow(AZ, 130.0, 3.0)
    assert bench.antenna(AZ) == pytest.approx(130.0, abs=0.01)


def test_confirmed_exactly_it_is_what_was_said() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    bench.world.inject("azimuth-power-cycled")
    bench.drive.confirm(AZ, 127.0, exactly=True)
    bench.clock.sleep(0.5)
    assert bench.drive.sensor(AZ).read() == pytest.approx(127.0, abs=0.01)


def test_a_confirmation_that_cannot_be_delivered_is_forgotten_before_the_antenna_has_turned() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    bench.world.inject("azimuth-silent")
    bench.drive.confirm(AZ, 33.0, exactly=True)
    bench.clock.sleep(ERRAND_S + 0.1)
    bench.world.clear("azimuth-silent")
    bench.clock.sleep(1.0)
    assert bench.drive.sensor(AZ).read() == pytest.approx(123.0, abs=0.01)
    bench.world.inject("azimuth-silent")
    bench.clock.sleep(STALE_S + 0.1)
    with pytest.raises(HardwareError, match="does not answer"):
        bench.drive.confirm(AZ, 33.0)


@pytest.mark.parametrize("brakes", [False, True], ids=["turning", "braking"])
def test_while_it_turns_no_angle_is_confirmed_and_it_keeps_its_torque(brakes: bool) -> None:
    bench = Bench()
    bench.follow(AZ, 300.0, 2.0)
    if brakes:
        bench.drive.hold(AZ)
        bench.clock.sleep(0.3)
    with pytest.raises(HardwareError, match="it turns; look where it points when it stands"):
        bench.drive.confirm(AZ, 33.0)
    bench.clock.sleep(0.1)
    assert bench.mode(AZ) is Mode.POSITION
    bench.drive.hold(AZ)
    bench.clock.sleep(3.0)
    bench.drive.confirm(AZ, 33.0, exactly=True)


def test_a_confirmation_moves_nothing_that_holds() -> None:
    bench = Bench()
    bench.follow(AZ, 30.0, 4.0)
    bench.drive.confirm(AZ, 33.0, exactly=True)
    bench.clock.sleep(2.0)
    assert bench.antenna(AZ) == pytest.approx(30.0, abs=0.01)
    assert bench.drive.sensor(AZ).read() == pytest.approx(33.0, abs=0.01)
    assert bench.mode(AZ) is Mode.POSITION


def test_without_a_gear_the_rotors_encoder_knows() -> None:
    bench = Bench(start_deg=(100.0, 0.0), geared=False, rotor_turns=1)
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(0.2)
    assert bench.drive.position_known(AZ)
    assert bench.drive.sensor(AZ).read() == pytest.approx(100.0, abs=0.01)


def test_a_controller_that_lost_its_supply_is_queried_before_it_gets_an_order_to_move() -> None:
    bench = Bench(start_deg=(123.0, 0.0))
    bench.follow(AZ, 150.0, 1.0)
    bench.world.inject("azimuth-silent")
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(0.1)
    at_deg = bench.antenna(AZ)
    bench.world.clear("azimuth-silent")
    sent_rev = set()
    for _ in range(100):
        bench.clock.sleep(0.001)
        sent_rev.add(bench.world.controller("azimuth").motor.command[0x020])
    assert round(150.0 / 360, 6) not in {round(position_rev, 6) for position_rev in sent_rev}
    assert bench.antenna(AZ) == at_deg


def test_a_lost_connection_is_why_there_is_no_answer_until_there_is_one() -> None:
    bench = Bench()
    bench.alive = False
    bench.drive.lost("moteus: /dev/fdcanusb: the adapter has gone")
    bench.clock.sleep(STALE_S - 0.1)
    bench.drive.sensor(AZ).read()
    bench.clock.sleep(0.2)
    for ask in (bench.drive.sensor(AZ).read, lambda: bench.drive.acknowledge(AZ), lambda: bench.follow(EL, 5.0, 0.05)):
        with pytest.raises(HardwareError, match="the adapter has gone"):
            ask()
    bench.alive = True
    bench.clock.sleep(0.2)
    bench.follow(AZ, 1.0, 1.0)
    bench.world.inject("azimuth-silent")
    bench.clock.sleep(STALE_S + 0.1)
    with pytest.raises(HardwareError, match=r"^moteus 1 does not answer"):
        bench.drive.sensor(AZ).read()


def test_the_bus_sleeps_until_the_next_order_and_not_at_all_when_one_is_due() -> None:
    bench = Bench()
    bench.alive = False
    due_s = bench.drive.next_order_s()
    assert 0.0 < due_s - bench.clock() <= 0.08
    assert bench.drive.next_order_in_s() == pytest.approx(due_s - bench.clock())
    bench.clock.sleep(1.0)
    assert bench.drive.next_order_in_s() == 0.0


def test_two_axes_cannot_share_an_id() -> None:
    with pytest.raises(HardwareError, match="both have CAN id 1"):
        MoteusDrive(MoteusSpec(1), MoteusSpec(1), SimClock())
