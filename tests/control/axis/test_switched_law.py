"""When a motor that is only on or off is started and stopped, so that its coast ends on the goal.

The motor here is ideal: full speed from the first moment, and its coast at once when it is switched off, as the model
of a motor with a lag says where it would come to rest.
"""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.settings import BrakeSettings
from rotator.control.axis.switched_law import ANYWHERE, SwitchedLaw, Timing
from rotator.control.commands import Run
from rotator.control.sky.plan import OFFSETS_S, Path
from rotator.exchange.motor import Motor

MINUS, OFF, PLUS = Direction
LEASE_S, PERIOD_S = 0.25, 0.05
SPEED_DPS, LAG_S = 6.0, 0.15
EVEN = (1.0,) * len(OFFSETS_S)
BOTH_WAYS = pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])


class Axis:
    """A motor with a first-order lag, cycled at 20 Hz; its relay obeys leases to the moment."""

    def __init__(
        self, at_deg: float = 100.0, reach: tuple[float, float] = ANYWHERE, brake: BrakeSettings | None = None
    ) -> None:
        motor = Motor(SPEED_DPS, SPEED_DPS * LAG_S)
        self.law = SwitchedLaw({PLUS: motor, MINUS: motor}, Timing(LEASE_S, PERIOD_S, brake), reach)
        self.now_s, self.angle_deg, self.turning_dps = 20.0, at_deg, 0.0
        self.relay, self.until_s, self.relays = OFF, 0.0, RelayState()
        self.starts = 0
        self.law.see(self.now_s, at_deg)

    def cycle(self, run: Run) -> None:
        if run.direction is not OFF and self.relay is OFF:
            self.starts += 1
        self.relay, self.until_s = run.direction, run.until_s
        self.relays = self.relays.changed(self.now_s, self.relay)
        self.law.note_relays(self.now_s, self.relays)
        for _ in range(50):
            self.now_s += PERIOD_S / 50
            if self.now_s >= self.until_s:
                self.relay = OFF
            to_dps = self.relay * SPEED_DPS
            self.turning_dps += (to_dps - self.turning_dps) * PERIOD_S / 50 / LAG_S
            self.angle_deg += self.turning_dps * PERIOD_S / 50
        self.law.see(self.now_s, self.angle_deg)

    def approach(self, target_deg: float, seconds: float, tolerance_deg: float = 4.0) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            self.cycle(self.law.approach(self.now_s, target_deg, tolerance_deg))


@BOTH_WAYS
@pytest.mark.parametrize("away_deg", [4.5, 20.0, 61.3])
def test_it_coasts_onto_the_target_with_one_start(way: Direction, away_deg: float) -> None:
    axis = Axis()
    axis.approach(100.0 + way * away_deg, away_deg / SPEED_DPS + 3.0)
    assert axis.angle_deg == pytest.approx(100.0 + way * away_deg, abs=0.25)
    assert axis.starts == 1
    assert axis.relay is OFF


@BOTH_WAYS
def test_within_the_tolerance_it_rests_and_just_outside_it_goes(way: Direction) -> None:
    axis = Axis()
    assert axis.law.approach(20.0, 100.0 + way * 4.0, 4.0) == Run(OFF, 20.0)
    assert axis.law.approach(20.0, 100.0 + way * 4.01, 4.0) == Run(way, 20.0 + LEASE_S)


@BOTH_WAYS
@pytest.mark.parametrize("beyond_deg", [1.0, 4.5, 60.0])
def test_for_a_target_beyond_its_reach_it_goes_to_the_end_of_its_reach_once(way: Direction, beyond_deg: float) -> None:
    axis = Axis(reach=(80.0, 120.0))
    end_deg = 100.0 + way * 20.0
    axis.approach(end_deg + way * beyond_deg, 30.0)
    assert axis.angle_deg == pytest.approx(end_deg, abs=0.25)
    assert axis.starts == 1
    still = Axis(end_deg - way * 1e-9, reach=(80.0, 120.0))
    still.approach(end_deg + way * beyond_deg, 5.0)
    assert still.starts == 0, "where it stands is as near as it comes"


def test_once_it_runs_it_runs_to_the_target_not_to_the_edge_of_the_tolerance() -> None:
    axis = Axis()
    axis.approach(110.0, 1.5)
    assert abs(axis.angle_deg - 110.0) < 4.0
    assert axis.relay is PLUS
    axis.approach(110.0, 3.0)
    assert axis.angle_deg == pytest.approx(110.0, abs=0.25)


def test_a_stop_between_two_cycles_is_left_to_the_end_of_the_lease() -> None:
    axis = Axis()
    leases_s = []
    for _ in range(80):
        run = axis.law.approach(axis.now_s, 110.0, 4.0)
        if run.direction is PLUS:
            leases_s.append(run.until_s - axis.now_s)
        axis.cycle(run)
    assert leases_s[:-1] == [pytest.approx(LEASE_S)] * (len(leases_s) - 1)
    assert 0.0 < leases_s[-1] <= PERIOD_S


@BOTH_WAYS
def test_a_target_that_jumps_behind_a_running_axis_stops_it_before_it_turns_back(way: Direction) -> None:
    axis = Axis()
    axis.approach(100.0 + way * 40.0, 2.0)
    run = axis.law.approach(axis.now_s, 100.0 - way * 40.0, 4.0)
    assert run.direction is OFF
    axis.cycle(run)
    axis.approach(100.0 - way * 40.0, 12.0)
    assert axis.angle_deg == pytest.approx(100.0 - way * 40.0, abs=0.5)
    assert axis.starts == 2


