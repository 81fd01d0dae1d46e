"""Which turn, after a power cut, a restart and a person's word: a direct drive, an encoder on the output, a gear.

The real driver and mjbots' library on simulated controllers. Judged by where the simulated antenna really goes.
"""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.tables import every_row

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

from hw.moteus.placing import BEYOND_DEG
from hw.ports import Axis, HardwareError
from tests.hw.moteus.drive_bench import Bench
from tests.search import examples

AZ = Axis.AZIMUTH
NEAR_DEG = 0.02
DIRECT = {"geared": False, "rotor_turns": 1.0}
ON_OUTPUT = {"geared": False, "rotor_turns": 50.0, "output_encoder": True}
WITHOUT_A_PERSON = pytest.mark.parametrize("encoder", [DIRECT, ON_OUTPUT], ids=["direct", "on the output"])


def powered_up(bench: Bench) -> None:
    """Power off and on with the program off, then the program starts."""
    bench.alive = False
    bench.world.inject("azimuth-power-cycled")
    bench.start_program()


def complaint(bench: Bench) -> str:
    try:
        bench.drive.sensor(AZ).read()
    except HardwareError as reason:
        return str(reason)
    return ""


def fitting(angle_deg: float, low_deg: float, high_deg: float) -> int:
    """In how many turns of the range, and a little beyond it, the antenna may stand."""
    turns = [angle_deg + 360.0 * turn for turn in range(-3, 4)]
    return sum(low_deg - BEYOND_DEG <= turn <= high_deg + BEYOND_DEG for turn in turns)


@WITHOUT_A_PERSON
def test_at_270_it_knows_so_and_goes_to_280(encoder: dict[str, float]) -> None:
    """Its controller says -90°: an order to 280° once took the antenna to 640°."""
    bench = Bench(start_deg=(270.0, 0.0), **encoder)  # type: ignore[arg-type]  # keywords of two types
    powered_up(bench)
    assert bench.drive.sensor(AZ).read() == pytest.approx(270.0, abs=NEAR_DEG)
    bench.follow(AZ, 280.0, 4.0)
    assert bench.antenna(AZ) == pytest.approx(280.0, abs=NEAR_DEG)
    assert bench.world.controller("azimuth").motor.position_rev == pytest.approx(280 / 360, abs=1e-3), "for its bounds"


@every_row("true_deg", [-0.1, 0.0, 0.1, 359.9, 360.0])
def test_at_the_seam_of_a_full_circle_a_push_of_the_wind_is_not_taken_for_a_turn(true_deg: float) -> None:
    bench = Bench(start_deg=(true_deg, 0.0), range_deg=(0.0, 360.0), **DIRECT)  # type: ignore[arg-type]
    powered_up(bench)
    assert "0° or at 360°" in complaint(bench) or "-0° or at 360°" in complaint(bench)


@pytest.mark.long
@WITHOUT_A_PERSON
def test_a_supply_lost_while_it_turns_in_the_overlap_stops_it(encoder: dict[str, float]) -> None:
    bench = Bench(start_deg=(100.0, 0.0), **encoder)  # type: ignore[arg-type]  # keywords of two types
    powered_up(bench)
    bench.follow(AZ, 405.0, 14.0)
    bench.world.inject("azimuth-power-cycled")
    bench.clock.sleep(0.2)
    at_deg = bench.antenna(AZ)
    assert "45° or at 405°" in complaint(bench)
    bench.drive.off()
    bench.clock.sleep(1.0)
    assert "45° or at 405°" in complaint(bench), "a controller that holds has proved nothing"
    assert bench.antenna(AZ) == pytest.approx(at_deg, abs=NEAR_DEG)


def worlds() -> st.SearchStrategy[tuple[dict[str, float], float, float, float]]:
    """An encoder, the range, and the share of the range at which the antenna stands: five degrees beyond it at most."""
    encoders = st.sampled_from([DIRECT, ON_OUTPUT, {"geared": True, "rotor_turns": 8.0}])
    lows_deg, spans_deg = st.sampled_from([0.0, 90.0, -180.0]), st.sampled_from([180.0, 270.0, 360.0, 450.0, 540.0])
    return st.tuples(encoders, lows_deg, spans_deg, st.floats(-0.009, 1.009))


@pytest.mark.long
@given(
    world=worlds(), shares=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=3), said_off_deg=st.floats(-20.0, 20.0)
)
@settings(max_examples=examples(40))
def test_no_power_cut_turns_the_antenna_out_of_its_range(
    world: tuple[dict[str, float], float, float, float], shares: list[float], said_off_deg: float
) -> None:
    """A person confirms, right to 20°, only where the box asks. Then it goes where it is sent: on the right turn."""
    encoder, low_deg, span_deg, share = world
    high_deg = low_deg + span_deg
    bench = Bench((low_deg + share * span_deg, 0.0), range_deg=(low_deg, high_deg), **encoder)  # type: ignore[arg-type]
    for goal in shares:
        powered_up(bench)
        at_deg = bench.antenna(AZ)
        if complaint(bench):
            assert encoder["geared"] or fitting(at_deg, low_deg, high_deg) != 1
            bench.follow_if_it_may(AZ, low_deg + span_deg / 2, 1.0)
            assert bench.antenna(AZ) == pytest.approx(at_deg, abs=NEAR_DEG)
            bench.drive.confirm(AZ, at_deg + said_off_deg)
            bench.clock.sleep(0.5)
        assert bench.drive.sensor(AZ).read() == pytest.approx(at_deg, abs=NEAR_DEG)
        goal_deg = low_deg + goal * span_deg
        for _ in range(21):
            bench.follow(AZ, goal_deg, 1.0)
            assert low_deg - BEYOND_DEG - 1.0 <= bench.antenna(AZ) <= high_deg + BEYOND_DEG + 1.0
        assert bench.antenna(AZ) == pytest.approx(goal_deg, abs=NEAR_DEG)
