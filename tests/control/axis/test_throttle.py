"""How fast a motor with a speed output turns: at its start, before its goal, and along with a target that moves.

The motor here obeys at once, up to its lag, and its output's straight line is exact.
"""

from __future__ import annotations

import pytest

from hw.ports import Direction
from rotator.control.axis.relay_state import RelayState
from rotator.control.axis.settings import SpeedSettings
from rotator.control.axis.switched_law import SwitchedLaw, Timing
from rotator.control.axis.throttle import Throttle
from rotator.control.commands import Run
from rotator.control.sky.plan import OFFSETS_S, Path
from rotator.exchange.motor import Motor

MINUS, OFF, PLUS = Direction
LEASE_S, PERIOD_S = 0.25, 0.05
FULL_DPS, LAG_S = 8.0, 0.2
SPEED = SpeedSettings(lowest_share=0.25, slow_start_s=1.0, slow_down_s=2.0)


class Axis:
    def __init__(self) -> None:
        motor = Motor(FULL_DPS, FULL_DPS * LAG_S)
        self.law = SwitchedLaw({PLUS: motor, MINUS: motor}, Timing(LEASE_S, PERIOD_S, speed=SPEED))
        self.now_s, self.angle_deg, self.turning_dps = 20.0, 100.0, 0.0
        self.relays, self.starts = RelayState(), 0
        self.shares: list[float] = []
        """The speed of each cycle in which the relay was closed."""
        self.law.see(self.now_s, self.angle_deg)

    def cycle(self, run: Run) -> None:
        share, until_s, relay = self.law.throttle.share, run.until_s, run.direction
        self.starts += relay is not OFF and not self.relays.closed
        if relay is not OFF:
            self.shares.append(share)
        self.relays = self.relays.changed(self.now_s, relay)
        self.law.note_relays(self.now_s, self.relays)
        for _ in range(50):
            self.now_s += PERIOD_S / 50
            to_dps = (relay if self.now_s < until_s else OFF) * FULL_DPS * share
            self.turning_dps += (to_dps - self.turning_dps) * PERIOD_S / 50 / LAG_S
            self.angle_deg += self.turning_dps * PERIOD_S / 50
        self.law.see(self.now_s, self.angle_deg)


@pytest.mark.parametrize("way", [PLUS, MINUS])
@pytest.mark.parametrize("away_deg", [4.5, 20.0, 90.0])
def test_it_comes_onto_a_standing_target_from_its_lowest_speed_with_one_start(way: Direction, away_deg: float) -> None:
    axis = Axis()
    for _ in range(round((away_deg / 2.0 + 5.0) / PERIOD_S)):
        axis.cycle(axis.law.approach(axis.now_s, 100.0 + way * away_deg, 4.0))
    assert axis.angle_deg == pytest.approx(100.0 + way * away_deg, abs=0.1)
    assert axis.starts == 1
    assert axis.shares[0] == axis.shares[-1] == 0.25
    steps = [after - before for before, after in zip(axis.shares, axis.shares[1:], strict=False)]
    assert max(steps) <= 0.75 / SPEED.slow_start_s * PERIOD_S + 1e-9
    assert (max(axis.shares) == 1.0) is (away_deg > 10.0)


@pytest.mark.parametrize(("level", "share"), [(1, 0.25), (2, 0.5), (3, 0.75), (4, 1.0)])
def test_its_level_is_its_highest_speed(level: int, share: float) -> None:
    axis = Axis()
    axis.law.throttle.limit(level)
    for _ in range(round(4.0 / PERIOD_S)):
        axis.cycle(axis.law.approach(axis.now_s, 300.0, 4.0))
    assert max(axis.shares) == pytest.approx(share)


def test_it_turns_along_with_a_fast_target_and_with_a_slow_one_in_steps() -> None:
    def starts(rate_dps: float) -> tuple[int, float]:
        axis = Axis()
        while axis.now_s < 40.0:
            along_deg = 100.0 + rate_dps * (axis.now_s - 20.0)
            weights = (1.0,) * len(OFFSETS_S)
            path = Path(axis.now_s, tuple(along_deg + rate_dps * offset_s for offset_s in OFFSETS_S), weights)
            axis.cycle(axis.law.follow(axis.now_s, path, 4.0))
        return axis.starts, abs(axis.angle_deg - along_deg)

    fast, off_deg = starts(3.0)
    assert fast == 1
    assert off_deg < 0.3
    slow, _ = starts(1.0)
    assert slow >= 2


def test_the_mean_speed_of_a_run_is_that_of_its_ramps() -> None:
    throttle = Throttle(SPEED)
    assert throttle.mean(1e-6) == pytest.approx(0.25, abs=0.01)
    # Three seconds of ramps at 0.625 on average, and ten at full speed.
    assert throttle.mean(3.0 * 0.625 + 10.0) == pytest.approx((3.0 * 0.625 + 10.0) / 13.0)
    throttle.limit(1)
    assert throttle.mean(20.0) == pytest.approx(0.25)
    assert Throttle(None).mean(3.0) == 1.0