def test_rest_stops_it_at_once_and_forgets_the_goal() -> None:
    axis = Axis()
    axis.approach(140.0, 2.0)
    assert axis.law.rest(axis.now_s) == Run(OFF, axis.now_s)
    axis.cycle(axis.law.rest(axis.now_s))
    for _ in range(20):
        axis.cycle(axis.law.rest(axis.now_s))
    stood_deg = axis.angle_deg
    assert axis.law.approach(axis.now_s, stood_deg + 3.9, 4.0).direction is OFF


def test_what_a_bad_run_has_taught_is_dropped() -> None:
    axis = Axis()
    before = dict(axis.law.motion.motors)
    axis.approach(130.0, 4.0)
    for _ in range(4):
        axis.angle_deg += 9.0  # far ahead of the model: the motor seems faster
        axis.approach(130.0, PERIOD_S)
    assert axis.law.motion.motors != before
    axis.law.forget_run()
    assert axis.law.motion.motors == before


# --- a target that moves


def path(now_s: float, from_deg: float, rate_dps: float, weight: float = 1.0) -> Path:
    return Path(now_s, [from_deg + rate_dps * offset_s for offset_s in OFFSETS_S], [weight] * len(OFFSETS_S))


def followed(axis: Axis, rate_dps: float, seconds: float, tolerance_deg: float, weight: float = 1.0) -> list[float]:
    """The errors while it follows a target at a steady rate from where the axis stands."""
    began_s, from_deg, errors_deg = axis.now_s, axis.angle_deg, []
    planned = path(axis.now_s, from_deg, rate_dps, weight)
    for count in range(round(seconds / PERIOD_S)):
        if count % 10 == 0:
            planned = path(axis.now_s, from_deg + rate_dps * (axis.now_s - began_s), rate_dps, weight)
        axis.cycle(axis.law.follow(axis.now_s, planned, tolerance_deg))
        errors_deg.append(from_deg + rate_dps * (axis.now_s - began_s) - axis.angle_deg)
    return errors_deg


@pytest.mark.parametrize(("rate_dps", "mean_deg", "worst_deg"), [(0.5, 0.6, 4.5), (-0.5, 0.6, 4.5), (2.0, 1.5, 6.0)])
def test_it_goes_past_a_moving_target_and_lets_it_drift_back(
    rate_dps: float, mean_deg: float, worst_deg: float
) -> None:
    axis = Axis()
    errors_deg = followed(axis, rate_dps, 60.0, 4.0)[200:]
    assert max(errors_deg) > 1.0, "behind it"
    assert min(errors_deg) < -1.0, "ahead of it"
    assert sum(errors_deg) / len(errors_deg) == pytest.approx(0.0, abs=mean_deg)
    assert max(map(abs, errors_deg)) < worst_deg


def test_while_its_brake_holds_it_sets_off_earlier_and_for_a_further_place() -> None:
    def sets_off_s(axis: Axis) -> float:
        planned, from_s = path(axis.now_s, 100.0, 1.0), axis.now_s
        while axis.law.follow(axis.now_s, planned, 4.0).direction is OFF:
            axis.cycle(Run(OFF, axis.now_s))
        return axis.now_s - from_s

    braked = Axis(brake=BrakeSettings(release_s=1.0, held_off_s=5.0))
    assert sets_off_s(braked) < sets_off_s(Axis()) - 0.2
    # Just after a run it is still off.
    axis = Axis(brake=BrakeSettings(release_s=1.0, held_off_s=5.0))
    axis.approach(110.0, 4.0)
    assert axis.law.start_s(axis.now_s) == 0.0
    axis.approach(110.0, 5.0)
    assert axis.law.start_s(axis.now_s) == 1.0


def test_a_smaller_tolerance_costs_more_starts() -> None:
    wide, narrow = Axis(), Axis()
    followed(wide, 0.5, 60.0, 4.0)
    followed(narrow, 0.5, 60.0, 1.0)
    assert narrow.starts > 2 * wide.starts > 0


def test_where_an_error_weighs_little_it_does_not_start() -> None:
    """Near the zenith azimuth hardly counts: the error on the sky stays below the least share of the tolerance."""
    axis = Axis()
    followed(axis, 0.5, 20.0, 4.0, weight=0.01)
    assert axis.starts == 0


def test_it_does_not_start_for_less_than_the_least_move() -> None:
    axis = Axis()
    still = path(axis.now_s, 100.29, 0.0)
    assert axis.law.follow(axis.now_s, still, 0.01).direction is OFF
    further = path(axis.now_s, 100.31, 0.0)
    assert axis.law.follow(axis.now_s, further, 0.01).direction is PLUS


def test_where_the_readings_take_a_move_back_it_is_not_tried_again_at_once() -> None:
    """A count that waits for its contact comes back to the contact's place when the axis rests."""
    axis = Axis()
    for _ in range(200):
        axis.cycle(axis.law.approach(axis.now_s, 101.8, 1.0))
        if axis.relay is OFF:
            axis.angle_deg, axis.turning_dps = 100.0, 0.0
            axis.law.see(axis.now_s, axis.angle_deg)
    assert 2 <= axis.starts <= 15
