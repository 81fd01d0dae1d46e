"""Control boxes with digital pots whose rotor stands elsewhere than the program assumes: what a stop does then.

Judged in the simulated world, from places over the whole range.
"""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from hw.drives.leases import LONGEST_LEASE_S
from hw.ports import Axis
from tests.hw.drives.test_digipot import AZ, EL, Bench
from tests.search import examples

COAST_DEG = 1.0 + 0.5
"""What the motor coasts, and the play of the gear."""


def bench_at(true_deg: float, assumed_deg: float, elevation_deg: float = 30.0) -> Bench:
    bench = Bench(start_deg=assumed_deg)
    bench.rotor.azimuth.motor.shaft_deg = bench.rotor.azimuth.motor.boom_deg = true_deg
    bench.rotor.elevation.motor.shaft_deg = bench.rotor.elevation.motor.boom_deg = elevation_deg
    return bench


def both(bench: Bench, azimuth_deg: float, elevation_deg: float, seconds: float) -> None:
    """As the control loop does: each axis in turn, 20 times a second."""
    for _ in range(round(seconds / 0.05)):
        bench.drive.aim(AZ, azimuth_deg, 0.0, bench.clock() + 0.25)
        bench.drive.aim(EL, elevation_deg, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(0.05)


@pytest.mark.long
@settings(max_examples=examples(30), deadline=None)
@given(
    true_deg=st.tuples(st.floats(0, 360), st.floats(0, 90)),
    assumed_deg=st.floats(0, 360),
    target_deg=st.floats(0, 360),
    seconds=st.floats(0.1, 90),
    stop=st.sampled_from(["hold", "off", "expiry"]),
)
def test_a_stop_stops_at_any_true_angle_of_the_rotor(
    true_deg: tuple[float, float], assumed_deg: float, target_deg: float, seconds: float, stop: str
) -> None:
    bench = bench_at(true_deg[0], assumed_deg, true_deg[1])
    both(bench, target_deg, 45.0, seconds)
    before_deg = bench.rotor.shafts()
    match stop:
        case "hold":
            bench.drive.hold(AZ)
            bench.drive.hold(EL)
        case "off":
            bench.drive.off()
        case _:
            bench.clock.sleep(LONGEST_LEASE_S)
            before_deg = bench.rotor.shafts()
    bench.clock.sleep(70.0)
    assert bench.rotor.shafts() == pytest.approx(before_deg, abs=COAST_DEG)


def test_when_a_full_travel_is_over_a_stop_needs_no_relay() -> None:
    bench = bench_at(300.0, 180.0)
    assert not bench.drive.position_known(AZ)
    both(bench, 90.0, 30.0, 90.0)
    assert bench.drive.position_known(AZ)
    assert bench.drive.position_known(EL)
    both(bench, 20.0, 30.0, 2.0)
    bench.drive.off()
    assert bench.rotor.gpio.level(22), "the boxes keep their supply"


@pytest.mark.long
@settings(max_examples=examples(12), deadline=None)
@example(true_deg=2.0, assumed_deg=7.0, target_deg=6.0)  # it rests just within the least step back
@given(true_deg=st.floats(0, 360), assumed_deg=st.floats(0, 360), target_deg=st.floats(5, 355))
def test_started_anywhere_it_rests_where_it_was_ordered(true_deg: float, assumed_deg: float, target_deg: float) -> None:
    bench = bench_at(true_deg, assumed_deg)
    bench.follow(AZ, target_deg, 100.0)
    # Less than a step of what it may be off is not worth another reversal. Then come half the play of the gear and what
    # the motor turns until the box sees that it is there.
    assert bench.antenna(AZ) == pytest.approx(target_deg, abs=1.41 + 0.25 + 0.1)
    assert bench.drive.angle_deg(AZ) == pytest.approx(bench.antenna(AZ), abs=2 * 1.41 + 0.25)


RESTS_WITHIN_DEG = 0.7 + 0.25 + 0.1
"""Half a step, and half the play of the gear. The dead band is no part of it."""


@pytest.mark.long
@settings(max_examples=examples(12), deadline=None)
@given(st.lists(st.tuples(st.floats(3, 357), st.sampled_from(["", "hold", "release"])), min_size=1, max_size=6))
def test_it_rests_there_from_either_side_after_reversals_stops_and_let_go(orders: list[tuple[float, str]]) -> None:
    bench = Bench()
    for target_deg, then in orders:
        near = abs(target_deg - bench.antenna(AZ)) < 3.0  # a small correction does not reverse the motor
        bench.follow(AZ, target_deg, 65.0)
        assert bench.antenna(AZ) == pytest.approx(target_deg, abs=RESTS_WITHIN_DEG + (1.5 if near else 0.0))
        match then:
            case "hold":
                bench.follow(AZ, 180.0, 1.0)
                bench.drive.hold(AZ)
                bench.clock.sleep(2.0)
            case "release":
                bench.drive.release()


@given(target_deg=st.floats(0, 360), before_deg=st.floats(0, 360), low_deg=st.floats(0, 100))
@settings(max_examples=examples(20), deadline=None)
def test_the_wiper_never_leads_beyond_an_end_of_the_range(target_deg: float, before_deg: float, low_deg: float) -> None:
    ends_deg = (low_deg, 360.0 - low_deg)
    bench = Bench(range_deg=ends_deg)
    steps: list[int] = []
    bench.rotor.azimuth.chip.before_change.append(lambda: steps.append(bench.rotor.azimuth.chip.step))
    for order_deg in (before_deg, target_deg, before_deg):
        bench.follow(AZ, min(max(order_deg, ends_deg[0]), ends_deg[1]), 10.0)
        steps.append(bench.rotor.azimuth.chip.step)
        assert ends_deg[0] - 0.71 <= steps[-1] * 360 / 256 <= ends_deg[1] + 0.71


def test_a_target_that_flickers_by_a_degree_does_not_reverse_the_motor() -> None:
    bench = Bench()
    bench.follow(AZ, 100.0, 100.0)
    starts = bench.rotor.azimuth.starts
    for second in range(60):
        bench.follow(AZ, 100.0 - second % 2, 1.0)
    assert bench.rotor.azimuth.starts == starts


# --- where a pot is read


def measured(bench: Bench, axis: Axis, angle_deg: float, seconds: float) -> None:
    for _ in range(round(seconds / 0.05)):
        bench.drive.found(axis, bench.rotor.shafts()[list(Axis).index(axis)])
        bench.drive.aim(axis, angle_deg, 0.0, bench.clock() + 0.25)
        bench.clock.sleep(0.05)


@pytest.mark.long
@pytest.mark.parametrize("band_deg", [1.2, 2.0, 3.0])
def test_the_dead_band_is_learnt_for_each_direction(band_deg: float) -> None:
    """The box's own band is another one than the file's 2°, and the motor coasts: after some moves it rests exactly."""
    bench = Bench(box_band_deg=band_deg)
    for _ in range(4):
        measured(bench, AZ, 200.0, 35.0)
        up_deg = bench.rotor.shafts()[0]
        measured(bench, AZ, 100.0, 35.0)
    assert up_deg == pytest.approx(200.0, abs=0.75)
    assert bench.rotor.shafts()[0] == pytest.approx(100.0, abs=0.75)


def test_a_measured_rotor_is_stopped_by_the_wiper_from_the_first_order_on() -> None:
    bench = bench_at(80.0, 180.0)
    measured(bench, EL, 30.0, 0.1)
    measured(bench, AZ, 300.0, 3.0)
    bench.drive.hold(AZ)
    stood_deg = bench.rotor.shafts()[0]
    bench.clock.sleep(20.0)
    assert bench.rotor.shafts()[0] == pytest.approx(stood_deg, abs=COAST_DEG)
