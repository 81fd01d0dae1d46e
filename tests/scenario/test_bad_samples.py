"""A bad sensor in the simulated station, with the real drivers: what it does to the motor, and what the box says.

The cases are drawn from seeds; `python -m tests.scenario.test_bad_samples FIRST COUNT` looks for worse ones.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Iterator

import pytest

from benchmarks.faults import Mast
from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, RelaysChecked, Release, Stop
from tests.scenario.bad_samples import Case, Truth, tried
from tests.search import some

AZ = Axis.AZIMUTH
SECONDS = 60.0
TRY_S, TRIES, TRIES_WITHIN_S = 2.05, 3, 600.0
AWAY_S = 2.0
MORE_STARTS = 4


def wrongs(case: Case, truth: Truth) -> list[str]:
    """What of it must not happen."""
    healthy = tried(case, SECONDS, broken=False).starts
    found = {
        "both relays": truth.shorted_s > 0.0,
        "current for too long": max((for_s for _, for_s in truth.stalls_s), default=0.0) > TRY_S,
        "too many tries": truth.tries(TRIES_WITHIN_S) > TRIES + (case.jog_s is not None),
        "the wrong way": truth.away_s > AWAY_S,
        "too many starts": truth.starts > MORE_STARTS * max(healthy, 1),
    }
    return [each for each, wrong in found.items() if wrong]


@pytest.fixture
def mast() -> Iterator[Mast]:
    mast = Mast()
    yield mast
    mast.close()


def said(mast: Mast) -> list[str]:
    return [fault.name for fault in mast.status.faults]


@pytest.mark.search
@pytest.mark.parametrize("seed", some(range(8)))
def test_whatever_is_bad_the_motor_is_safe(seed: int) -> None:
    case = Case.drawn(seed)
    truth = tried(case, SECONDS)
    assert wrongs(case, truth) == [], (case, truth)


# --- one now and then


@pytest.mark.parametrize("sensor", ["azimuth-pot-crackles:20", "azimuth-pot-spikes:20", "azimuth-pot-crackles:33"])
def test_one_bad_reading_now_and_then_costs_nothing(mast: Mast, sensor: str) -> None:
    mast.run(2.0)
    mast.world.inject(sensor)
    mast.order(Aim(150.0, 15.0))
    mast.run(30.0)
    assert mast.status.faults == ()
    assert mast.world.antenna()[0] == pytest.approx(150.0, abs=1.0)
    assert mast.world.relay_starts == 1


@pytest.mark.parametrize("sensor", ["azimuth-pot-crackles:7", "azimuth-pot-spikes:10", "azimuth-pot-crackles:2"])
def test_too_many_are_a_fault_and_the_motor_starts_once(mast: Mast, sensor: str) -> None:
    mast.run(2.0)
    mast.world.inject(sensor)
    mast.order(Aim(150.0, 15.0))
    for _ in range(40):
        mast.run(1.0)
        mast.order(Stop())
        mast.order(Aim(150.0, 15.0))
    assert [fault.axis for fault in mast.status.faults] == [AZ]
    assert mast.world.relay_starts <= 4


@pytest.mark.parametrize("each", [7, 16, 32])
@pytest.mark.parametrize(
    ("motor", "fault"),
    [("motor-stalled", "motor runs and pot stands still"), ("motor-reversed", "pot moves the wrong way")],
)
def test_bad_readings_hide_no_motor(mast: Mast, each: int, motor: str, fault: str) -> None:
    mast.run(2.0)
    mast.world.inject(f"azimuth-pot-crackles:{each}")
    mast.world.inject(f"azimuth-{motor}")
    mast.order(Aim(150.0, 15.0))
    mast.run(2.0)
    assert said(mast) == [fault]
    assert mast.world.drives() == (0, 0)


# --- tried again and again


def retried(mast: Mast, seconds: float, every_s: float = 4.0) -> None:
    for _ in range(round(seconds / every_s)):
        mast.order(Stop())
        mast.order(Aim(400.0, 15.0))
        mast.run(every_s)


def test_a_stalled_motor_is_tried_three_times_in_ten_minutes_at_most(mast: Mast) -> None:
    mast.run(2.0)
    mast.world.inject("azimuth-motor-stalled")
    retried(mast, 60.0)
    assert mast.world.relay_starts <= 3


def test_a_person_has_it_tried_again_at_once(mast: Mast) -> None:
    mast.run(2.0)
    mast.world.inject("azimuth-motor-stalled")
    retried(mast, 30.0)
    mast.world.clear("azimuth-motor-stalled")
    mast.order(Release())
    mast.order(Aim(60.0, 15.0))
    mast.run(10.0)
    assert mast.status.faults == ()
    assert mast.world.antenna()[0] == pytest.approx(60.0, abs=1.0)


@pytest.mark.long
@pytest.mark.parametrize("jog_s", [0.3, 0.5, 1.0])
def test_short_runs_into_an_obstacle_are_judged_together(mast: Mast, jog_s: float) -> None:
    mast.run(2.0)
    mast.order(Jog(AZ, Direction.PLUS, 3.0))
    mast.run(6.0)
    mast.world.inject("azimuth-motor-stalled")
    starts = mast.world.relay_starts
    for _ in range(30):
        mast.order(Stop())
        mast.order(Jog(AZ, Direction.PLUS, jog_s))
        mast.run(2.0)
    assert said(mast) == ["motor runs and pot stands still"]
    assert mast.world.relay_starts - starts <= 4


@pytest.mark.long
def test_an_end_stop_is_met_once_and_then_kept_off(mast: Mast) -> None:
    mast.world.inject("azimuth-stop-early")
    mast.run(1.0)
    mast.order(Aim(430.0, 15.0))
    mast.run(75.0)
    mast.order(Aim(449.0, 15.0))
    mast.run(10.0)
    assert said(mast) == ["end stop reached"]
    mast.order(Stop())
    mast.order(RelaysChecked(AZ))  # at its stop nothing shows that the relay has opened
    mast.order(Aim(400.0, 15.0))
    mast.run(12.0)
    assert mast.world.antenna()[0] == pytest.approx(400.0, abs=1.0), "away from the stop it turns"
    mast.order(Aim(449.0, 15.0))
    mast.run(15.0)
    assert mast.status.faults == ()
    assert mast.world.antenna()[0] == pytest.approx(444.0, abs=1.0), "2° before the stop"
    assert [notice.lcd for notice in mast.status.azimuth.notices] == ["STOP MET"]
    mast.order(Release())
    mast.order(Jog(AZ, Direction.PLUS, 5.0))
    mast.run(10.0)
    assert said(mast) == ["end stop reached"], "a person lets it go there again"


if __name__ == "__main__":
    logging.disable(logging.CRITICAL)
    first, count = (int(text) for text in sys.argv[1:3])
    for seed in range(first, first + count):
        drawn = Case.drawn(seed)
        went = tried(drawn, SECONDS)
        if what := wrongs(drawn, went):
            sys.stdout.write(f"{seed} {what} {drawn} {went}\n")
            sys.stdout.flush()
