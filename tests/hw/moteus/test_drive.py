"""The moteus drive: angles, motion, leases, holding and letting go; its connection."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.clock import SimClock
from firmware_sim.moteus.motor import Mode
from hw.drives.leases import LONGEST_LEASE_S
from hw.moteus.axis import STALE_S
from hw.moteus.drive import MoteusDrive
from hw.moteus.orders import MoteusSpec
from hw.ports import AngleSource, Axis, HardwareError
from tests.hw.moteus.drive_bench import AZ, AZIMUTH, CYCLE_S, EL, ELEVATION, Bench


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
