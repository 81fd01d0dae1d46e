"""The moteus drive: angles, motion, leases, holding and letting go; its connection."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.tables import every_row

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from firmware_sim.moteus.motor import Mode
from hw.moteus.orders import MoteusSpec
from hw.ports import Axis
from tests.hw.moteus.drive_bench import AZ, AZIMUTH, CYCLE_S, EL, ELEVATION, Bench


@every_row(
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
